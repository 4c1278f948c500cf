"""Every method is shown by the same functions, and costs no Matplotlib until a figure is made."""

import pkgutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from pysim import present
from pysim.cli.main import registry
from pysim.present import data, fit, text
from pysim.present.fit import Fitted
from pysim.present.report import VIEWS
from tests.pysim.fits import small_fit

BASE = {"criteria", "notes", "page", "plain_text", "render", "report", "style", "ticks"}
METHODS = sorted({one.name for one in pkgutil.iter_modules(present.__path__)} - BASE)


def test_what_a_command_finds_is_shown_by_a_file_that_has_all_it_needs() -> None:
    commands = list(registry().values())
    commands += [part for one in commands for part in one.parts]
    for command in commands:
        found = command.run.__annotations__["return"].split(" | ") if command.run else ["int"]
        options = {option.key for option in command.options}
        needed = ["text", *["data"] * ("json" in options), *["figures", "page"] * ("output" in options)]
        for name in found:
            view = import_module(VIEWS[name]) if name != "int" else None
            assert view is None or all(callable(getattr(view, part)) for part in needed), (command.name, name)


@pytest.mark.parametrize("name", VIEWS)
def test_a_type_is_exported_where_it_is_shown(name: str) -> None:
    view = import_module(VIEWS[name])
    assert isinstance(getattr(view, name), type)
    assert callable(view.text)


def test_a_result_is_shown_by_what_it_is() -> None:
    result = Fitted(small_fit(), ())
    assert text(result) == fit.text(result)
    assert data(result) == fit.data(result) == data(small_fit())
    assert text(small_fit()) == fit.text(result)
    namesake = type("Fitted", (), {})()
    for unknown in (namesake, 3.0):
        with pytest.raises(TypeError, match="nothing in pysim"):
            text(unknown)


def test_methods_are_imported_without_matplotlib() -> None:
    names = ", ".join(f"pysim.present.{name}" for name in METHODS)
    script = f"import sys, {names}; sys.exit('matplotlib' in sys.modules)"
    root = Path(present.__file__).parents[2]
    assert subprocess.run([sys.executable, "-c", script], check=False, cwd=root).returncode == 0
