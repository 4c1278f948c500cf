"""Every method is shown by the same functions, and costs no Matplotlib until a figure is made."""

import pkgutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

from pysim import present
from pysim.cli.main import registry

BASE = {"notes", "page", "render", "report", "style", "ticks"}
METHODS = sorted({one.name for one in pkgutil.iter_modules(present.__path__)} - BASE)


def test_every_view_has_all_that_its_command_needs() -> None:
    commands = list(registry().values())
    commands += [part for one in commands for part in one.parts]
    views = {one.view: "output" in {option.key for option in one.options} for one in commands}
    for view, reports in views.items():
        if isinstance(view, str) and view:
            needed = ("text", "data", *(("figures", "page") if reports else ()))
            assert all(callable(getattr(import_module(view), part)) for part in needed), view


def test_methods_are_imported_without_matplotlib() -> None:
    names = ", ".join(f"pysim.present.{name}" for name in METHODS)
    script = f"import sys, {names}; sys.exit('matplotlib' in sys.modules)"
    root = Path(present.__file__).parents[2]
    assert subprocess.run([sys.executable, "-c", script], check=False, cwd=root).returncode == 0
