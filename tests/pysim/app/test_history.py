"""Undo and redo of what was chosen give the same bytes."""

from pathlib import Path

from pysim.app.history import CHOICES, History, changed
from pysim.app.project import Project
from tests.pysim.app.made import description


def test_undo_and_redo_give_the_same_bytes(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "project")
    history, states = History(project), []
    project.data.mkdir()
    for step in (
        lambda: project.change(model="A.B"),
        lambda: project.set_values({"m": 0.1, "slot.F": 1e-7}),
        lambda: project.description.write_bytes(b"[dataset]\r\n"),
        lambda: project.set_values({}),
    ):
        states.append(_bytes(project))
        step()
        history.look()
    states.append(_bytes(project))
    for state in reversed(states[:-1]):
        history.undo()
        assert _bytes(project) == state
    history.undo()  # nothing is left
    assert _bytes(project) == states[0]
    for state in states[1:]:
        history.redo()
        assert _bytes(project) == state


def test_a_new_choice_forgets_what_was_undone_and_other_logs_forget_all(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "project")
    history = History(project)
    project.change(model="A")
    history.undo()
    assert project.settings().model == ""
    project.change(model="B")
    history.redo()  # nothing: B was chosen since
    assert project.settings().model == "B"
    history.begin_anew()
    history.undo()
    assert project.settings().model == "B"


def test_what_was_chosen_otherwise_is_said(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "project")
    project.data.mkdir()
    project.description.write_text(description("a.txt"))
    history = History(project)

    def told() -> str:
        before = history.now
        history.look()
        assert changed(history.now, before) == changed(before, history.now)
        return changed(before, history.now)

    project.set_values({"k": 2.0, "model": 1.0})
    assert told() == "k and model"
    project.set_values({"k": 3.0, "model": 1.0})
    project.change(bounds=("k=1:2",), look="dark")
    before = history.now
    assert told() == "the look, the bounds and k"
    assert changed(before, history.now, CHOICES) == "the bounds and k"
    text = project.description.read_text()
    project.description.write_text(f'{text}use = "validate"\n')
    assert told() == "what logs are used for"
    project.description.write_text(text.replace('unit = "m"', 'unit = "mm"'))
    assert told() == "the logs and what logs are used for"
    assert told() == ""


def _bytes(project: Project) -> list[bytes | None]:
    return [path.read_bytes() if path.is_file() else None for path in project.choices]
