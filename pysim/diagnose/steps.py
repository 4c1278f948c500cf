"""Whether runs are integrated finely enough for the noise: an error that the refit could fit must be no part of it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.residuals import Point
from pysim.simulate import Esdirk, Rodas

Array = NDArray[np.float64]

# The error's sum of squares, over noise, that is left as it is: a parameter moves by a standard deviation at most.
_SMALL = 1.0
# An error of which finer steps leave this share is none of the integration.
_ROUGH = 0.5
# The error shrinks like the tolerance; tolerances are not made less than this, nor so much narrower in one go.
_FINEST, _LEAST = 1e-9, 1e-3


def with_tolerance(ruler: Ruler, by: float = 0.1) -> Ruler:
    """The ruler with tolerances so many times as wide, a tenth by default; the same where its method has none."""
    solver = ruler.solver
    if not isinstance(solver, Rodas | Esdirk):
        return ruler
    rtol, atol = (max(by * tolerance, min(tolerance, _FINEST)) for tolerance in (solver.rtol, solver.atol))
    return replace(ruler, solver=replace(solver, rtol=rtol, atol=atol))


def integration_error(ruler: Ruler, what: Extended, x: Array, residual: Array) -> float:
    """Length of what the error of the integration puts into the residuals (n_r,) at a point (n,)."""
    fine = with_tolerance(ruler).at(what, x)
    return 0.0 if fine is None else float(np.linalg.norm(fine - residual))


def run_again(ruler: Ruler, at: Fitted) -> Point | None:
    """A model's point as another integration has it, with the slopes that it has; None where it cannot be run."""
    residual = ruler.at(at.what, at.point.x)
    return None if residual is None else replace(at.point, residual=residual, cost=float(residual @ residual))


def fine_enough(ruler: Ruler, at: Fitted) -> tuple[Ruler, Point, float]:
    """The ruler with tolerances at which the error of the integration is small beside the noise.

    Returns:
        it, the point as it runs there, and the length of what no tolerance takes off the residuals: a plant that
        sticks and slips is so sensitive that any change of steps, or of parameters, gives it another phase. Such a
        model stays as it is.
    """
    error = integration_error(ruler, at.what, at.point.x, at.point.residual)
    if error**2 < _SMALL:
        return ruler, at.point, 0.0
    fine = with_tolerance(ruler, max(0.1 ** math.ceil(math.log10(error / math.sqrt(_SMALL)) + 0.5), _LEAST))
    point = run_again(fine, at)
    left = error if point is None else integration_error(fine, at.what, point.x, point.residual)
    if point is None or left > _ROUGH * error:
        return ruler, at.point, left
    return fine, point, 0.0 if left**2 < _SMALL else left


def as_fine(ruler: Ruler, other: Ruler) -> Ruler:
    """The ruler with tolerances no wider than another's."""
    one, two = ruler.solver, other.solver
    if not (isinstance(one, Rodas | Esdirk) and isinstance(two, Rodas | Esdirk)):
        return ruler
    return replace(ruler, solver=replace(one, rtol=min(one.rtol, two.rtol), atol=min(one.atol, two.atol)))
