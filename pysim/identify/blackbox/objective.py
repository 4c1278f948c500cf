"""The weighted misfit as a function of poles and dead time alone; the numerator follows by linear least squares."""

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
    """The best numerator for given sections and dead time.

    Args:
        basis: of the numerator over the denominator, delayed.
        coefficients: (n_z + 1,) in that basis.
        model: (n_f,) complex gain.
        residual: (2 n_f,) weighted, measured minus model.
        slopes: (n_f, n) complex, d model / d sections and dead time at fixed numerator; of all n unknowns.
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

    Unknowns are the numbers of the sections (n_p,), then the dead time where it is searched for.
    """

    structure: Structure
    s: Complex
    values: Complex
    roots: Array
    white: Array
    scale: float

    @classmethod
    def of(cls, response: ComplexResponse, structure: Structure, roots: Array) -> Problem:
        """Scaled by the geometric mean of the lowest and the highest frequency."""
        omega = 2 * np.pi * response.frequency
        scale = float(np.sqrt(omega[0] * omega[-1]))
        white = whiten(roots, response.values[:, None])[:, 0]
        return cls(structure, np.asarray(1j * omega / scale, dtype=np.complex128), response.values, roots, white, scale)

    def delay(self, unknowns: Array) -> float:
        """Dead time in units of 1 / scale."""
        return float(unknowns[-1]) if self.structure.delayed else self.structure.dead_time * self.scale

    def evaluate(self, unknowns: Array) -> Point:
        """The best numerator and what is left over."""
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
        """d residual / d unknowns, (2 n_f, n), at the numerator that follows.

        Kaufman's form of variable projection (BIT 15, 1975): its product with the residual is the exact gradient,
        since the term left out is orthogonal to the residual.
        """
        white = whiten(self.roots, point.slopes)
        return point.basis.white @ (point.basis.white.T @ white) - white
