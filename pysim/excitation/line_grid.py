"""Which harmonics of a period are excited, and which are left out to see distortions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.excitation._check import check_finite, check_positive, check_seed, check_sines
from pysim.types import BadInput

Lines = NDArray[np.int64]

_KINDS = ("full", "odd", "random-odd")


@dataclass(frozen=True)
class LineGrid:
    """Harmonics k of one period; line k is at k / period Hz.

    "full" excites every line of the band, "odd" the odd ones: even distortions then show at the even lines.
    "random-odd" leaves one line, drawn from a seed, out of every whole group of neighbouring odd lines: odd distortions
    show there.

    Args:
        period: s.
        low_hz, high_hz: the band; its lines may lie on both edges.
        kind: "full" | "odd" | "random-odd".
        group: odd lines per group, two at least.
        seed: which line of each group is left out.
    Raises:
        BadInput: an unknown kind, a group too small, a period that is not positive, a seed below zero, or a band that
            holds no line to excite or too many.
    Source: Pintelon and Schoukens, System Identification: A Frequency Domain Approach, 2nd ed., Sections 4.3 and 5.3.
    """

    period: float
    low_hz: float
    high_hz: float
    kind: str = "random-odd"
    group: int = 4
    seed: int = 0

    def __post_init__(self) -> None:
        check_positive("line grid: the period", self.period, "s")
        check_finite("line grid: the lowest frequency", self.low_hz, "Hz")
        check_positive("line grid: the highest frequency", self.high_hz, "Hz")
        check_seed("line grid: the seed", self.seed)
        check_sines("line grid", (self.high_hz - self.low_hz) * self.period)
        if self.kind not in _KINDS:
            raise BadInput(f"line grid: kind is {self.kind!r}; write one of {', '.join(_KINDS)}")
        if self.group < 2:
            raise BadInput(f"line grid: groups of {self.group}; two lines at least, of which one is left out")
        if self.excited.size == 0:
            raise BadInput(
                f"line grid: no line to excite from {self.low_hz:g} to {self.high_hz:g} Hz, {1 / self.period:g} Hz "
                "apart; lengthen the period or widen the band"
            )

    @property
    def band(self) -> Lines:
        """Every line of the band, (n,); never line zero."""
        first = max(1, int(np.ceil(self.low_hz * self.period - 1e-9)))
        return np.arange(first, int(np.floor(self.high_hz * self.period + 1e-9)) + 1)

    @property
    def excited(self) -> Lines:
        """Lines with power, increasing."""
        return self.band if self.kind == "full" else np.setdiff1d(self._odd, self.odd_detection)

    @property
    def odd_detection(self) -> Lines:
        """Odd lines without power; empty but for "random-odd"."""
        if self.kind != "random-odd":
            return self.band[:0]
        groups = self._odd[: self._odd.size // self.group * self.group].reshape(-1, self.group)
        drawn = np.random.default_rng(self.seed).integers(self.group, size=groups.shape[0])
        return groups[np.arange(groups.shape[0]), drawn]

    @property
    def even_detection(self) -> Lines:
        """Even lines without power; empty for "full"."""
        return self.band[:0] if self.kind == "full" else self.band[self.band % 2 == 0]

    @property
    def _odd(self) -> Lines:
        return self.band[self.band % 2 == 1]

    def frequencies(self, lines: Lines) -> NDArray[np.float64]:
        """Of lines (n,), in Hz."""
        return lines / self.period
