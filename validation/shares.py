"""Shares of cases, their intervals, and the targets they are held against."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from scipy import stats

from validation.findings import Finding


@dataclass(frozen=True)
class Share:
    """One share.

    Args:
        label: what is counted, of what.
        hits, of: how many, of how many.
        target: percent, from and to; None where there is none.
    """

    label: str
    hits: int
    of: int
    target: tuple[float, float] | None = None

    @property
    def percent(self) -> float:
        """The share; not a number where nothing was counted."""
        return 100.0 * self.hits / self.of if self.of else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """95 percent, in percent (Clopper and Pearson 1934, Biometrika 26:404)."""
        if not self.of:
            return 0.0, 100.0
        found = stats.binomtest(self.hits, self.of).proportion_ci(0.95, method="exact")
        return 100.0 * float(found.low), 100.0 * float(found.high)

    @property
    def least(self) -> int:
        """Cases to be counted before the target is judged, so that one of them cannot decide it."""
        allowed = min(share for low, high in [self.target or (0.0, 100.0)] for share in (100.0 - low, high) if share)
        return math.ceil(100.0 / allowed)

    @property
    def beyond(self) -> float:
        """Percent by which the share misses its target; 0 where it is met."""
        low, high = self.target or (0.0, 100.0)
        return max(low - self.percent, self.percent - high, 0.0)

    @property
    def words(self) -> str:
        """The target as a reader says it."""
        if self.target is None:
            return ""
        low, high = self.target
        return f"at least {low:g} %" if high == 100 else f"at most {high:g} %" if low == 0 else f"{low:g} to {high:g} %"

    def __str__(self) -> str:
        low, high = self.interval
        met = (
            "" if self.target is None else " too few" if self.of < self.least else " MISSED" if self.beyond else " met"
        )
        share = f"{self.percent:.1f} % ({low:.1f} to {high:.1f})" if self.of else "-"
        return f"{self.label}: {self.hits} of {self.of}, {share}{f'; {self.words},' if self.target else ''}{met}"


def claims(shares: Iterable[Share]) -> Iterator[Finding]:
    """Every share with a target; skipped where too few cases were answered to judge it."""
    for share in shares:
        if share.target is not None:
            few = f"judged from {share.least} cases on; run the whole batch" if share.of < share.least else ""
            yield Finding(
                f"{share.label}: {share.hits} of {share.of}, {share.words}; beyond by", share.beyond, 0, "%", few
            )
