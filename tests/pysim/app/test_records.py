"""A record on the screen: the samples that were measured and simulated, and what is left over."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pysim import present
from pysim.app.answers import Answers, current, history
from pysim.app.jobs import ANSWER, RECORDS
from pysim.app.project import Project
from pysim.app.records import compared_overlay, decimated, measured_overlay, stage_keys, window
from pysim.io import write_stages
from pysim.present.diagnosis.figures.error import error_chart
from pysim.present.parameters import parameters_chart
from pysim.types import read_step
from tests.pysim.diagnosis_answer import dataset, found_offset


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """With the toy's diagnosis as its only result."""
    project = Project.at(tmp_path / "project")
    folder = project.results("diagnose")
    folder.mkdir(parents=True)
    (folder / ANSWER).write_text(json.dumps(present.data(found_offset())))
    write_stages(folder / RECORDS, found_offset().history)
    work = {"name": "diagnose", "title": "Find", "words": ["diagnose"], "effects": []}
    head = {"work": work, "state": "done", "begun": 1.0, "ended": 2.0, "message": ""}
    (folder / "job.json").write_text(json.dumps({**head, "fingerprint": project.fingerprint()}))
    return project


def test_answers_are_those_of_the_data_and_model_as_they_are(project: Project) -> None:
    (answer,) = Answers.of(project).all
    assert Answers.of(project).with_effects(("toy.offset",)) == answer
    assert Answers.of(project).with_effects(()) == answer  # it has the refitted model too
    assert Answers.of(project).with_effects(("toy.twin",)) is None
    assert [step["step"] for step in history(answer, ())] == ["prior", "refit"]
    assert [step["fit"] for step in history(answer, answer.added)] == [8.1, 4.2, 1.0]
    assert [current(answer, added)["step"] for added in ((), answer.added)] == ["refit", "toy.offset"]
    project.change(model="Another")
    assert Answers.of(project).all == ()


def located(project: Project, *effects: str) -> None:
    """The same answer as one of where something is missing in the model with some effects."""
    folder, head = project.results("locate"), json.loads((project.results("diagnose") / "job.json").read_text())
    shutil.copytree(project.results("diagnose"), folder, dirs_exist_ok=True)
    data = json.loads((folder / ANSWER).read_text()) | {"missing": [{"slot": "force"}]}
    (folder / ANSWER).write_text(json.dumps(data))
    work = {**head["work"], "name": "locate", "effects": effects}
    (folder / "job.json").write_text(json.dumps({**head, "work": work, "ended": 3.0}))


def test_what_is_located_belongs_to_the_model_that_was_asked_about(project: Project) -> None:
    for effects in ((), ("toy.offset",)):
        located(project, *effects)
        found = Answers.of(project)
        newest = found.newest("missing", ("toy.offset",))
        assert newest is not None
        assert (newest.job.work.kind, newest.asked) == ("locate", effects)
        shown = found.with_effects(("toy.offset",))  # a law may stand at its end, which is no model of the user
        assert shown is not None
        assert shown.job.work.kind == "diagnose"


@pytest.mark.parametrize(
    ("kind", "steps"), [("diagnose", ["prior", "refit", "force: h(v)"]), ("locate", ["prior", "refit"])]
)
def test_a_law_that_was_learned_is_a_step_where_it_was_added(project: Project, kind: str, steps: list[str]) -> None:
    """Find adds it to the model; Locate only asks what it would do. A ranking afterwards takes it from nobody."""
    folder = project.results("diagnose")
    found = found_offset()
    learned = replace(found, effects=(), history=(*found.history[:2], replace(found.history[2], step="force: h(v)")))
    (folder / ANSWER).write_text(json.dumps(present.data(learned)))
    write_stages(folder / RECORDS, learned.history)
    head = json.loads((folder / "job.json").read_text())
    (folder / "job.json").write_text(json.dumps(head | {"work": head["work"] | {"name": kind}}))
    ranked = project.results("rank")
    ranked.mkdir()
    (ranked / ANSWER).write_text(json.dumps(present.data(replace(learned, history=found.history[:2]))))
    write_stages(ranked / RECORDS, found.history[:2])
    (ranked / "job.json").write_text(json.dumps(head | {"work": head["work"] | {"name": "rank"}, "ended": 0.5}))
    answer = Answers.of(project).with_effects(())
    assert answer is not None
    assert [step["step"] for step in history(answer, ())] == steps
    assert (answer.last is answer.base) == (len(steps) == 2)


