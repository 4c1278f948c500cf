"""Weighted residuals as a function of denominator and dead time; the numerator follows by linear least squares."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.blackbox.krylov import Basis, krylov_basis
from pysim.identify.blackbox.response import ComplexResponse, whiten
from pysim.identify.blackbox.sections import values_and_slopes
from pysim.identify.blackbox.structure import Structure

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Point:
    """The best numerator for a given denominator and dead time.

    Args:
        basis: basis of the numerator, over the denominator and delayed.
        coefficients: (n_z + 1,) of the numerator in this basis.
        model: (n_f,) complex gain.
        residual: (2 n_f,) weighted, measured minus model.
        slopes: (n_f, n) complex, derivatives of the model by all n unknowns, at a constant numerator.
    """

    basis: Basis
    coefficients: Array
    model: Complex
    residual: Array
    slopes: Complex

    @property
    def cost(self) -> float:
        """The sum of squares."""
        return float(self.residual @ self.residual)


@dataclass(frozen=True)
class Problem:
    """Data, weights and structure, with s in units of `scale` (rad/s) and dead times in 1 / `scale`.

    Unknowns are the denominator's numbers (n_p,), see `sections`, then the dead time if it is estimated.
    """

    structure: Structure
    s: Complex
    values: Complex
    roots: Array
    white: Array
    scale: float

    @classmethod
    def of(cls, response: ComplexResponse, structure: Structure, roots: Array) -> Problem:
        """The problem, with the geometric mean of the lowest and the highest frequency as scale."""
        omega = 2 * np.pi * response.frequency
        scale = float(np.sqrt(omega[0] * omega[-1]))
        white = whiten(roots, response.values[:, None])[:, 0]
        return cls(structure, np.asarray(1j * omega / scale, dtype=np.complex128), response.values, roots, white, scale)

    def delay(self, unknowns: Array) -> float:
        """Dead time in units of 1 / scale."""
        return float(unknowns[-1]) if self.structure.delayed else self.structure.dead_time * self.scale

    def evaluate(self, unknowns: Array) -> Point:
        """The best numerator and the residual at unknowns (n,)."""
        numbers = unknowns[: self.structure.poles]
        denominator, slopes = values_and_slopes(numbers, self.s)
        start = np.exp(-self.delay(unknowns) * self.s) / denominator
        basis = krylov_basis(start, self.s, self.structure.zeros, self.roots)
        coefficients = basis.white.T @ self.white
        model = basis.columns @ coefficients
        residual = self.white - basis.white @ coefficients
        every = np.column_stack([slopes, self.s]) if self.structure.delayed else slopes
        return Point(basis, coefficients, model, residual, -model[:, None] * every)

    def jacobian(self, point: Point) -> Array:
        """d residual / d unknowns, (2 n_f, n), with the numerator as a function of the unknowns.

        Kaufman's form of variable projection (BIT 15, 1975). Its product with the residual is the exact gradient,
        since the neglected term is orthogonal to the residual.
        """
        white = whiten(self.roots, point.slopes)
        return point.basis.white @ (point.basis.white.T @ white) - white
