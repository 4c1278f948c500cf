"""Rk45: an explicit pair of orders 5 and 4 that chooses its steps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pysim.simulate._base import Control, adaptive
from pysim.simulate._method import ExplicitMethod

# Dormand and Prince 1980, as printed in Hairer, Norsett, Wanner I, Table II.5.2; the seventh stage is the derivative at
# the end of the step.
_A = np.zeros((6, 6))
_A[1, :1] = 1 / 5
_A[2, :2] = 3 / 40, 9 / 40
_A[3, :3] = 44 / 45, -56 / 15, 32 / 9
_A[4, :4] = 19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729
_A[5, :5] = 9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656
_B = np.array([35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84])
_EMBEDDED = np.array([5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40])

# Fourth-order interpolant (ibid., II.6): weights of theta^1 ... theta^4.
_DENSE = np.array(
    [
        [1, -8048581381 / 2820520608, 8663915743 / 2820520608, -12715105075 / 11282082432],
        [0, 0, 0, 0],
        [0, 131558114200 / 32700410799, -68118460800 / 10900136933, 87487479700 / 32700410799],
        [0, -1754552775 / 470086768, 14199869525 / 1410260304, -10690763975 / 1880347072],
        [0, 127303824393 / 49829197408, -318862633887 / 49829197408, 701980252875 / 199316789632],
        [0, -282668133 / 205662961, 2019193451 / 616988883, -1453857185 / 822651844],
        [0, 40617522 / 29380423, -110615467 / 29380423, 69997945 / 29380423],
    ]
)

_METHOD = ExplicitMethod(
    order=5,
    error_order=5,
    a=_A,
    b=_B,
    c=_A.sum(axis=1),
    error=np.append(_B, 0.0) - _EMBEDDED,
    dense=_DENSE,
)


@dataclass(frozen=True)
class Rk45:
    """Six derivative calls per step, order 5, error estimate of order 4, interpolant of order 4.

    Args:
        rtol: tolerated error of a step, of a state's magnitude.
        atol: the same, of a state's nominal value.
        max_step: s.
        max_steps: the run stops after that many.
    """

    rtol: float = 1e-6
    atol: float = 1e-6
    max_step: float = math.inf
    max_steps: int = 100_000_000

    def __post_init__(self) -> None:
        self.control()

    def method(self) -> ExplicitMethod:
        """Coefficients of the pair."""
        return _METHOD

    def control(self) -> Control:
        """Error-controlled steps."""
        return adaptive("Rk45", self.rtol, self.atol, self.max_step, self.max_steps)
