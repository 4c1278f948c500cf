"""Refinement of a start to a minimum of the weighted sum of squares."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.blackbox.objective import Point, Problem

Array = NDArray[np.float64]

STABLE_MARGIN = 1e-6  # smallest scaled number of a section; keeps poles left of the imaginary axis despite rounding
_TOLERANCE = 1e-11
_EDGE = 1e-6  # distance from a limit, relative to the number or to one, below which it counts as at the limit


@dataclass(frozen=True)
class Minimum:
    """The end of a search.

    Args:
        unknowns: (n,) as in `Problem`.
        point: numerator and residual there.
        at_bound: (n,) whether each unknown is at a limit.
        converged: whether a tolerance of the search was reached.
        evaluations: number of evaluations of the model.
    """

    unknowns: Array
    point: Point
    at_bound: NDArray[np.bool_]
    converged: bool
    evaluations: int


def refine(problem: Problem, start: Array, *, most: int = 300) -> Minimum:
    """Trust-region least squares from unknowns (n,), within bounds of the dead time and, if required, of stability.

    Args:
        most: largest number of evaluations.
    """
    from scipy.optimize import least_squares  # takes 0.2 s to import, so only if needed

    if not start.size:
        return Minimum(start, problem.evaluate(start), np.zeros(0, dtype=bool), True, 1)
    memory: dict[bytes, Point] = {}

    def point(unknowns: Array) -> Point:
        key = unknowns.tobytes()
        if key not in memory:
            memory.clear()
            memory[key] = problem.evaluate(unknowns)
        return memory[key]

    low, high = _box(problem, start.size)
    inside = np.clip(start, np.where(np.isfinite(low), low + 1e-12, low), high)
    found = least_squares(
        lambda x: point(x).residual,
        inside,
        jac=lambda x: problem.jacobian(point(x)),
        bounds=(low, high),
        x_scale="jac",
        ftol=_TOLERANCE,
        xtol=_TOLERANCE,
        gtol=_TOLERANCE,
        max_nfev=most,
    )
    at_low, at_high = (np.abs(found.x - end) <= _EDGE * np.maximum(np.abs(found.x), 1) for end in (low, high))
    ended = np.where(at_low, low, np.where(at_high, high, found.x))  # the search stops slightly inside a bound
    held = at_low | at_high
    return Minimum(ended, problem.evaluate(ended), held, bool(found.status > 0), int(found.nfev))


def _box(problem: Problem, count: int) -> tuple[Array, Array]:
    low, high = np.full(count, -np.inf), np.full(count, np.inf)
    structure = problem.structure
    if structure.stable:
        low[: structure.poles] = STABLE_MARGIN
    if structure.dead_time_max is not None:
        low[-1], high[-1] = structure.dead_time * problem.scale, structure.dead_time_max * problem.scale
    return low, high
