"""What a diagnosis reports while it works."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types.answer import ErrorStep


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
