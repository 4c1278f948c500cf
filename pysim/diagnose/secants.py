"""Slopes of a model with events, where the data tell little: by steps as long as what is in doubt.

Such a model has no exact slopes here, and a short difference carries the error of the integration over its step. That
is nothing beside a large slope, but a direction in which nothing moves would seem to be known from it, and so would
parameters. So the directions in which the slopes are not well above that error are gone along to both sides, as far as
their own standard deviation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.residuals import STEP, Ruler, steps_inside
from pysim.diagnose.steps import with_tolerance
from pysim.diagnose.subject import Extended

Array = NDArray[np.float64]

# Slopes below so many times the error of a short difference are found anew.
_ABOVE = 5.0
# The longest step, in units of the search: natural logarithms of most parameters.
_LONGEST = 0.25
# How often at most: better slopes tell better which directions are the weak ones.
_PASSES = 3


def with_secants(ruler: Ruler, what: Extended, x: Array, rows: Array) -> Array:
    """Residuals and slopes (n_r, 1 + n) of a point, the weak slopes among them from long steps.

    Args:
        x: (n,).
        rows: of `ruler.whole`, slopes by short differences.
    """
    bounds, fine = what.space.bounds(), with_tolerance(ruler.bare)
    rows, here = _both_sides(ruler.bare, what, x, rows), fine.at(what, x)
    if here is None:
        return rows
    limit = _ABOVE * float(np.linalg.norm(here - rows[:, 0])) / STEP
    for _ in range(_PASSES):
        directions, sizes = _weak(ruler.span.across(rows)[:, 1:], limit)
        lengths = 1 / np.maximum(sizes, 1 / _LONGEST)
        ends = [_ends(x, v, length, bounds) for v, length in zip(directions, lengths.tolist(), strict=True)]
        points = [x + t * v for v, pair in zip(directions, ends, strict=True) for t in pair if t]
        runs = iter(fine.residuals(what.model, [what.space.values(point) for point in points]))
        for v, (up, down) in zip(directions, ends, strict=True):
            above, below = (next(runs) if t else here for t in (up, down))
            if above is not None and below is not None and up - down >= STEP:
                rows[:, 1:] += np.outer((above - below) / (up - down) - rows[:, 1:] @ v, v)
        limit = min(limit, 1 / _LONGEST)
    return rows


def _both_sides(bare: Ruler, what: Extended, x: Array, rows: Array) -> Array:
    """The same with differences to both sides, where there is room."""
    lower, upper = what.space.bounds()
    other = -steps_inside(x, (lower, upper))
    points = x + np.diag(other)
    room = np.flatnonzero(np.all((points >= lower) & (points <= upper), axis=1))
    rows = rows.copy()
    for j, moved in zip(room, bare.residuals(what.model, [what.space.values(points[j]) for j in room]), strict=True):
        if moved is not None:
            rows[:, 1 + j] = (rows[:, 1 + j] + (moved - rows[:, 0]) / other[j]) / 2
    return rows


def _weak(slopes: Array, limit: float) -> tuple[Array, Array]:
    """Directions (k, n) along which the slopes are below a limit, and by how much they move there (k,)."""
    _, sizes, turned = np.linalg.svd(np.linalg.qr(slopes, mode="r"))
    return turned[sizes < limit], sizes[sizes < limit]


def _ends(x: Array, v: Array, length: float, bounds: tuple[Array, Array]) -> tuple[float, float]:
    """How far to go from a point (n,) along a direction (n,) and against it: as far each way, one way from a bound."""
    moving = v != 0
    low, high = ((bound - x)[moving] / v[moving] for bound in bounds)
    up = min(length, float(np.min(np.maximum(low, high), initial=np.inf)))
    down = min(length, float(np.min(-np.minimum(low, high), initial=np.inf)))
    if min(up, down) < STEP:
        return (up, 0.0) if up > down else (0.0, -down)
    return min(up, down), -min(up, down)
