"""Esdirk: a stiff method of order 4 whose steps can be differentiated exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Adaptive
from pysim.simulate.kernel.method import EsdirkMethod

Array = NDArray[np.float64]

# ARK4(3)6L[2]SA, the implicit part: Kennedy and Carpenter 2003, Additive Runge-Kutta schemes for
# convection-diffusion-reaction equations, Applied Numerical Mathematics 44:139. No stage lies beyond the end of the
# step, where an FMU that was told its stop time may refuse to be evaluated.
_GAMMA = 1 / 4
_A = (
    (),
    (_GAMMA,),
    (8611 / 62500, -1743 / 31250),
    (5012029 / 34652500, -654441 / 2922500, 174375 / 388108),
    (15267082809 / 155376265600, -71443401 / 120774400, 730878875 / 902184768, 2285395 / 8070912),
    (82889 / 524892, 0.0, 15625 / 83664, 69875 / 102672, -2260 / 8211),
)
_EMBEDDED = (
    4586570599 / 29645900160,
    0.0,
    178811875 / 945068544,
    814220225 / 1159782912,
    -3700637 / 11593932,
    61727 / 225920,
)


def _triangle() -> Array:
    a = np.zeros((6, 6))
    for i, row in enumerate(_A):
        a[i, : len(row)] = row
        a[i, i] = _GAMMA if i else 0.0
    return a


def _interpolant(a: Array) -> Array:
    """Weights (7, 4) of theta^1 ... theta^4: order 4 inside the step, and smooth from step to step.

    Five order conditions at every theta leave one free direction of the six weights. A cubic along it joins weights and
    slopes with those of both ends, where the derivatives are those of the first and of the last stage.
    """
    c = a.sum(axis=1)
    conditions = np.stack([np.ones(6), c, c**2, c**3, a @ c**2])
    inverse, free = np.linalg.pinv(conditions), np.linalg.svd(conditions)[2][-1]
    right = np.vstack([np.diag([1.0, 1 / 2, 1 / 3, 1 / 4]), [0, 0, 0, 1 / 12]])  # a column per power of theta
    weights = inverse @ right
    slopes = np.eye(6)[[0, -1]] - np.stack([weights[:, 0], weights @ np.arange(1, 5)])
    start, end = slopes @ free
    height = (a[-1] - weights.sum(axis=1)) @ free
    cubic = np.array([start, 3 * height - 2 * start - end, start + end - 2 * height, 0.0])
    return np.vstack([weights + np.outer(free, cubic), np.zeros(4)])


def _predictor(c: Array) -> Array:
    """Weights (6, 6) that extrapolate the derivative at a stage from up to three stages before it."""
    weights = np.zeros((6, 6))
    for i in range(1, 6):
        known = sorted(range(i), key=lambda j: abs(c[j] - c[i]))[:3]
        for j in known:
            weights[i, j] = math.prod((c[i] - c[m]) / (c[j] - c[m]) for m in known if m != j)
    return weights


def _method() -> EsdirkMethod:
    a = _triangle()
    c = a.sum(axis=1)
    error = np.append(a[-1] - np.array(_EMBEDDED), 0.0)
    return EsdirkMethod(4, 4, _GAMMA, a, a[-1].copy(), c, _predictor(c), error, _interpolant(a))


_METHOD = _method()


@dataclass(frozen=True)
class Esdirk(Adaptive):
    """Six stages, the first one explicit; order 4, error estimate of order 3, interpolant of order 4, L-stable.

    Every stage is an equation of its own, so the step can be differentiated exactly by its start and by parameters:
    what `sensitivities` and `periodic_many` need. For a plain run `Rodas` takes fewer steps at the same accuracy.

    Args:
        derivative_tol: tolerated error of a step in each column of derivatives, of the column's size. The steps that
            the states ask for are too long for the derivatives where the model has a kink, as where a valve saturates:
            three times rtol divides their error there by ten, for half as much time again. Infinite leaves the
            derivatives to the steps of the states. Nothing to a plain run.
        rtol, atol, max_step, max_steps: as of every solver that chooses its steps.
    """

    rtol: float = 1e-5
    atol: float = 1e-5
    derivative_tol: float = math.inf

    def method(self) -> EsdirkMethod:
        """Coefficients of ARK4(3)6L[2]SA-ESDIRK."""
        return _METHOD
