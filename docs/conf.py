"""How the pages become a site: `python -m sphinx -W docs build/docs`, without a network.

Pages are MyST Markdown. A line `<!-- generated: NAME -->` is replaced by what `generate.py` makes of the program's
own data, so that no table is typed twice. Pages that begin with a notebook's head are executed; `build/notebooks` keeps
what they showed, and `-D nb_execution_mode=off` leaves that out.
"""

import os
import re
import sys
from pathlib import Path

from sphinx.application import Sphinx

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT), str(HERE)]

project = "Hydraulic test bench"
author = "Hydraulic test bench"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
exclude_patterns = ["**/drive/**"]
language = "en"
default_role = "code"

html_theme = "pydata_sphinx_theme"
html_title = project
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "navbar_align": "left",
    "navbar_end": ["theme-switcher"],
    "show_toc_level": 2,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": [],
    "footer_end": [],
}

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header", "myst-nb.lexer"]  # a notebook that is not executed names no lexer

autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "signature"
autodoc_class_signature = "separated"
napoleon_custom_sections = ["Source", "Differs"]
napoleon_use_rtype = False

nb_execution_mode = "cache"
# One page shows measured logs where there are any: what it showed without them must not stand for that, nor the reverse
nb_execution_cache_path = str(ROOT / "build" / f"notebooks{'-measured' * bool(os.environ.get('REAL_MEASUREMENTS'))}")
nb_execution_timeout = 300  # s
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_merge_streams = True

_GENERATED = re.compile(r"<!-- generated: ([\w-]+) -->")
_OUTSIDE = re.compile(
    r"(?<!!)\[([^\]]+)\]\(((?:\.\./)+(?:README|validation|tests|fmu_build|modelica|CHANGELOG)[^)\s]*)\)"
)


def _page(app: Sphinx, name: str, source: list[str]) -> None:
    """Put generated text where a page asks for it; a link out of the site becomes the path in the repository."""
    import generate

    text = _GENERATED.sub(lambda match: generate.PARTS[match[1]](HERE), source[0])
    source[0] = _OUTSIDE.sub(lambda match: f"{match[1]} (`{match[2].replace('../', '')}`)", text)


def _thumbnails(app: Sphinx, error: Exception | None) -> None:
    """Show the first picture of each notebook in the gallery."""
    gallery = Path(app.outdir) / "gallery"
    if error or not (gallery / "index.html").exists():
        return

    def picture(name: str) -> str:
        found = re.search(
            r'<img[^>]*src="(\.\./_images/[^"]+)"', (gallery / f"{name}.html").read_text(encoding="utf-8")
        )
        return f'<a href="{name}.html"><img alt="{name}" src="{found[1]}"></a>' if found else ""

    page = (gallery / "index.html").read_text(encoding="utf-8")
    page = re.sub(
        r'(<div class="thumbnails" data-pages="([^"]+)">)(?:.|\n)*?</div>',
        lambda match: match[1] + "".join(map(picture, match[2].split())) + "</div>",
        page,
    )
    (gallery / "index.html").write_text(page, encoding="utf-8")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("source-read", _page)
    app.connect("build-finished", _thumbnails)
