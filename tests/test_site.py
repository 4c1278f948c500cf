"""The site: what its pages take from the program is all there, and every page is in a list of contents."""

import importlib.util
import inspect
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

from pysim.cli.main import registry
from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.types import SYNONYMS, UNITS, in_si
from pysim.types.record_kind import KINDS
from tests.test_docs import PAGES, ROOT, blocks

DOCS = ROOT / "docs"


@pytest.fixture(scope="module")
def generate() -> ModuleType:
    spec = importlib.util.spec_from_file_location("generate", DOCS / "generate.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def rows(text: str) -> list[list[str]]:
    """Cells of the rows of a table whose first cell is code, as the words in backticks."""
    lines = [line.split("|")[1:-1] for line in text.split("\n") if line.startswith("| `")]
    return [[" ".join(re.findall(r"`([^`]*)`", cell)) for cell in line] for line in lines]


def test_every_part_is_on_a_page_and_there_is_no_other(generate: ModuleType) -> None:
    asked = [name for page in PAGES for name in re.findall(r"<!-- generated: ([\w-]+) -->", page.read_text("utf-8"))]
    assert sorted(asked) == sorted(generate.PARTS)


def test_every_unit_is_listed(generate: ModuleType, tmp_path: Path) -> None:
    listed = {word: si for si, own, also in rows(generate.units(tmp_path)) for word in f"{own} {also}".split()}
    assert listed == {unit: in_si(unit)[0] for unit in UNITS}
    assert {w for *_, also in rows(generate.units(tmp_path)) for w in also.split()} == set(SYNONYMS)


def test_every_command_and_option_is_listed(generate: ModuleType, tmp_path: Path) -> None:
    text = generate.commands(tmp_path)
    for name, command in registry().items():
        assert f"## pysim {name}\n" in text
        for option in command.options:
            assert option.about in text.replace("\\|", "|")


def test_every_effect_has_a_card_and_nearly_every_one_a_curve(generate: ModuleType, tmp_path: Path) -> None:
    text = generate.effects(tmp_path)
    names = {effect.name for effect in read_catalogue(STANDARD_LIBRARY)}
    assert {name for name in names if f"\n{name}\n" not in text} == set()
    drawn = {path.stem for path in (tmp_path / "generated").iterdir()}
    assert drawn <= names
    assert len(drawn) >= 17  # the others' laws need the model's own numbers


def test_every_setting_and_kind_of_log_is_listed(generate: ModuleType, tmp_path: Path) -> None:
    from pysim.diagnosis import settings

    text = generate.settings(tmp_path)
    kinds = [k for k in vars(settings).values() if inspect.isclass(k) and k.__module__ == settings.__name__]
    assert kinds
    for kind in kinds:
        assert all(f"| `{name}` |" in text for name in kind.__dataclass_fields__)
    assert [row[0] for row in rows(generate.record_kinds(tmp_path))] == list(KINDS)


def test_every_page_is_in_a_list_of_contents() -> None:
    listed = {DOCS / "index.md"}
    for page in PAGES:
        for words, _, content in blocks(page.read_text(encoding="utf-8")):
            if words == "{toctree}":
                listed |= {page.parent / f"{name}.md" for name in content.split() if not name.startswith(":")}
    assert set(PAGES) == listed


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(DOCS).as_posix())
def test_the_first_screen_shows_a_picture_or_a_table(page: Path) -> None:
    first = page.read_text(encoding="utf-8").split("\n")[:26]
    shows = ("|", "![", "<!-- generated", "```{code-cell}")  # a cell that draws
    assert any(line.startswith(shows) for line in first)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(DOCS).as_posix())
def test_examples_are_short(page: Path) -> None:
    """But for the cells of notebooks, which draw their own data."""
    for words, line, source in blocks(page.read_text(encoding="utf-8")):
        if words.partition(" ")[0] == "python":
            assert sum(bool(one.strip()) for one in source.splitlines()) <= 15, f"{page.name}, line {line}"


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("sphinx") is None, reason="the site's packages: python3 run.py docs")
def test_the_site_builds_without_a_warning_and_every_notebook_runs(tmp_path: Path) -> None:
    """Each notebook asserts what its page says; their seconds are printed."""
    notebooks = [page.stem for page in PAGES if "{code-cell}" in page.read_text("utf-8")]
    build = [
        sys.executable,
        "-m",
        "sphinx",
        "-W",
        "--keep-going",
        "-D",
        f"nb_execution_cache_path={tmp_path / 'cache'}",
    ]
    done = subprocess.run([*build, str(DOCS), str(tmp_path / "site")], capture_output=True, text=True, cwd=ROOT)
    ran = [line for line in done.stdout.splitlines() if "Executed notebook in" in line]
    print("\n".join(ran))
    assert done.returncode == 0, done.stderr[-3000:]
    assert sorted(Path(line.partition(":")[0]).stem for line in ran) == sorted(notebooks)
