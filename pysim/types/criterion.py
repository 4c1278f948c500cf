"""A limit on how far a model may be from its measurements, and how far it is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Criterion:
    """An upper limit, inclusive, with where it comes from."""

    name: str
    symbol: str
    limit: float
    unit: str
    source: str


@dataclass(frozen=True)
class Deviation:
    """The value that a criterion limits, in the criterion's unit."""

    criterion: Criterion
    value: float

    @property
    def passes(self) -> bool:
        """Whether the value is within the limit; what is not a number is not."""
        return self.value <= self.criterion.limit
