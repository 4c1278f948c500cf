"""What is taken away: the lines that make every result again."""

from types import SimpleNamespace
from typing import Any

from pysim.app.pages.take import commands


def desk(*done: tuple[str, ...]) -> Any:
    """With results of these words, the newest first."""
    answers = [SimpleNamespace(job=SimpleNamespace(work=SimpleNamespace(words=words))) for words in done]
    return SimpleNamespace(answers=SimpleNamespace(all=answers), redo=lambda words: f"run.py pysim {' '.join(words)}")


def test_lines_are_those_that_work_where_the_page_was_started_the_oldest_first() -> None:
    assert commands(desk(("rank", "data"), ("compare", "M"))) == "run.py pysim compare M\nrun.py pysim rank data"


def test_without_a_result_the_data_are_looked_at() -> None:
    assert commands(desk()) == "run.py pysim data check data"