@pytest.mark.parametrize("way", ["an older form of the records", "an older form of the answer", "cut short"])
def test_a_result_of_another_version_is_named_and_not_read(project: Project, way: str) -> None:
    folder = project.results("diagnose")
    if way == "an older form of the records":
        about = np.frombuffer(json.dumps({"form": 1, "stages": []}).encode(), dtype=np.uint8)
        np.savez(folder / RECORDS, about=about)
    elif way == "an older form of the answer":
        (folder / ANSWER).write_text(json.dumps({"verdict": "none", "ledger": []}))
    else:
        (folder / ANSWER).write_text('{"verdict": ')
    found = Answers.of(project)
    assert found.all == ()
    assert [work.title for work in found.unreadable] == ["Find"]
    project.change(model="Another")  # what is of other data is none of today's business
    assert Answers.of(project).unreadable == ()


def test_lines_are_the_samples_and_the_residual_over_noise(project: Project) -> None:
    (answer,) = Answers.of(project).all
    overlay = compared_overlay(answer, 2)
    assert overlay is not None
    assert [key for key, _, _ in stage_keys(answer)] == ["prior", "refit", "last"]
    truth = next(record for record in found_offset().history[-1].records if record.source == "wave.txt")
    lines = {(line.key, line.panel): line for line in overlay.lines}
    measured = found_offset().history[0].records[2].measured
    assert lines["measured", 1].values == pytest.approx(1000 * measured["x"])  # mm
    assert lines["last", 2].values == pytest.approx(truth.residual["x"])
    assert ("prior", 2) not in lines
    assert overlay.units == ("mm",)
    x, y, exact = overlay.samples(*overlay.span)
    assert exact
    assert len(x) == len(y) == len(overlay.lines)
    _, part, exact = overlay.samples(*overlay.span, most=100)
    assert not exact
    assert max(len(one) for one in part) <= 100
    assert compared_overlay(answer, 4) is None


def test_before_anything_was_compared_the_log_alone_is_shown() -> None:
    overlay = measured_overlay(dataset().records[0])
    assert [line.panel for line in overlay.lines] == [1, 2]
    assert np.array_equal(overlay.lines[0].time, np.arange(2.0))


def test_the_picture_of_the_error_shows_every_error() -> None:
    steps = present.data(found_offset())["error"]
    figure = error_chart([read_step(step) for step in steps])  # type: ignore[attr-defined]
    told = [note["text"] for note in figure["layout"]["annotations"]]
    assert told[:6] == ["<b>8.10</b>", "<b>8.00</b>", "<b>4.20</b>", "<b>3.20</b>", "<b>1.01</b>", "<b>1.00</b>"]


def test_parameters_stand_between_their_bounds() -> None:
    row = {"name": "m", "lower": 0.0, "upper": 10.0, "before": (2.0, 1.0, 4.0), "after": None}
    (before,) = parameters_chart([row])["data"]
    assert before["x"] == [20.0]
    assert (before["error_x"]["array"], before["error_x"]["arrayminus"]) == ([20.0], [10.0])


@given(st.integers(2000, 20000), st.integers(4, 1600), st.integers(0, 2**31))
def test_every_peak_is_kept_among_few_points(count: int, most: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    time, values = np.arange(count) * 0.01, rng.standard_normal(count)
    x, y = decimated(time, values, most)
    assert x.size <= max(most, 4)
    assert (y.min(), y.max()) == (values.min(), values.max())
    assert (x[0], x[-1]) == (time[0], time[-1])
    assert np.all(np.diff(x) > 0)
    assert np.array_equal(values[np.searchsorted(time, x)], y)  # samples, nothing in between


def test_few_samples_come_back_as_they_are() -> None:
    time, values = np.arange(50.0), np.arange(50.0) ** 2
    x, y = decimated(time, values, 50)
    assert x is time
    assert y is values


def test_a_window_reaches_over_both_edges() -> None:
    time = np.arange(10.0)
    assert window(time, 2.5, 5.5) == slice(2, 8)
    assert window(time, -5.0, 50.0) == slice(0, 10)
