"""How far tests would separate two models: the misfit that remains when the wrong one is refitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Tests in a plan at most, and how often one may be repeated.
MOST, REPEATS = 3, 4


@dataclass(frozen=True)
class Evidence:
    """What one test says about a truth and a rival through one signal.

    It holds products of d (n_t,), the difference of the two over noise, and J (n_t, n), the slopes of the rival.

    Args:
        square: d d.
        slope: (n,) J d.
        information: (n, n) J J.
    """

    square: float
    slope: Array
    information: Array

    def __add__(self, other: Evidence) -> Evidence:
        return Evidence(self.square + other.square, self.slope + other.slope, self.information + other.information)

    def times(self, count: float) -> Evidence:
        return Evidence(count * self.square, count * self.slope, count * self.information)

    def gain(self, known: Array) -> float:
        """What is left of d once the rival is refitted to old data, of information `known` (n, n), and new."""
        total = known + self.information
        return self.square - float(self.slope @ np.linalg.lstsq(total, self.slope, rcond=1e-12)[0])


def evidence(apart: Array, slopes: Array) -> Evidence:
    """Of a difference (n_t,) and slopes (n_t, n)."""
    return Evidence(float(apart @ apart), slopes.T @ apart, slopes.T @ slopes)


# Per test and signal: the first model taken for the truth, and the second.
Table = Sequence[dict[str, tuple[Evidence, Evidence]]]


def cheapest(
    seconds: Sequence[float], table: Table, names: Sequence[str], known: tuple[Array, Array], enough: float
) -> tuple[float, list[tuple[int, int]]]:
    """Tests with repetitions, each the best for its time on the bench, until together they are enough.

    Args:
        seconds: of each test.
        table: what each test says; nothing for one that cannot be run.
        names: of the signals that are logged.
        known: information of the data at hand on each rival: (n, n) of the second model, then of the first.
        enough: gain that ends it.
    Returns:
        the gain, and tests as (number, repetitions).
    """
    total = tuple(Evidence(0.0, np.zeros(len(k)), np.zeros_like(k)) for k in known)
    gain, chosen = 0.0, dict[int, int]()
    while gain < enough:
        options = []
        for k, time in enumerate(seconds):
            if not table[k] or chosen.get(k, 0) == REPEATS or (len(chosen) == MOST and k not in chosen):
                continue
            added = tuple(sum((table[k][name][side] for name in names), total[side]) for side in (0, 1))
            worth = min(one.gain(own) for one, own in zip(added, known, strict=True))
            options.append(((min(worth, enough) - gain) / time, k, worth, added))
        if not options:
            break
        _, k, worth, added = max(options, key=lambda option: option[:2])
        if worth <= gain:
            break
        total, gain = added, worth
        chosen[k] = chosen.get(k, 0) + 1
    return gain, sorted(chosen.items())
