"""Identifiability: products of powers of the parameters that the data do not determine, from the Jacobian."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from pysim.types import Direction

Array = NDArray[np.float64]

# A direction is undetermined if its singular value is below this share of the largest. A true zero comes out smaller,
# in spite of errors of the Jacobian; directions that measurements determine have larger values.
EXACT = 1e-5
# Directions are reported if the standard deviation of ln s along them is at least this.
LOOSE = 0.2
_WHOLE = 0.02  # difference from a small fraction within which a ratio of exponents is rounded to that fraction


@dataclass(frozen=True)
class Identifiability:
    """Directions in parameter space that the data determine badly or not at all.

    Args:
        exact: (n, n_0) sparse basis of the directions of ln(p) that change no residual.
        directions: these, then the badly determined ones, each with its standard deviation.
    """

    exact: Array
    directions: tuple[Direction, ...]


def identifiability(keys: Sequence[str], slopes: Array, *, noise: float = 1.0) -> Identifiability:
    """Find the directions that the data do not determine, by singular values of the Jacobian.

    Args:
        keys: names of the n parameters.
        slopes: (n_r, n) Jacobian by ln(p) of the residuals, which are in standard deviations.
        noise: actual standard deviation of these residuals; above 1 if the model leaves more than noise.
    """
    empty = np.zeros((max(len(keys) - slopes.shape[0], 0), len(keys)))
    triangle = np.linalg.qr(np.vstack([slopes, empty]), mode="r")  # as many rows as parameters, not as residuals
    _, size, rows = np.linalg.svd(triangle)
    none = size <= EXACT * max(size.max(initial=0.0), np.finfo(float).tiny)
    exact = _sparse(rows[none].T)
    found = [_exact_direction(keys, column) for column in exact.T]
    for value, row in zip(size[~none][::-1], rows[~none][::-1], strict=True):
        found += _loose_direction(keys, row, noise / value)
    return Identifiability(exact, tuple(found))


def _sparse(basis: Array) -> Array:
    """Another basis of the same space (n, n_0), in reduced column form: each column has a 1 where the others have 0."""
    basis = basis.copy()
    pivots: list[int] = []
    for j in range(basis.shape[1]):
        weight = np.abs(basis[:, j])
        weight[pivots] = 0
        i = int(np.argmax(weight))
        pivots.append(i)
        basis[:, j] /= basis[i, j]
        for other in range(basis.shape[1]):
            if other != j:
                basis[:, other] -= basis[i, other] * basis[:, j]
    return basis


def _exact_direction(keys: Sequence[str], direction: Array) -> Direction:
    return Direction(whole_exponents(keys, direction), np.inf)


def _loose_direction(keys: Sequence[str], row: Array, spread: float) -> list[Direction]:
    """The direction, scaled to exponent 1 for the parameter that changes most; none if it is known well enough."""
    top = int(np.argmax(np.abs(row)))
    direction, spread = row / row[top], spread * abs(row[top])
    if spread < LOOSE:
        return []
    exponents = {name: round(float(e), 2) for name, e in zip(keys, direction, strict=True) if abs(e) >= 0.1}
    return [Direction(exponents, spread)]


def whole_exponents(keys: Sequence[str], direction: Array) -> dict[str, float]:
    """Exponents of the parameters, the smallest scaled to 1; rounded to small fractions if all are close to such."""
    large = np.abs(direction) > _WHOLE * np.max(np.abs(direction))
    unit = direction[large][np.argmin(np.abs(direction[large]))]
    ratios = np.where(large, direction / unit, 0.0)
    near = np.array([float(Fraction(float(v)).limit_denominator(4)) for v in ratios])
    values = near if np.all(np.abs(near - ratios) < _WHOLE * np.maximum(np.abs(ratios), 1.0)) else np.round(ratios, 3)
    first = next(v for v in values if v)
    return {name: float(v * np.sign(first)) for name, v in zip(keys, values, strict=True) if v}
