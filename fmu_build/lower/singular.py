"""Whether a square system is singular whatever the values of the symbols in it, as x + y = 1 with x + y = 2."""

from collections.abc import Callable, Iterator, Mapping, Sequence

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from fmu_build.lower.equations import ScalarEquation
from fmu_build.lower.values import Scalar, column

Typical = Callable[[], Mapping[int, float]]  # values of a run, in SI units, by the hash of their symbol

POINTS = 40  # of each kind
LARGEST = (2, 9)  # powers of ten: of plain numbers, and of pressures in Pa with their moduli
SCALINGS = 10
SMALLEST = 1e-13  # singular value of a scaled Jacobian, against the largest, that counts as rounding


def is_singular(equations: Sequence[ScalarEquation], unknowns: Sequence[Scalar], typical: Typical = dict) -> bool:
    """Probe the Jacobian at points; one regular point is proof that the system is not always singular.

    A coefficient that is zero at one point only, such as a switch or a parameter, must not count: hence points far
    apart, of both signs, with zeros and ones among them, and others around the values the model starts from. Where
    nothing can be evaluated there is no verdict, nor where a coefficient that is no plain zero is zero at every point:
    `if T > 273.15 then ... else 0` may be so outside of a range that no point has met.
    """
    jacobian = ca.jacobian(column(equation.residual for equation in equations), column(unknowns))
    symbols = ca.symvar(jacobian)
    if not symbols:
        return not _is_regular(ca.DM(jacobian).full())
    function = ca.Function("jacobian", [column(symbols)], [jacobian])
    has_been = np.zeros(jacobian.shape, dtype=bool)
    is_evaluated = False
    for point in _points(symbols, typical):
        values = function(point).full()
        if not np.isfinite(values).all():
            continue
        if _is_regular(values):
            return False
        is_evaluated = True
        has_been |= values != 0
    return is_evaluated and bool(has_been[_is_written(jacobian)].all())


def _is_written(jacobian: ca.SX) -> NDArray[np.bool_]:
    """Where an expression stands that is no plain zero."""
    written = np.zeros(jacobian.shape, dtype=bool)
    rows, columns = jacobian.sparsity().get_triplet()
    for k, place in enumerate(zip(rows, columns, strict=True)):
        written[place] = not jacobian.nz[k].is_zero()
    return written


def _points(symbols: Sequence[Scalar], typical: Typical) -> Iterator[NDArray[np.float64]]:
    """(n): a half 0 or 1, the others of either sign and of sizes from 0.01 on; then typical values, changed by half."""
    random, n = np.random.default_rng(1), len(symbols)
    for largest in LARGEST:
        for _ in range(POINTS):
            spread = random.choice([-1.0, 1.0], n) * 10.0 ** random.uniform(-2, largest, n)
            yield np.where(random.uniform(size=n) < 0.5, random.integers(0, 2, n).astype(float), spread)
    known = typical()
    centre = np.array([known.get(symbol.element_hash(), 1.0) for symbol in symbols])
    yield centre
    for _ in range(POINTS):
        yield centre * random.uniform(0.5, 1.5, n)


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
