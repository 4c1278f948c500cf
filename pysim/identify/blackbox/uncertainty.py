"""Covariance of coefficients, poles and zeros, from the Jacobian at the minimum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.identify.blackbox import sections
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.refine import Minimum
from pysim.identify.blackbox.response import whiten

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NULL = 1e-9  # singular value, relative to the largest, below which a direction is undetermined
_TOUCHED = 1e-6


@dataclass(frozen=True)
class Spread:
    """Covariances as factors, for data of unit variance.

    Args:
        inner: (q, r) for the q unknowns and numerator coefficients in the basis; inner @ inner.T is their covariance.
        null: (q, k) directions in which the residuals do not change.
        coefficients: (p, q) derivatives of (b_m ... b0, a_(n-1) ... a0, dead time) by these q, SI units.
        poles: (n_p, q) complex, derivatives of the poles by these q, rad/s.
    """

    inner: Array
    null: Array
    coefficients: Array
    poles: Complex

    def of(self, slopes: NDArray[Any]) -> NDArray[Any]:
        """Covariance factor (n, r) of numbers with derivatives (n, q)."""
        return np.asarray(slopes @ self.inner)

    def touched(self, slopes: NDArray[Any]) -> NDArray[np.bool_]:
        """(n,) whether numbers with derivatives (n, q) change along an undetermined direction."""
        if not self.null.size:
            return np.zeros(slopes.shape[0], dtype=bool)
        size = np.linalg.norm(slopes, axis=1)
        return np.linalg.norm(slopes @ self.null, axis=1) > _TOUCHED * np.where(size > 0, size, 1)


def spread(problem: Problem, minimum: Minimum) -> Spread:
    """Covariance factors at the minimum; an unknown at a bound counts as known."""
    point = minimum.point
    slopes = whiten(problem.roots, np.column_stack([point.slopes, point.basis.columns]))
    free = np.append(~minimum.at_bound, np.ones(point.coefficients.size, dtype=bool))
    inner, null = _invert(slopes, free)
    return Spread(inner, null, _coefficient_slopes(problem, minimum), _pole_slopes(problem, minimum))


def _invert(slopes: Array, free: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Factor of the pseudoinverse of slopes.T @ slopes over the free columns, and the null directions."""
    size = np.linalg.norm(slopes[:, free], axis=0)
    size = np.where(size > 0, size, 1.0)
    _, singular, right = np.linalg.svd(slopes[:, free] / size, full_matrices=False)
    shown = singular > _NULL * singular[0]
    inner = np.zeros((free.size, int(shown.sum())))
    inner[free] = (right[shown].T / singular[shown]) / size[:, None]
    null = np.zeros((free.size, int((~shown).sum())))
    null[free] = right[~shown].T / size[:, None]
    null /= np.maximum(np.linalg.norm(null, axis=0), 1e-300)
    return inner, null


def _coefficient_slopes(problem: Problem, minimum: Minimum) -> Array:
    structure, count = problem.structure, minimum.unknowns.size
    n, m = structure.poles, structure.zeros
    slopes = np.zeros((structure.parameters, count + m + 1))
    powers = float(problem.scale) ** (n - np.arange(m, -1, -1))  # rad/s, of b_m ... b_0
    slopes[: m + 1, count:] = powers[:, None] * minimum.point.basis.powers()
    below = float(problem.scale) ** (n - np.arange(n - 1, -1, -1))
    slopes[m + 1 : m + 1 + n, :n] = below[:, None] * sections.polynomial_slopes(minimum.unknowns[:n])[1:]
    if structure.delayed:
        slopes[-1, count - 1] = 1 / problem.scale
    return slopes


def _pole_slopes(problem: Problem, minimum: Minimum) -> Complex:
    n = problem.structure.poles
    slopes = np.zeros((n, minimum.unknowns.size + problem.structure.zeros + 1), dtype=np.complex128)
    with np.errstate(invalid="ignore"):  # the derivatives of a double pole are infinite
        slopes[:, :n] = problem.scale * sections.pole_slopes(minimum.unknowns[:n])
    return slopes


def zero_slopes(numerator: Array, zeros: Complex) -> Complex:
    """d zeros / d (b_m ... b_0), (m, m + 1): -z^k / N'(z), infinite for double zeros."""
    steep = np.polyval(np.polyder(numerator), zeros)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(-(zeros[:, None] ** np.arange(numerator.size - 1, -1, -1)) / steep[:, None])
