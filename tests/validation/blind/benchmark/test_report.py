"""Tables, pictures and README of made-up answers."""

import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.types import BadInput
from validation.blind.benchmark import tables
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.carry import Carried
from validation.blind.benchmark.figures import Pair, figures, paired
from validation.blind.benchmark.kept import Kept
from validation.blind.benchmark.pictures import LEFT_OUT, confusion, confusion_picture, naming_picture
from validation.blind.benchmark.report import BEGIN, END, write_report
from validation.blind.plant import Case, cases

TABLE = cases(1)[::5]


def made_up(case: Case) -> Answer:
    """Right where the footprint is large, else silent."""
    rng = np.random.default_rng(zlib.crc32(case.name.encode()))
    footprint = float(10 ** rng.uniform(0, 6)) if case.effects else None
    verdict = case.expected[0] if (footprint or 1e6) > 60 else "none"
    added = case.expected if verdict not in ("none", "unknown") else ()
    return Answer(
        case.name, "c0de", "2026-01-02", verdict, added, added[:2], footprint=footprint, held=1.0, base=1.0,
        final=0.01, bound=0.02, determined=9, missed=("tau",) if rng.uniform() < 0.4 else (), wall=30.0, cpu=29.0,
    )  # fmt: skip


ANSWERS = {case.name: made_up(case) for case in TABLE}


@pytest.fixture
def named() -> list[Pair]:
    return [pair for pair in paired(TABLE, ANSWERS) if pair[0].kind == "named"]


def test_readme_keeps_what_is_written_by_hand(tmp_path: Path) -> None:
    readme = tmp_path / "README.md"
    readme.write_text(f"# Mine\n\n{BEGIN}\nof yesterday\n{END}\n\nTail.\n")
    written = write_report(TABLE, Kept(ANSWERS), tmp_path)
    assert [path.name for path in written] == ["README.md", "naming.png", "confusion.png"]
    text = readme.read_text()
    assert text.startswith("# Mine\n")
    assert text.endswith("Tail.\n")
    assert "of yesterday" not in text
    assert f"{len(TABLE)} of {len(TABLE)} cases answered." in text
    assert f"Code `c0de`: {len(TABLE)} cases, 2026-01-02." in text
    assert all(path.stat().st_size > 5000 for path in written[1:])
    write_report(TABLE, Kept(ANSWERS), tmp_path)
    assert readme.read_text() == text


def test_why_older_answers_count_and_how_many_do_not() -> None:
    step = Carried("0ld", "n3w", "2026-02-03", 7, ("a", "b"))
    text = list(tables.provenance(paired(TABLE, ANSWERS), len(TABLE), Kept(ANSWERS, stale=4, carried=(step,))))
    assert "Code `n3w` answers as `0ld` did: 2 cases, drawn with seed 7, were answered again on 2026-02-03" in text[2]
    but = list(tables.provenance([], 2, Kept({}, carried=(replace(step, but=("x-*", "y")),))))
    assert but[1].startswith("- Code `n3w` answers as `0ld` did, but for `x-*` and `y`: 2 cases")
    assert text[3] == "- 4 stored answers of other code are not counted."


def test_readme_without_marks_is_refused(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("# Mine\n")
    with pytest.raises(BadInput, match="must stand there once each"):
        write_report(TABLE, Kept(ANSWERS), tmp_path)


def test_nothing_answered_is_a_report_too(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text(f"{BEGIN}\n{END}\n")
    write_report(TABLE, Kept(), tmp_path)
    assert f"0 of {len(TABLE)} cases answered." in (tmp_path / "README.md").read_text()


def test_every_figure_is_a_row() -> None:
    found = figures(TABLE, Kept(ANSWERS))
    rows = list(tables.figure_table(found))[2:]
    assert len(rows) == len(found)
    for figure, row in zip(found, rows, strict=True):
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        assert cells[1] == f"{figure.hits} of {figure.of}"
        assert cells[5] == {None: "", True: "yes", False: "**no**"}[figure.holds]


def test_confusion_counts_every_case_once_but_pairs() -> None:
    found = confusion(paired(TABLE, ANSWERS))
    assert sum(sum(row.values()) for row in found.values()) == sum(case.kind != "pair" for case in TABLE)
    assert set(found[LEFT_OUT]) <= {"unknown", "none"}
    left_out = [case for case in TABLE if case.kind == "left-out"]
    assert sum(found[LEFT_OUT].values()) == len(left_out)
    text = list(tables.confusion_table(paired(TABLE, ANSWERS)))
    assert len(text) == len(found) + 2


def test_sizes_show_right_tied_and_missed(named: list[Pair]) -> None:
    case = next(c for c in cases(1) if c.name == "named-oil.air-large-n0.1-u")
    angle = next(c for c in cases(1) if c.name == "named-oil.air-large-n0.1-angle")
    right = Answer(case.name, "c", "d", "oil.air", ("oil.air",), footprint=1234.0)
    tie = replace(right, verdict="sensor.lag", confusable=(("oil.air", "sensor.lag"),), footprint=321.0)
    row = next(row for row in tables.sizes([(case, right), (angle, tie)]) if row.startswith("| oil.air"))
    assert "| u= 3.2e+02 |" in row
    missed = next(tables.misses(named))
    assert f"tau {sum('tau' in answer.missed for _, answer in named)}." in missed


def test_where_naming_becomes_impossible(named: list[Pair]) -> None:
    text = list(tables.impossible(named))
    assert "half of the effects are named at a footprint of" in text[0]
    half = float(text[0].split("footprint of ")[1].split(",")[0])
    assert 20 < half < 180  # made up with 60
    assert list(tables.impossible([])) == []


def test_pictures_show_what_is_there(named: list[Pair]) -> None:
    naming = naming_picture(named).axes[0]
    points = [line for line in naming.lines if line.get_marker() == "o"]
    shown = {round(float(line.get_ydata()[0])) for line in points}  # type: ignore[arg-type, index]
    assert {0, 100} <= shown
    axes = confusion_picture(paired(TABLE, ANSWERS)).axes[0]
    numbers = sum(int(text.get_text()) for text in axes.texts)
    assert numbers == sum(case.kind != "pair" for case in TABLE)
