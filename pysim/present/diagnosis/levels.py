"""The falling error as every picture of it has it: a line per use of logs, and the range and numbers of its axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from pysim.present.diagnosis.words import errors
from pysim.present.notes import USES
from pysim.types import ErrorStep

_TICKS = tuple(digit * 10.0**power for power in range(-2, 7) for digit in (1, 2, 5))


@dataclass(frozen=True)
class Levels:
    """What is drawn.

    Args:
        lines: use of logs -> its residual over noise at each step, None where that is not known.
        low, high: ends of the axis.
        ticks: numbers on it.
    """

    lines: Mapping[str, tuple[float | None, ...]]
    low: float
    high: float
    ticks: tuple[float, ...]


def levels(steps: Sequence[ErrorStep]) -> Levels:
    """Of an error history; a use of which there are no logs has no line."""
    lines = {use: tuple(errors(step).get(use) for step in steps) for use in USES.values()}
    known = [value for values in lines.values() for value in values if value]
    low, high = min([0.72, *(0.72 * v for v in known)]), max([1.6, *(1.7 * v for v in known)])
    shown = {use: values for use, values in lines.items() if any(value is not None for value in values)}
    return Levels(shown, low, high, tuple(t for t in _TICKS if low <= t <= high))
