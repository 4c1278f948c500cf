"""What a fit and a diagnosis report while they work."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from pysim.types._frozen import FrozenMapping
from pysim.types.answer import ErrorStep


@dataclass(frozen=True)
class Trial:
    """A point of a search.

    Args:
        names: effects, sensor errors and the law that the model has besides; none of the base model.
        error: residual over noise of what is fitted, at the best point so far.
        values: of the free parameters there, in the model's units; an effect's own as `effect.parameter`.
    """

    names: tuple[str, ...]
    error: float
    values: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", FrozenMapping(self.values))


@dataclass(frozen=True)
class ProgressEvent:
    """What is being done, and what came out of it; as text, a line.

    Args:
        stage: what it is doing now, in a few words.
        text: what came out, a line; "" where only the stage is new.
        step: of the error history, where one is done.
        trial: a point of the search, where one was tried.
    """

    stage: str
    text: str = ""
    step: ErrorStep | None = None
    trial: Trial | None = None

    def __str__(self) -> str:
        return self.text or f"{self.stage} ..."
