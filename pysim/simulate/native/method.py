"""Methods as data: coefficients of the families, and which native function steps with them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.simulate.native.compiled import doubles, native
from pysim.simulate.native.esdirk import attempt_esdirk
from pysim.simulate.native.explicit import attempt_explicit
from pysim.simulate.native.rosenbrock import attempt_rosenbrock

Array = NDArray[np.float64]

EXPLICIT, ROSENBROCK, ESDIRK = range(3)

METHOD = np.dtype(
    [
        ("family", np.int64),
        ("stages", np.int64),  # s
        ("terms", np.int64),  # d
        ("error_order", np.float64),
        ("end_in_error", np.int64),  # 1: an attempt fills dx_new itself
        ("gamma", np.float64),
        *((name, np.int64) for name in ("a", "b", "c", "error", "dense", "coupling", "slope", "predict")),  # addresses
    ]
)


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
    """What METHOD points to."""
    family = _FAMILIES[type(method)]
    return {
        **{name: value for name, value in method._asdict().items() if name != "order"},
        "family": family,
        "stages": method.b.size,
        "terms": method.dense.shape[1],
        "end_in_error": int(method.error[-1] != 0.0 or family == ESDIRK),
    }


@native
def attempt_step(job: Any, h: float) -> tuple[int, float]:
    """One step of length h (s) from run.t: fills k and x_new (dx_new if it enters the error); status and error norm."""
    if job.method.family == EXPLICIT:
        return attempt_explicit(job, h)
    if job.method.family == ESDIRK:
        return attempt_esdirk(job, h)
    return attempt_rosenbrock(job, h)


@native
def dense_coefficients(job: Any, h: float) -> None:
    """Fill work.dense with the interpolant over the step just taken."""
    work, method = job.work, job.method
    n, terms = work.n, method.terms
    scale = 1.0 if method.family == ROSENBROCK else h
    k, weights, dense = doubles(work.k), doubles(method.dense), doubles(work.dense)
    for j in range(terms * n):
        dense[j] = 0.0
    for i in range(method.stages + 1):
        for p in range(terms):
            weight = scale * weights[i * terms + p]
            if weight != 0.0:
                for j in range(n):
                    dense[p * n + j] += weight * k[i * n + j]
