"""What lies in the folder once a diagnosis is written."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from pysim.cli._diagnosis_report import write_diagnosis
from pysim.cli._subject import Given
from pysim.types import Missing, NextTest, Shape
from tests.pysim.diagnose.toy import measured, toy_subject
from tests.pysim.diagnosis_story import dataset, nothing, story

RAMP = np.linspace(-1, 1, 11)
MISSING = Missing("force", 0.97, "v", Shape(RAMP, -0.4 * np.sign(RAMP), RAMP - 1, RAMP + 1, "m/s", "N"))
EMPTY = replace(MISSING, slot="supply", shape=Shape(*(np.zeros(0) for _ in range(4)), "Pa", "Pa"))
TEST = NextTest(("toy.offset", "toy.twin"), 42.0, "Run a slow ramp.", 'name = "ramp"\n')


def given() -> Given:
    return Given(toy_subject(measured(0)), dataset(), None, {}, ())


def test_every_part_of_the_story_has_its_file(tmp_path: Path) -> None:
    found = story(missing=(MISSING, EMPTY), next_test=TEST)
    files = write_diagnosis(found, given(), tmp_path, "pysim diagnose x", question="Why?", answer="Because.")
    drawn = {name.removeprefix("picture ") for name in files if name.startswith("picture ")}
    several = {"ledger", "record_1", "record_2", "record_3", "where", "map", "spectrum", "ranking", "parameters"}
    assert drawn == several | {"missing_1"}  # the other term has no shape
    assert all((tmp_path / f"{name}.svg").is_file() for name in drawn)
    assert files["plan"].read_text() == TEST.plan
    page = files["report"].read_text()
    assert page.count("<img ") == len(drawn)
    assert all(text in page for text in ("Why?", "Because.", "next_test.toml"))
    assert set(files) == {"report", "parameters", "plan", *(f"picture {name}" for name in drawn)}


def test_a_comparison_alone_draws_what_it_has(tmp_path: Path) -> None:
    full = nothing()
    found = replace(full, error=full.error[:1], stages=full.stages[:1], ranking=(), verdict="unknown", parameters=())
    files = write_diagnosis(found, given(), tmp_path, "x", question="?", answer="!")
    drawn = {name.removeprefix("picture ") for name in files if name.startswith("picture ")}
    assert drawn == {"ledger", "record_1", "record_2", "record_3", "where", "map", "spectrum"}
    assert "parameters" not in files
