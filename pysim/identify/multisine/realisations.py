"""Best linear approximations of many records at once, realisations of one test taken together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.approximation import (
    best_linear_approximation,
    fast_approximation,
    robust_approximation,
    smooth_approximation,
)
from pysim.identify.multisine.groups import grouped_realisations
from pysim.identify.multisine.periods import periods_of
from pysim.identify.multisine.steady import DropPeriods
from pysim.types import BestLinearApproximation, Record

METHODS = {
    "auto": best_linear_approximation,
    "robust": robust_approximation,
    "fast": fast_approximation,
    "smooth": smooth_approximation,
}


def approximations(
    records: Sequence[Record],
    columns: tuple[str, ...],
    period: float,
    *,
    method: str = "auto",
    start: float | None = None,
    count: int | None = None,
    drop: int | None = None,
    excited: NDArray[np.intp] | None = None,
) -> list[BestLinearApproximation]:
    """One of each test that the records are realisations of.

    Args:
        columns: names of input and output, and of a reference where there is one.
        period: of the multisine, s.
        method: one of METHODS.
        start: s, of the first period; found where None.
        count: periods of each record; all where None.
        drop: periods to leave out, in place of estimating the transient.
        excited: (n,) harmonics that are excited; found where None.
    Raises:
        BadInput: a record that is not periodic, or what the method refuses.
    """
    cuts = [periods_of([one], period, columns, start=start, count=count) for one in records]
    transient = None if drop is None else DropPeriods(drop)
    tests = grouped_realisations(cuts, excited=excited)
    return [METHODS[method](periods, excited=excited, transient=transient) for periods in tests]
