"""What the page Add says beside the numbers."""

from types import SimpleNamespace
from typing import Any

from pysim.app.pages.add import doubts


def answer(**data: Any) -> Any:
    return SimpleNamespace(data={"notes": [{"text": "b"}, {"text": "c"}], **data}, last={"step": "toy.friction"})


def test_why_not_to_trust_the_last_model_comes_first_and_nothing_twice() -> None:
    assert doubts(answer(warnings={"refit": ["x"], "toy.friction": ["a", "b"]})) == ["a", "b", "c"]


def test_answers_of_an_earlier_version_have_notes_alone() -> None:
    assert doubts(answer()) == ["b", "c"]
