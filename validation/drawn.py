"""A few of many at random, others every day: what a check that cannot look at all looks at."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import TypeVar

import numpy as np

T = TypeVar("T")


def drawn(things: Sequence[T], count: int, seed: int | None = None) -> list[T]:
    """So many of them, or all where there are no more.

    Args:
        seed: of the draw; the day's number where None.
    """
    seed = datetime.now(UTC).date().toordinal() if seed is None else seed
    return [things[i] for i in np.random.default_rng(seed).permutation(len(things))[:count].tolist()]
