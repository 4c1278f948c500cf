"""What the list of misprints says in numbers, worked out again; the cases it names are there."""

import math
import re
from pathlib import Path

import pytest

import validation.thesis
from pysim.cli._main import _COMMANDS
from validation.registry import CASES

FOLDER = Path(validation.thesis.__file__).parent
PAGES = ("MISPRINTS.md", "README.md")


@pytest.mark.parametrize("page", PAGES)
def test_cases_that_are_named_are_there(page: str) -> None:
    text = (FOLDER / page).read_text(encoding="utf-8")
    named = set(re.findall(r"`([a-z]+(?:-[a-z0-9]+)+|chirp|friction|tuning)`", text))
    assert named
    assert named <= set(CASES) | set(_COMMANDS)


def test_every_folder_is_in_the_list() -> None:
    text = (FOLDER / "README.md").read_text(encoding="utf-8")
    for path in FOLDER.glob("*/case.py"):
        assert f"`{path.parent.name.replace('_', '-')}`" in text


def test_flow_of_eq_3_22() -> None:
    speed = 1450 * 2 * math.pi / 60
    assert round(speed * 71e-6 * 60e3) == 647
    assert round(speed / (2 * math.pi) * 71e-6 * 60e3, 2) == 102.95


def test_factors_of_eq_3_63() -> None:
    assert round(0.6392 / (0.0198 * 102.95 * (1 - 2 / math.pi)), 4) == 0.8629
    assert round(0.0198 * 102.95, 3) == 2.038


def test_bounds_of_table_4_5() -> None:
    assert 0.00354 < 0.005305
    assert round(1 / (2 * math.pi * 30), 6) == 0.005305
    assert round(1 / (2 * math.pi * 45), 7) == 0.0035368


def test_volume_of_the_locked_cylinder() -> None:
    assert round(1260e-6 * 34.2e-3 / 2 * 1e6, 1) == 21.5
    assert 21.1 < 21.5


def test_resonance_of_eq_5_31() -> None:
    assert round(math.sqrt(2 * 1400e6 * 9.5493e-6**2 / (1.52e-3 * 0.0733)) / (2 * math.pi), 1) == 7.6


def test_tops_of_figure_2_7() -> None:
    assert round(20 * math.log10((75 + 20) / 20), 1) == 13.5
