"""What a diagnosis reports while it works."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from pysim.types.answer import ErrorStep

Step = TypeVar("Step")


@dataclass(frozen=True)
class ProgressEvent:
    """What is being done, and what came out of it; as text, a line.

    Args:
        stage: what it is doing now, in a few words.
        text: what came out, a line; "" where only the stage is new.
        step: of the error history, where one is done.
    """

    stage: str
    text: str = ""
    step: ErrorStep | None = None

    def __str__(self) -> str:
        return self.text or f"{self.stage} ..."


def standing(steps: Iterable[Step], name: Callable[[Step], str]) -> list[Step]:
    """Steps in the order they were found, without those of models that were found again later and all between."""
    found: list[Step] = []
    for step in steps:
        names = [name(one) for one in found]
        found = [*found[: names.index(name(step)) if name(step) in names else None], step]
    return found
