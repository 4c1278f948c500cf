"""What speaks for a term or an effect at a place, on one scale: logarithms of likelihoods over that without any."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.drawn import Acted
from pysim.diagnose.locating.fit import Estimate
from pysim.diagnose.locating.formula import Formula
from pysim.diagnose.locating.known import Known
from pysim.diagnose.locating.laws import Law
from pysim.diagnose.locating.shape import Told
from pysim.diagnose.screen import across, column_space

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Found:
    """One term with what speaks for it: logarithm of the likelihood over that without a term, and its share.

    `estimate` is of first order where it is not yet `fitted`.
    """

    law: Law
    estimate: Estimate = field(repr=False)
    fitted: bool
    evidence: float
    share: float
    told: Told | None = field(default=None, repr=False)
    formula: Formula | None = None


@dataclass(frozen=True)
class Named:
    """The same of an effect in its place; `acted` is what it does there, where that can be drawn."""

    one: Known
    evidence: float
    share: float
    acted: Acted | None = field(default=None, repr=False)


@dataclass(frozen=True)
class Base:
    """The model without a term: what refitting takes, and what is left beyond noise."""

    at: Fitted
    span: Array = field(repr=False)
    left: float
    rows: int

    @classmethod
    def of(cls, at: Fitted) -> Base:
        """From a point with slopes."""
        span = column_space(at.point.jacobian)
        rest = across(span, at.point.residual)
        return cls(at, span, float(rest @ rest), at.point.residual.size)

    def found(self, at: Estimate, *, fitted: bool = False) -> Found:
        """How much better it gets with a term, its values marginalised."""
        solution = at.solution
        share = self._share(solution.left, solution.freedom)
        return Found(at.table.law, at, fitted, 0.5 * self.rows * math.log(self.left / self.rows) - solution.loss, share)

    def worth(self, found: Iterable[Known]) -> list[Named]:
        """Effects that are worth their numbers, the likeliest first; others may be there in any amount."""
        named = [one for one in map(self.named, found) if one.evidence > 0]
        return sorted(named, key=lambda one: -one.evidence)

    def named(self, one: Known) -> Named:
        """How much better it gets with an effect, at Schwarz's price for each of its numbers."""
        cost, extra = one.at.point.cost, one.at.point.x.size - self.at.point.x.size
        evidence = 0.5 * self.rows * math.log(self.left / cost) - 0.5 * extra * math.log(self.rows)
        return Named(one, evidence, self._share(cost, extra))

    def _share(self, left: float, freedom: float) -> float:
        """Of the avoidable misfit."""
        avoidable = self.left - (self.rows - self.span.shape[1])
        gain = self.left - left - freedom * max(1.0, left / self.rows)
        return float(np.clip(gain / avoidable, 0.0, 1.0)) if avoidable > 0 else 0.0
