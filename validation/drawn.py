"""A few of many at random, drawn anew every day: what a check that cannot look at all looks at."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import TypeVar

import numpy as np

T = TypeVar("T")


def of_the_day() -> int:
    """A seed that every day has for itself; a claim tells it, so that the draw can be had again."""
    return datetime.now(UTC).date().toordinal()


def drawn(things: Sequence[T], count: int, seed: int) -> list[T]:
    """So many of them, or all where there are no more."""
    return [things[i] for i in np.random.default_rng(seed).permutation(len(things))[:count].tolist()]
