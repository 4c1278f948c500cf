"""Rk45: an explicit pair of orders 5 and 4 that chooses its steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pysim.simulate._base import Adaptive
from pysim.simulate.kernel.method import ExplicitMethod

# Tsitouras 2011, Runge-Kutta pairs of order 5(4) satisfying only the first column simplifying assumption, Table 1 and
# Section 3; the seventh stage is the derivative at the end of the step.
_A = np.zeros((6, 6))
_A[1, :1] = 0.161
_A[2, :2] = -0.008480655492356989, 0.335480655492357
_A[3, :3] = 2.8971530571054935, -6.359448489975075, 4.3622954328695815
_A[4, :4] = 5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525
_A[5, :5] = 5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401, -0.028269050394068383
_B = np.array([0.09646076681806523, 0.01, 0.4798896504144996, 1.379008574103742, -3.290069515436081, 2.324710524099774])
_ERROR = np.array(
    [
        -0.00178001105222577714,
        -0.0008164344596567469,
        0.007880878010261995,
        -0.1447110071732629,
        0.5823571654525552,
        -0.45808210592918697,
        1 / 66,
    ]
)

# Fourth-order interpolant: weights of theta^1 ... theta^4.
_DENSE = np.array(
    [
        [1.0, -2.763706197274826, 2.9132554618219126, -1.0530884977290216],
        [0.0, 0.1317, -0.2234, 0.1017],
        [0.0, 3.9302962368947516, -5.941033872131505, 2.490627285651253],
        [0.0, -12.411077166933676, 30.33818863028232, -16.548102889244902],
        [0.0, 37.50931341651104, -88.1789048947664, 47.37952196281928],
        [0.0, -27.896526289197287, 65.09189467479366, -34.87065786149661],
        [0.0, 1.5, -4.0, 2.5],
    ]
)

_METHOD = ExplicitMethod(
    order=5,
    error_order=5,
    a=_A,
    b=_B,
    c=_A.sum(axis=1),
    error=_ERROR,
    dense=_DENSE,
)


@dataclass(frozen=True)
class Rk45(Adaptive):
    """Six derivative calls per step, order 5, error estimate of order 4, interpolant of order 4."""

    def method(self) -> ExplicitMethod:
        """Coefficients of the pair."""
        return _METHOD
