"""Which products of powers of the parameters the data cannot tell, read from the sensitivities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from pysim.types import Direction

Array = NDArray[np.float64]

# A direction is undetermined where its singular value is below this share of the largest: above what the sensitivities'
# own error leaves of a true zero, and below what measurements tell apart.
EXACT = 1e-5
# Directions known to no better than this standard deviation (of ln s) are worth a mention.
LOOSE = 0.2
_WHOLE = 0.02  # how near a ratio of exponents has to be to a small fraction to be called that fraction


@dataclass(frozen=True)
class Identifiability:
    """What the sensitivities say.

    Args:
        exact: (n, n_0) a basis of directions of ln(p) that change nothing, in a form with many zeros.
        directions: these, then those known badly, each with its standard deviation.
    """

    exact: Array
    directions: tuple[Direction, ...]


def identifiability(keys: Sequence[str], slopes: Array, *, noise: float = 1.0) -> Identifiability:
    """Find the directions that the data leave open.

    Args:
        keys: (n) parameters.
        slopes: (n_r, n) of the residuals, in standard deviations, by ln(p).
        noise: standard deviations of the residuals in units of themselves: the misfit where that is above one.
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
    """The same space (n, n_0) by reduced columns: each has a 1 where all others have a 0."""
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
    """Scaled so that the parameter that changes most has the exponent 1."""
    top = int(np.argmax(np.abs(row)))
    direction, spread = row / row[top], spread * abs(row[top])
    if spread < LOOSE:
        return []
    exponents = {name: round(float(e), 2) for name, e in zip(keys, direction, strict=True) if abs(e) >= 0.1}
    return [Direction(exponents, spread)]


def whole_exponents(keys: Sequence[str], direction: Array) -> dict[str, float]:
    """Exponents scaled so that the smallest is 1 or, where that makes all of them small fractions, those."""
    large = np.abs(direction) > _WHOLE * np.max(np.abs(direction))
    unit = direction[large][np.argmin(np.abs(direction[large]))]
    ratios = np.where(large, direction / unit, 0.0)
    near = np.array([float(Fraction(float(v)).limit_denominator(4)) for v in ratios])
    values = near if np.all(np.abs(near - ratios) < _WHOLE * np.maximum(np.abs(ratios), 1.0)) else np.round(ratios, 3)
    first = next(v for v in values if v)
    return {name: float(v * np.sign(first)) for name, v in zip(keys, values, strict=True) if v}
