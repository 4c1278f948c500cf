"""Least-squares fit of a sine of known angle, its harmonics and a mean, to samples of which some may be missing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri, stdtrit

from pysim.identify._near_orthogonal import near_orthogonal_fit

Array = NDArray[np.float64]

# Largest condition number at which columns count as distinguishable; 1.4 if no sample is missing. At four, missing
# samples make the variance of the sine up to four times that of as many evenly spaced samples.
_TOLD_APART = 4.0
_NEXT = 5  # number of harmonics from which noise is estimated, if there are no spectral lines between them


@dataclass(frozen=True)
class HarmonicFit:
    """Coefficients of columns, their covariance, and the residual.

    Args:
        columns: (n, n_c): sin, cos, sin 2, cos 2, ... of the angle, a constant, and further fitted columns.
        coefficients: (n_c,).
        inverse: (n_c, n_c) inverse of the normal matrix: covariance of the coefficients for unit white noise.
        left_over: (n,) residual.
    """

    columns: Array
    coefficients: Array
    inverse: Array
    left_over: Array

    def level_of_harmonics(self) -> float:
        """Standard deviation of white noise that explains the median of the first harmonics; 0 without harmonics.

        The harmonics contain the slow part of coloured noise, which the residual of a single period does not. The
        median is robust against one or two harmonics of the plant itself. The result is widened for their small number.
        """
        sines = np.arange(2, self.columns.shape[1] - 1, 2)[:_NEXT]
        if sines.size == 0:
            return 0.0
        sizes = self.coefficients[sines] ** 2 + self.coefficients[sines + 1] ** 2
        squares = sizes / (self.inverse[sines, sines] + self.inverse[sines + 1, sines + 1])
        return float(np.sqrt(np.median(squares) / math.log(2)) * stdtrit(sines.size, 0.975) / ndtri(0.975))

    @property
    def freedom(self) -> int:
        """Number of samples less that of coefficients."""
        return self.columns.shape[0] - self.columns.shape[1]


def waves(angle: Array, count: int) -> Array:
    """Columns sin and cos of 1 .. count times the angle (n,), and a constant: (n, 2 count + 1)."""
    columns = [function(k * angle) for k in range(1, count + 1) for function in (np.sin, np.cos)]
    return np.column_stack([*columns, np.ones_like(angle)])


def told_apart(angle: Array, count: int) -> int:
    """Number of sine and harmonics, at most `count`, that samples at these angles (n,) can distinguish; 0 for none."""
    columns = waves(angle, count)
    square = columns.T @ columns
    for few in range(count, 0, -1):
        kept = np.r_[0 : 2 * few, -1]
        if np.linalg.cond(square[np.ix_(kept, kept)]) <= _TOLD_APART**2:
            return few
    return 0


def harmonic_fit(angle: Array, y: Array, count: int, *, lost: bool, drifting: bool = False) -> HarmonicFit:
    """Fit sine, harmonics and mean.

    Args:
        angle, y: (n,) samples over whole periods.
        count: number of sine and harmonics.
        lost: whether samples are missing; if not, the columns are taken as orthogonal.
        drifting: whether to append two columns, sin and cos times a line from -1 to 1.
    """
    columns, squares = waves(angle, count), [0.5] * (2 * count) + [1.0]
    if drifting:
        through = np.interp(angle, angle[[0, -1]], [-1.0, 1.0])
        columns = np.column_stack([columns, through * np.sin(angle), through * np.cos(angle)])
        squares += [0.5 * float(np.mean(through**2))] * 2
    if lost:
        q, r = np.linalg.qr(columns)
        coefficients, root = np.linalg.solve(r, q.T @ y), np.linalg.inv(r)
        inverse = np.asarray(root @ root.T)
    else:
        coefficients = near_orthogonal_fit(columns, y)
        inverse = np.diag(1 / (y.size * np.array(squares)))
    return HarmonicFit(columns, coefficients, inverse, y - columns @ coefficients)
