"""Every case can be found, says where it belongs, and the quick ones together are quick."""

from importlib import import_module
from pathlib import Path

import pytest

import validation
from validation.registry import CASES, GROUPS

QUICK_SECONDS = 300.0  # what continuous integration may take
ALL_SECONDS = 3600.0


@pytest.mark.parametrize("name", CASES)
def test_every_case_has_a_run(name: str) -> None:
    assert callable(import_module(CASES[name].module).run)
    assert CASES[name].group in GROUPS
    assert name != "fmu", "the command takes this word for something else"


@pytest.mark.parametrize("name", CASES)
def test_every_case_has_a_page(name: str) -> None:
    assert (Path(str(validation.__file__)).parent / CASES[name].readme).is_file()


def test_the_quick_set_is_quick_and_all_take_an_hour() -> None:
    quick = [case.seconds for case in CASES.values() if case.quick]
    assert quick
    assert sum(quick) < QUICK_SECONDS
    assert sum(case.seconds for case in CASES.values()) < ALL_SECONDS
