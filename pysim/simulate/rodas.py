"""Rodas: a stiff method of order 5 that takes the exact Jacobian from the FMU."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Adaptive
from pysim.simulate.kernel.method import RosenbrockMethod

# Rodas5P: Steinebach 2023, Construction of Rosenbrock-Wanner method Rodas5P, BIT Numerical Mathematics 63:27. Rows of
# the strict lower triangles; the last stages only add up those before them, which makes the method stiffly accurate.
_LAST = -7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946
_A = (
    (3.0,),
    (2.849394379747939, 0.45842242204463923),
    (-6.954028509809101, 2.489845061869568, -10.358996098473584),
    (2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641),
    _LAST,
    (*_LAST, 1.0),
    (*_LAST, 1.0, 1.0),
)
_COUPLING = (
    (-14.155112264123755,),
    (-17.97296035885952, -2.859693295451294),
    (147.12150275711716, -1.41221402718213, 71.68940251302358),
    (165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306),
    (24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471),
    (
        30.91273214028599,
        -3.1208243349937974,
        77.79954646070892,
        34.28646028294783,
        -19.097331116725623,
        -28.087943162872662,
    ),
    (
        37.80277123390563,
        -3.2571969029072276,
        112.26918849496327,
        66.9347231244047,
        -40.06618937091002,
        -54.66780262877968,
        -9.48861652309627,
    ),
)
_GAMMA = 0.21193756319429014
_C = (0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716, 0.4288403609558664, 1.0, 1.0, 1.0)
_SLOPE = (_GAMMA, -0.42387512638858027, -0.3384627126235924, 1.8046452872882734, 2.325825639765069, 0.0, 0.0, 0.0)

# x(t + theta h) = (1 - theta) x + theta (x_new + (1 - theta) (r_0 + theta r_1 + theta^2 r_2)), r = _INSIDE k.
_INSIDE = np.array(
    [
        [
            25.948786856663858,
            -2.5579724845846235,
            10.433815404888879,
            -2.3679251022685204,
            0.524948541321073,
            1.1241088310450404,
            0.4272876194431874,
            -0.17202221070155493,
        ],
        [
            -9.91568850695171,
            -0.9689944594115154,
            3.0438037242978453,
            -24.495224566215796,
            20.176138334709044,
            15.98066361424651,
            -6.789040303419874,
            -6.710236069923372,
        ],
        [
            11.419903575922262,
            2.8879645146136994,
            72.92137995996029,
            80.12511834622643,
            -52.072871366152654,
            -59.78993625266729,
            -0.15582684282751913,
            4.883087185713722,
        ],
    ]
)


def _triangle(rows: tuple[tuple[float, ...], ...]) -> NDArray[np.float64]:
    full = np.zeros((len(rows) + 1, len(rows) + 1))
    for i, row in enumerate(rows, start=1):
        full[i, : len(row)] = row
    return full


def _powers(b: NDArray[np.float64]) -> NDArray[np.float64]:
    """The interpolant above as weights of theta^1 ... theta^4, with the empty row for the end of the step."""
    r_0, r_1, r_2 = _INSIDE
    inside = np.stack([b + r_0, r_1 - r_0, r_2 - r_1, -r_2], axis=1)
    return np.vstack([inside, np.zeros(4)])


_B = np.array([*_A[-1], 1.0])

_METHOD = RosenbrockMethod(
    order=5,
    error_order=5,
    gamma=_GAMMA,
    a=_triangle(_A),
    b=_B,
    c=np.array(_C),
    coupling=_triangle(_COUPLING),
    slope=np.array(_SLOPE),
    error=np.array([0.0, 0, 0, 0, 0, 0, 0, 1, 0]),  # the last stage is the difference to the embedded method of order 4
    dense=_powers(_B),
)


@dataclass(frozen=True)
class Rodas(Adaptive):
    """Eight stages, order 5, error estimate and interpolant of order 4, L-stable.

    A step costs nine derivative calls, one of them for the slope in time, and the Jacobian: one directional derivative
    per state, or one derivative call per state where the FMU offers none.
    """

    def method(self) -> RosenbrockMethod:
        """Coefficients of Rodas5P."""
        return _METHOD
