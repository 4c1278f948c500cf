"""A sine of known angle, its harmonics and a mean, fitted to samples that may lack some."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri, stdtrit

from pysim.identify._near_orthogonal import near_orthogonal_fit

Array = NDArray[np.float64]

# Condition number up to which columns count as told apart; 1.4 where no sample is lost. At four, lost samples make the
# variance of the sine up to four times that of as many even ones.
_TOLD_APART = 4.0
_NEXT = 5  # harmonics next to the sine, by which noise is judged where nothing else lies between them


@dataclass(frozen=True)
class HarmonicFit:
    """Coefficients of columns, and what noise does to them.

    Args:
        columns: (n, n_c): sin, cos, sin 2, cos 2, ... of the angle, a constant, and what else was fitted.
        coefficients: (n_c,).
        inverse: (n_c, n_c) of the normal matrix: their covariance by white noise of unit variance.
        left_over: (n,).
    """

    columns: Array
    coefficients: Array
    inverse: Array
    left_over: Array

    def level_of_harmonics(self) -> float:
        """Standard deviation of white noise that would be as large as most of the harmonics next to the sine are.

        Noise with a memory has its slow part there, and none in what a single period leaves over. The median hardly
        minds one or two that the system itself makes. Widened for how few they are. 0 for a sine without harmonics.
        """
        sines = np.arange(2, self.columns.shape[1] - 1, 2)[:_NEXT]
        if sines.size == 0:
            return 0.0
        sizes = self.coefficients[sines] ** 2 + self.coefficients[sines + 1] ** 2
        squares = sizes / (self.inverse[sines, sines] + self.inverse[sines + 1, sines + 1])
        return float(np.sqrt(np.median(squares) / math.log(2)) * stdtrit(sines.size, 0.975) / ndtri(0.975))

    @property
    def freedom(self) -> int:
        """Samples less coefficients."""
        return self.columns.shape[0] - self.columns.shape[1]


def waves(angle: Array, count: int) -> Array:
    """sin and cos of 1 .. count times the angle, and a constant: (n, 2 count + 1)."""
    columns = [function(k * angle) for k in range(1, count + 1) for function in (np.sin, np.cos)]
    return np.column_stack([*columns, np.ones_like(angle)])


def told_apart(angle: Array, count: int) -> int:
    """How many of the sine and its harmonics samples at these angles (n,) tell apart, at most `count`; 0 for none."""
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
        count: of the sine and its harmonics.
        lost: whether samples are missing among them; else the columns are taken for orthogonal.
        drifting: whether two columns follow, sin and cos times a line from -1 to 1.
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
