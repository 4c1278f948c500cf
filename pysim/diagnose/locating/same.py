"""Places that no measurement tells apart: a term does the very same at one and at the other."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.locating.found import Found
from pysim.diagnose.locating.laws import Law

Array = NDArray[np.float64]

_CLOSE = 1e-3


def alike(law: Law, knots: Array, other: Law, other_knots: Array) -> bool:
    """Whether two laws of two places run over the very same values."""
    same = (law.lag, law.of_rate) == (other.lag, other.of_rate) and law.slot != other.slot
    return same and bool(np.allclose(knots, other_knots, rtol=_CLOSE, atol=_CLOSE * float(np.ptp(knots))))


def different(tried: Sequence[Found]) -> tuple[list[Found], dict[int, list[Law]]]:
    """Terms that do something of their own, and per such a term the laws at other places that do the very same."""
    own: list[Found] = []
    twins: dict[int, list[Law]] = {}
    for found in tried:
        same = next((d for d in own if _same(d, found)), None)
        if same is None:
            own.append(found)
        else:
            twins.setdefault(id(same.law), []).append(found.law)
    return own, twins


def neighbours(tried: Sequence[Found]) -> dict[str, list[str]]:
    """Per place those where every law does the very same."""
    laws: dict[str, list[Found]] = {}
    for found in tried:
        laws.setdefault(found.law.slot, []).append(found)
    return {
        one: [
            other
            for other, theirs in laws.items()
            if other != one and all(any(_same(f, g) for g in theirs) for f in own)
        ]
        for one, own in laws.items()
    }


def _same(one: Found, other: Found) -> bool:
    """Whether they change the residuals alike, to first order."""
    mine, theirs = one.estimate.table, other.estimate.table
    size = max(abs(one.evidence), abs(other.evidence), 1.0)
    return (
        alike(one.law, mine.knots, other.law, theirs.knots)
        and abs(one.evidence - other.evidence) < _CLOSE * size
        and abs(math.log(mine.unit / theirs.unit)) < _CLOSE
    )
