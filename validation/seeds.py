"""Which seeds a case draws random numbers with, noted as it draws, so that no list of them is kept by hand."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

import numpy as np

UNSEEDED = "none"


class Seeds:
    """The seeds so far."""

    def __init__(self) -> None:
        self._numbers: set[int] = set()
        self._others: set[str] = set()

    def note(self, seed: Any) -> None:
        """One more: a whole number, a row that begins with the seed and goes on with its purpose, or another thing."""
        if isinstance(seed, list | tuple) and seed:
            self.note(seed[0])
        elif isinstance(seed, int | np.integer):
            self._numbers.add(int(seed))
        else:
            self._others.add(UNSEEDED if seed is None else str(seed))

    @property
    def text(self) -> str:
        """Such as "1, 3 to 402"; "none" is among them where a draw cannot be had again."""
        ranges: list[list[int]] = []
        for number in sorted(self._numbers):
            if ranges and number == ranges[-1][1] + 1:
                ranges[-1][1] = number
            else:
                ranges.append([number, number])
        words = [f"{low} to {high}" if high > low else f"{low}" for low, high in ranges]
        return ", ".join([*words, *sorted(self._others)])


@contextmanager
def seeds_drawn() -> Iterator[Seeds]:
    """Note every seed that `numpy.random.default_rng` gets in this process meanwhile."""
    seeds, begin = Seeds(), np.random.default_rng

    def noted(seed: Any = None) -> np.random.Generator:
        if not isinstance(seed, np.random.Generator):  # which would be handed back as it is
            seeds.note(seed)
        return begin(seed)

    with patch.object(np.random, "default_rng", noted):
        yield seeds
