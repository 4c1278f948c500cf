"""What lies in the folder once a diagnosis is written."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.present import diagnosis, write_report
from pysim.present.diagnosis import Diagnosed
from pysim.types import Diagnosis, Missing, NextTest, Shape
from tests.pysim.cli.ran import undraw
from tests.pysim.diagnosis_story import dataset, nothing, story

RAMP = np.linspace(-1, 1, 11)
MISSING = Missing("force", 0.97, "v", Shape(RAMP, -0.4 * np.sign(RAMP), RAMP - 1, RAMP + 1, "m/s", "N"))
EMPTY = replace(MISSING, slot="supply", shape=Shape(*(np.zeros(0) for _ in range(4)), "Pa", "Pa"))
TEST = NextTest(("toy.offset", "toy.twin"), 42.0, "Run a slow ramp.", 'name = "ramp"\n')


@pytest.fixture(autouse=True)
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    undraw(monkeypatch)


def written(found: Diagnosis, folder: Path, question: str = "", answer: str = "") -> tuple[Diagnosed, dict[str, Path]]:
    """The result with its files named relative to the folder's parent, and the files."""
    result = Diagnosed(found, dataset(), "toy", question, answer)
    files = write_report(folder, result, redo="pysim diagnose x")
    return diagnosis.placed(result, files, folder.parent), files


def test_every_part_of_the_story_has_its_file(tmp_path: Path) -> None:
    found = story(missing=(MISSING, EMPTY), next_test=TEST)
    result, paths = written(found, tmp_path, "Why?", "Because.")
    files = result.files
    drawn = {name.removeprefix("picture ") for name in files if name.startswith("picture ")}
    several = {"ledger", "record_1", "record_2", "record_3", "where", "map", "spectrum", "ranking", "parameters"}
    assert drawn == several | {"missing_1"}  # the other term has no shape
    assert all((tmp_path / f"{name}.svg").is_file() for name in drawn)
    assert (tmp_path.parent / files["plan"]).read_text() == TEST.plan
    page = paths["report"].read_text()
    assert page.count("<img ") == len(drawn)
    assert all(text in page for text in ("Why?", "Because.", "next_test.toml"))
    assert set(files) == {"report", "plan", *(f"picture {name}" for name in drawn)}


def test_a_comparison_alone_draws_what_it_has(tmp_path: Path) -> None:
    full = nothing()
    found = replace(full, error=full.error[:1], stages=full.stages[:1], ranking=(), verdict="unknown", parameters=())
    result, _ = written(found, tmp_path, "?", "!")
    files = result.files
    drawn = {name.removeprefix("picture ") for name in files if name.startswith("picture ")}
    assert drawn == {"ledger", "record_1", "record_2", "record_3", "where", "map", "spectrum"}
