"""Best linear approximations of many records, with realisations of one test taken together."""

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
    """The best linear approximation of each test, from records that are its realisations.

    Args:
        columns: names of input and output, and of a reference if there is one.
        period: period of the multisine, s.
        method: one of METHODS.
        start: start of the first period, s; None finds it.
        count: periods of each record; None takes all.
        drop: number of first periods to leave out, instead of estimating the transient.
        excited: (n,) excited harmonics; None finds them.
    Raises:
        BadInput: a record that is not periodic, or that the method rejects.
    """
    cuts = [periods_of([one], period, columns, start=start, count=count) for one in records]
    transient = None if drop is None else DropPeriods(drop)
    tests = grouped_realisations(cuts, excited=excited)
    return [METHODS[method](periods, excited=excited, transient=transient) for periods in tests]
