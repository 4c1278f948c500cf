"""Polynomials times a weight, orthonormal on the measured points, which are well conditioned at any degree."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.blackbox.response import whiten

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Basis:
    """Columns p_k(s) w(s) for polynomials p_0 ... p_m, p_k of degree k, and a weight w.

    Args:
        columns: (n_f, m + 1) complex.
        white: (2 n_f, m + 1) the whitened columns, which are orthonormal.
        recurrence: (m + 1, m) upper Hessenberg, s p_k = sum_j recurrence[j, k] p_j.
        first: value of the constant p_0.
    """

    columns: Complex
    white: Array
    recurrence: Array
    first: float

    def powers(self) -> Array:
        """Coefficients of every p_k, (m + 1, m + 1), rows from the highest power of s down."""
        count = self.columns.shape[1]
        table = np.zeros((count, count))
        table[-1, 0] = self.first
        for k in range(count - 1):
            shifted = np.append(table[1:, k], 0.0)
            table[:, k + 1] = (shifted - table[:, : k + 1] @ self.recurrence[: k + 1, k]) / self.recurrence[k + 1, k]
        return table

    def roots(self, coefficients: Array) -> Complex:
        """Roots of sum_k coefficients[k] p_k, as eigenvalues of the recurrence without its last row.

        The leading coefficient must not be zero. Nearly equal real roots may come out as a conjugate pair.
        """
        degree = coefficients.size - 1
        companion = self.recurrence[:degree, :degree].copy()
        last = self.recurrence[degree, degree - 1]
        companion[:, -1] -= last / coefficients[-1] * coefficients[:-1]
        return np.asarray(np.linalg.eigvals(companion), dtype=np.complex128)


def krylov_basis(start: Complex, s: Complex, degree: int, roots: Array) -> Basis:
    """Basis by repeated multiplication of the weight `start` (n_f,) by s (n_f,), with orthonormalisation (Arnoldi).

    Args:
        degree: degree m of the last polynomial.
        roots: (n_f, 2, 2) whitening of the inner product, from `whitening`.
    """
    columns = np.empty((s.size, degree + 1), dtype=np.complex128)
    white = np.empty((2 * s.size, degree + 1))
    recurrence = np.zeros((degree + 1, degree))
    column, weighted = start, whiten(roots, start[:, None])[:, 0]
    first = 1 / np.linalg.norm(weighted)
    columns[:, 0], white[:, 0] = column * first, weighted * first
    for k in range(degree):
        column = s * columns[:, k]
        weighted = whiten(roots, column[:, None])[:, 0]
        for _ in range(2):  # twice, to remove rounding errors
            part = white[:, : k + 1].T @ weighted
            weighted = weighted - white[:, : k + 1] @ part
            column = column - columns[:, : k + 1] @ part
            recurrence[: k + 1, k] += part
        recurrence[k + 1, k] = size = np.linalg.norm(weighted)
        columns[:, k + 1], white[:, k + 1] = column / size, weighted / size
    return Basis(columns, white, recurrence, float(first))
