"""What is taken away: the lines that make every result again."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

from pysim.app.pages.take import classes, commands
from pysim.workflow import command_line

FOLDER = Path("project")


def desk(*done: tuple[str, ...]) -> Any:
    """With results of these words, the newest first."""
    answers = [SimpleNamespace(job=SimpleNamespace(work=SimpleNamespace(words=words))) for words in done]
    return SimpleNamespace(answers=SimpleNamespace(all=answers), project=SimpleNamespace(folder=FOLDER))


def test_lines_are_those_that_work_in_the_project_the_oldest_first() -> None:
    lines = [command_line(words, FOLDER) for words in (["compare", "M"], ["rank", "data"])]
    assert commands(desk(("rank", "data"), ("compare", "M"))).splitlines() == lines


def test_without_a_result_the_data_are_looked_at() -> None:
    assert commands(desk()) == command_line(["data", "check", "data"], FOLDER)


def test_all_classes_are_offered_the_extended_one_first() -> None:
    files = {"MyDrag": "report/MyDrag.mo", "modelica": "report/MassWithMyDrag.mo", "fmu": "report/MassWithMyDrag.fmu"}
    assert classes(files) == ["report/MassWithMyDrag.mo", "report/MyDrag.mo"]
    assert classes({"fmu": "report/Other.fmu"}) == []
