"""Every method is shown by the same functions, and costs no Matplotlib until a figure is made."""

import pkgutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from pysim import present
from pysim.cli.command import Command
from pysim.cli.main import registry

BASE = {"notes", "page", "render", "report", "style", "ticks"}
METHODS = sorted({one.name for one in pkgutil.iter_modules(present.__path__)} - BASE)


@pytest.mark.parametrize("name", METHODS)
def test_a_method_has_all_that_a_command_needs(name: str) -> None:
    module = import_module(f"pysim.present.{name}")
    assert all(callable(getattr(module, part)) for part in ("text", "data", "figures", "page"))


def test_what_a_command_names_as_its_view_is_there() -> None:
    views = {one.view for one in registry().values() if isinstance(one, Command) and isinstance(one.view, str)} - {""}
    assert {view.removeprefix("pysim.present.") for view in views} <= set(METHODS)


def test_methods_are_imported_without_matplotlib() -> None:
    names = ", ".join(f"pysim.present.{name}" for name in METHODS)
    script = f"import sys, {names}; sys.exit('matplotlib' in sys.modules)"
    root = Path(present.__file__).parents[2]
    assert subprocess.run([sys.executable, "-c", script], check=False, cwd=root).returncode == 0
