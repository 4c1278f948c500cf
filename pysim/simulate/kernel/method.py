"""Methods as data: the coefficients of three families, which the kernel steps with."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.simulate.kernel.layout import ESDIRK, EXPLICIT, ROSENBROCK

Array = NDArray[np.float64]


class ExplicitMethod(NamedTuple):
    """Runge-Kutta with s stages: k_i = f(t + c_i h, x + h sum_j a_ij k_j), x_new = x + h sum_i b_i k_i.

    k_s stands for the derivative at the end of the step, which is the first stage of the next one.
    """

    order: int
    error_order: int  # the estimate falls with this power of the step
    a: Array  # (s, s) lower triangle
    b: Array  # (s,)
    c: Array  # (s,)
    error: Array  # (s + 1,) weights of the estimate, times h; zero for a fixed step
    dense: Array  # (s + 1, d) weights of theta^1 ... theta^d in (x(t + theta h) - x) / h


class RosenbrockMethod(NamedTuple):
    """Linearly implicit, with s stages, in the form that needs no product with the Jacobian J:

    (I / (h gamma) - J) k_i = f(t + c_i h, x + sum_j a_ij k_j) + sum_j coupling_ij k_j / h + h slope_i df/dt,
    x_new = x + sum_i b_i k_i.
    """

    order: int
    error_order: int
    gamma: float
    a: Array  # (s, s) strictly lower triangle
    b: Array  # (s,)
    c: Array  # (s,)
    coupling: Array  # (s, s) strictly lower triangle
    slope: Array  # (s,)
    error: Array  # (s + 1,) weights of the estimate; the last one is zero
    dense: Array  # (s + 1, d) weights of theta^1 ... theta^d in x(t + theta h) - x; the last row is zero


class EsdirkMethod(NamedTuple):
    """Diagonally implicit, with s stages: X_i = x + h sum_j a_ij k_j, k_i = f(t + c_i h, X_i).

    The first stage is explicit, every other one has gamma on its diagonal; the last one is the end of the step.
    """

    order: int
    error_order: int
    gamma: float
    a: Array  # (s, s) lower triangle
    b: Array  # (s,) the last row of a
    c: Array  # (s,)
    predict: Array  # (s, s) strictly lower triangle: k_i from the stages before it, where Newton starts
    error: Array  # (s + 1,) weights of the estimate, times h; the last one is zero
    dense: Array  # (s + 1, d) weights of theta^1 ... theta^d in (x(t + theta h) - x) / h; the last row is zero


Method = ExplicitMethod | RosenbrockMethod | EsdirkMethod

_FAMILIES = {ExplicitMethod: EXPLICIT, RosenbrockMethod: ROSENBROCK, EsdirkMethod: ESDIRK}


def method_arrays(method: Method) -> dict[str, Any]:
    """What `Method` of the kernel points to."""
    family = _FAMILIES[type(method)]
    return {
        **{name: value for name, value in method._asdict().items() if name != "order"},
        "family": family,
        "stages": method.b.size,
        "terms": method.dense.shape[1],
        "end_in_error": int(method.error[-1] != 0.0 or family == ESDIRK),
    }
