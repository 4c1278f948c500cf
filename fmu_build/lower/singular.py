"""Whether a square system is singular whatever the values of the symbols in it, as x + y = 1 with x + y = 2."""

from collections.abc import Sequence

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from fmu_build.lower.equations import ScalarEquation
from fmu_build.lower.values import Scalar, column

POINTS = 40
SCALINGS = 10
SMALLEST = 1e-13  # singular value of a scaled Jacobian, against the largest, that counts as rounding


def is_singular(equations: Sequence[ScalarEquation], unknowns: Sequence[Scalar]) -> bool:
    """Probe the Jacobian at points; one regular point is proof that the system is not always singular.

    A coefficient that is zero at one point only, such as a switch or a parameter, must not count: hence points far
    apart, of both signs, with zeros and ones among them. Where nothing can be evaluated there is no verdict.
    """
    jacobian = ca.jacobian(column(equation.residual for equation in equations), column(unknowns))
    symbols = ca.symvar(jacobian)
    if not symbols:
        return not _is_regular(ca.DM(jacobian).full())
    function = ca.Function("jacobian", [column(symbols)], [jacobian])
    random = np.random.default_rng(1)
    is_evaluated = False
    for _ in range(POINTS):
        values = function(_point(random, len(symbols))).full()
        if not np.isfinite(values).all():
            continue
        if _is_regular(values):
            return False
        is_evaluated = True
    return is_evaluated


def _point(random: np.random.Generator, n: int) -> NDArray[np.float64]:
    """(n): a half 0 or 1, the others of either sign and of sizes from 0.01 to 100."""
    spread = random.choice([-1.0, 1.0], n) * 10.0 ** random.uniform(-2, 2, n)
    return np.where(random.uniform(size=n) < 0.5, random.integers(0, 2, n).astype(float), spread)


def _is_regular(matrix: NDArray[np.float64]) -> bool:
    """Of a matrix with rows and columns of like size: in SI units, flows and pressures are far apart."""
    for _ in range(SCALINGS):
        for axis in (0, 1):
            size = np.abs(matrix).max(axis=axis, keepdims=True)
            if not size.all():
                return False
            matrix = matrix / np.sqrt(size)
    sizes = np.linalg.svd(matrix, compute_uv=False)
    return bool(sizes[-1] > SMALLEST * sizes[0])
