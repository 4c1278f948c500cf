"""What the worker does is what the command line does, in a folder that both can go on with."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from pysim.app import tasks
from pysim.app.jobs import ANSWER, CURVES, Job, Work, _write_job, works
from pysim.app.project import Project
from pysim.app.tasks import Tasks
from pysim.cli import main
from pysim.diagnosis import learn
from pysim.workflow import LawPlace, effect_class
from pysim.workflow.own_law import Range
from tests.pysim.app.made import rubbing
from tests.toy import TEXT


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    one = rubbing(tmp_path / "project")
    monkeypatch.chdir(one.folder)
    return one


def done(project: Project, name: str, own: Tasks) -> Path:
    """The folder of a result."""
    work, folder = works(project)[name], project.results(name)
    folder.mkdir(parents=True)
    _write_job(Job(work, "done", 0.0, 1.0, project.fingerprint()), folder)
    own.step(work)
    return folder


def answer(folder: Path) -> dict[str, object]:
    """But for what differs from run to run, and in which order its words were typed."""
    found = json.loads((folder / ANSWER).read_text())
    found["conditions"].pop("command")
    return {k: v for k, v in found.items() if k not in ("seconds", "files")}


@pytest.mark.slow
def test_the_answer_is_that_of_the_command_line_which_takes_the_folder_over(project: Project) -> None:
    folder = done(project, "compare", Tasks(project.folder))
    assert (folder / "report/parameters.toml").is_file()
    assert not list(folder.glob("**/*.png"))  # nobody has asked for a picture
    before = answer(folder)
    assert main(list(works(project)["compare"].words)) in (0, 1)
    assert answer(folder) == before


def test_a_log_is_drawn_beside_the_best_point_while_the_search_runs(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "QUICK", 0.0)  # else a search that takes less is not drawn
    own = Tasks(project.folder)
    folder = done(project, "compare", own)
    drawn = json.loads((folder / CURVES).read_text())
    trials = [json.loads(line)["trial"] for line in (folder / "events.jsonl").read_text().splitlines()]
    shown = next(one for one in trials if one and one["error"] == drawn["error"])
    assert drawn["simulated"] == own.curves(0, shown["values"])["simulated"].tolist()
    assert shown["error"] <= trials[0]["error"] if trials[0] else True


@pytest.mark.slow
def test_a_report_is_drawn_when_it_is_asked_for_and_after_a_restart_too(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = Tasks(project.folder)
    folder = done(project, "compare", own)
    named = json.loads((folder / ANSWER).read_text())["files"]["report"]
    own.report("compare")
    assert "<html" in (folder / named).read_text()
    first = {path.name: path.read_bytes() for path in (folder / "report").glob("*.png")}
    steps: list[Work] = []
    told = Tasks._function
    monkeypatch.setattr(Tasks, "_function", lambda self, work, parts: steps.append(work) or told(self, work, parts))
    own.report("compare")  # it is kept
    assert steps == []
    Tasks(project.folder).report("compare")
    assert [one.name for one in steps] == ["compare"]
    assert {path.name: path.read_bytes() for path in (folder / "report").glob("*.png")} == first != {}


def test_where_something_is_missing_is_asked_of_the_model_with_its_effects(project: Project) -> None:
    project.laws.mkdir()
    (project.laws / "MyDrag.mo").write_text("")
    project.change(added=("toy.friction", "my.drag"))
    work = works(project)["locate"]
    assert (work.kind, work.effects) == ("locate", ("toy.friction", "my.drag"))
    words = " ".join(work.words)
    assert "--library laws/MyDrag.mo --with toy.friction --with my.drag" in words
    (project.laws / "MyDrag.mo").unlink()
    own = Tasks(project.folder)
    step = own._function(replace(work, effects=("toy.friction", "offset of x")), own._opened(works(project)["locate"]))
    assert step.func is learn  # type: ignore[attr-defined]
    assert [one.name for one in step.args[1]] == ["toy.friction"]  # type: ignore[attr-defined]


def test_models_and_data_are_opened_once_while_they_stay_as_they_are(project: Project) -> None:
    own = Tasks(project.folder)
    work = works(project)["compare"]
    before = own._opened(work)
    assert own._opened(works(project)["locate"]) is before
    (project.models / "Toy.mo").write_text(f"{TEXT}\n")
    assert own._opened(work) is not before


@pytest.mark.slow
def test_a_law_of_the_user_is_tried_with_every_effect_that_fits(project: Project) -> None:
    place = LawPlace.of("Toy.Mass", "force", [project.models / "Toy.mo"])
    law = effect_class("my.rubbing", place.slot, "-F*tanh(v/0.02)", {"F": Range(-2.0, 2.0, 0.4, "N")}, place.libraries)
    project.laws.mkdir()
    (project.laws / "MyRubbing.mo").write_text(law)
    own = Tasks(project.folder)
    folder = done(project, "rank", own)
    assert "my.rubbing" in {one["name"] for one in own.model()["effects"]}  # those that the page counts
    assert "my.rubbing" in {one["effect"] for one in answer(folder)["ranking"]}  # type: ignore[attr-defined]
