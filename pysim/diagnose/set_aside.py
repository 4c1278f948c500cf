"""A refit out of a dent that one log makes: it is set aside, the others are fitted, and it is put back.

A sine on which a valve saturates or a play opens and closes may have several steady states, and a percent of a
parameter decides which of them a model takes. Where that is another than the plant's, no slope leads over to it, and
everything is bent for this one log. The others tell the parameters better, and there it falls into its place.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.corrections import as_noise
from pysim.diagnose.descent import descend, worth
from pysim.diagnose.jumps import logs
from pysim.diagnose.refit import refit_from
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# Logs set aside at most, one after the other, and the share that one has of all that noise does not explain.
_MOST, _CARRIES = 3, 1 / 3
# Share of all rows that a log which is set aside may have: the others have to tell the parameters.
_FEW = 0.5
# How often slopes are run without it.
_ROUNDS = 2


def set_aside(ruler: Ruler, what: Extended, end: Point) -> tuple[Point, Array] | None:
    """A refit of every log that starts where those fit best that agree with each other.

    Args:
        end: of a refit that leaves more than noise does, with its slopes.
    Returns:
        the point, and where its slopes were run, (n,); None where no single log leaves much of it.
    """
    counts, point = np.ones(end.residual.size, dtype=bool), end
    for _ in range(_MOST):
        rows = _carrier(ruler, point, counts)
        if rows is None:
            break
        counts[rows] = False
        point = _fitted(ruler, what, point, counts)
        if not point.good:
            return None
        if as_noise(ruler, _only(point, counts)):
            break
    return None if counts.all() else refit_from(ruler, what, point, rounds=2, slow_first=False)


def _carrier(ruler: Ruler, point: Point, counts: NDArray[np.bool_]) -> slice | None:
    """Rows of the log that leaves most, if it leaves much of all; those that do not count are left out."""
    squares = np.where(counts, point.residual**2 - 1.0, 0.0)
    small = [rows for _, rows in logs(ruler) if rows.stop - rows.start < _FEW * squares.size]
    worst = max(small, key=lambda rows: float(squares[rows].sum()), default=None)
    if worst is None or float(squares[worst].sum()) < _CARRIES * max(float(squares.sum()), 1.0):
        return None
    return worst


def _fitted(ruler: Ruler, what: Extended, first: Point, counts: NDArray[np.bool_]) -> Point:
    """A refit of the rows that count; the point has all of them, and slopes of its own."""
    bounds, point = Bounds(*what.space.bounds()), first

    def at(x: Array) -> Array | None:
        residual = ruler.at(what, x)
        return None if residual is None else np.where(counts, residual, 0.0)

    for _ in range(_ROUNDS):
        start = _only(point, counts)
        end = descend(at, start, bounds, steps=6)
        point = ruler.evaluation(what, end.x)
        if not point.good or start.cost - end.cost < worth(start):
            break
    return point


def _only(point: Point, counts: NDArray[np.bool_]) -> Point:
    """The point where other rows are nothing."""
    residual = np.where(counts, point.residual, 0.0)
    return Point(point.x, float(residual @ residual), residual, np.where(counts[:, None], point.jacobian, 0.0))
