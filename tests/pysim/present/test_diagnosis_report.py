"""What lies in the folder once a diagnosis is written, and that the answer alone can be shown."""

from dataclasses import replace
from pathlib import Path, PurePath, PurePosixPath, PureWindowsPath

import numpy as np
import pytest

from pysim.present import data, diagnosis, text, write_report
from pysim.present.diagnosis import Diagnosed
from pysim.present.diagnosis.answer import seen_from
from pysim.types import Diagnosis, NextTest
from tests.pysim.cli.ran import undraw
from tests.pysim.diagnosis_answer import LAW, dataset, found_offset, nothing

EMPTY = replace(LAW, slot="supply", knots=np.zeros(0), coefficients=np.zeros(0), covariance=np.zeros((0, 0)))
TEST = NextTest(("toy.offset", "toy.twin"), 42.0, (), ("x",), {}, 'name = "ramp"\n')


@pytest.fixture(autouse=True)
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    undraw(monkeypatch)


def written(found: Diagnosis, folder: Path, question: str = "", answer: str = "") -> tuple[Diagnosed, dict[str, Path]]:
    """The result with its files named relative to the folder's parent, and the files."""
    result = Diagnosed(found, dataset(), "toy", question, answer)
    files = write_report(folder, result, redo="pysim diagnose x")
    return diagnosis.placed(result, files, folder.parent), files


def pictures(result: Diagnosed) -> set[str]:
    return {name.removeprefix("picture ") for name in result.files if name.startswith("picture ")}


def test_every_part_of_the_answer_has_its_file(tmp_path: Path) -> None:
    result, paths = written(found_offset(learned=(LAW, EMPTY), next_test=TEST), tmp_path, "Why?", "Because.")
    several = {"error", "record_1", "record_2", "record_3", "map", "spectrum", "candidates", "parameters"}
    assert pictures(result) == several | {"law_1"}  # the other law has no curve
    assert all((tmp_path / f"{name}.svg").is_file() for name in pictures(result))
    assert (tmp_path.parent / result.files["plan"]).read_text() == TEST.plan
    page = paths["report"].read_text()
    assert page.count("<img ") == len(pictures(result))
    assert all(part in page for part in ("Why?", "Because.", "next_test.toml", "pysim diagnose x"))
    assert set(result.files) == {"report", "plan", *(f"picture {name}" for name in pictures(result))}


def test_a_comparison_alone_draws_what_it_has(tmp_path: Path) -> None:
    full = nothing()
    found = replace(full, history=full.history[:1], rivals=(), complete=False, estimates=())
    result, _ = written(found, tmp_path, "?", "!")
    assert pictures(result) == {"error", "record_1", "record_2", "record_3", "map", "spectrum"}


def test_a_bare_answer_is_shown_by_its_type(tmp_path: Path) -> None:
    found = found_offset()
    assert text(found).startswith("Verdict: toy.offset\n")
    assert data(found)["verdict"] == "toy.offset"
    page = write_report(tmp_path, found)["report"].read_text()
    assert "toy.offset" in page
    assert "Do it again" not in page


@pytest.mark.parametrize(
    ("folder", "path", "seen"),
    [
        (PureWindowsPath("C:/a/b"), PureWindowsPath("D:/c/report.html"), "D:/c/report.html"),
        (PureWindowsPath("C:/a/b"), PureWindowsPath("C:/a/c/d.png"), "../c/d.png"),
        (PurePosixPath("/a/b"), PurePosixPath("/a/b/d.png"), "d.png"),
    ],
)
def test_a_file_is_named_from_the_folder_of_its_json(folder: PurePath, path: PurePath, seen: str) -> None:
    assert seen_from(folder, path) == seen
