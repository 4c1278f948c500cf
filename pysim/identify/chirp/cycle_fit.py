"""Local fits of the output of a chirp, cycle by cycle, as smooth functions of the command's angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify._near_orthogonal import near_orthogonal_fit

Array = NDArray[np.float64]

# Samples per period for each harmonic of the local fit, most and least harmonics; with fewer samples, those of `_FEW`.
_SAMPLES_EACH, _MOST, _LEAST = 6.0, 5, 3
_FEW = ((10.0, 2), (5.0, 1))
# Smallest number of samples per coefficient.
_SURPLUS = 2.0
# A fit spans one turn, or up to _MOST_TURNS if the frequency changes by at most this share within it.
_CHANGE, _MOST_TURNS = 0.1, 4.0
# Largest condition number of the normal matrix; it is a few thousand if no samples are missing.
_TOLD_APART = 1e5
_GRID = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 91)


@dataclass(frozen=True)
class Samples:
    """A log within its sweep.

    Args:
        angle: (n,) of the command, rad, increasing.
        values: (n,) of the output.
        per_turn: (n,) samples per period there.
        change: (n,) share by which the frequency changes within a period there.
    """

    angle: Array
    values: Array
    per_turn: Array
    change: Array


@dataclass(frozen=True)
class CycleFit:
    """Fit around one angle by harmonics of the command's angle, of which the first may drift linearly.

    Args:
        centre: rad.
        half: rad; the fit covers centre - half to centre + half.
        coefficients: constant, sin, cos, sin 2, cos 2, ..., and sin, cos times the distance from the centre / half.
        inverse: (n_c, n_c) inverse of the normal matrix: covariance of the coefficients for unit noise.
        squares: sum of squares of the residual.
        freedom: number of samples less that of coefficients.
    """

    centre: float
    half: float
    coefficients: Array
    inverse: Array
    squares: float
    freedom: int

    @property
    def phase(self) -> float:
        """Phase of the first harmonic at the centre, relative to the command, in (-pi, pi]."""
        _, sin, cos = self.coefficients[:3]
        return float(np.arctan2(cos, sin))

    def extreme(self, angle: float, sign: int) -> Extreme | None:
        """The top (sign 1) or bottom (-1) within a quarter turn of an angle; None if the curve has none there."""
        grid = angle + _GRID
        best = int(np.argmax(sign * (self._basis(grid, 0) @ self.coefficients)))
        if best in (0, grid.size - 1):
            return None
        at = float(grid[best])
        for _ in range(3):  # Newton on the slope; the grid is two degrees fine
            slope, bend = (float(self._basis(np.array([at]), order)[0] @ self.coefficients) for order in (1, 2))
            if sign * bend >= 0:
                return None
            at += float(np.clip(-slope / bend, -0.05, 0.05))
        value, slope_of = (self._basis(np.array([at]), order)[0] for order in (0, 1))
        slope_variance = float(slope_of @ self.inverse @ slope_of)
        return Extreme(
            angle=at,
            value=float(value @ self.coefficients),
            value_deviation=float(np.sqrt(value @ self.inverse @ value)),
            angle_deviation=float(np.sqrt(slope_variance)) / abs(bend),
            lift=slope_variance / (2 * abs(bend)),
        )

    def _basis(self, angle: Array, order: int) -> Array:
        """The regressors' derivative of an order at angles (n,), (n, n_c)."""
        return regressors(angle, self.centre, self.half, (self.coefficients.size - 3) // 2, order)


@dataclass(frozen=True)
class Extreme:
    """A top or a bottom.

    Args:
        angle: the command's angle at the extreme, rad.
        value: value of the output.
        value_deviation, angle_deviation: standard deviations for noise of unit standard deviation.
        lift: bias of the value, outwards, for such noise: the highest point of a noisy curve is above that of the true
            curve, on average by the variance of the slope over twice the curvature.
    """

    angle: float
    value: float
    value_deviation: float
    angle_deviation: float
    lift: float


def fit_cycle(samples: Samples, centre: float) -> CycleFit | None:
    """Fit one turn or more around an angle; None if the log does not cover it, or has too few samples there."""
    place = min(int(np.searchsorted(samples.angle, centre)), samples.angle.size - 1)
    per_turn = float(samples.per_turn[place])
    harmonics = int(np.clip(per_turn / _SAMPLES_EACH, _LEAST, _MOST))
    for samples_at_least, fewer in _FEW:
        harmonics = harmonics if per_turn >= samples_at_least else fewer
    count = 2 * harmonics + 3
    turns = float(np.clip(_CHANGE / max(float(samples.change[place]), 1e-12), 1.0, _MOST_TURNS))
    half = np.pi * max(turns, _SURPLUS * count / per_turn)
    slack = 2 * np.pi / per_turn
    if samples.angle[0] > centre - half + slack or samples.angle[-1] < centre + half - slack:
        return None
    inside = slice(*np.searchsorted(samples.angle, [centre - half, centre + half]).tolist())
    angle, values = samples.angle[inside], samples.values[inside]
    if angle.size <= count:
        return None
    matrix = regressors(angle, centre, half, harmonics, 0)
    square = matrix.T @ matrix
    if np.linalg.cond(square) > _TOLD_APART:
        return None
    coefficients = near_orthogonal_fit(matrix, values)
    left_over = values - matrix @ coefficients
    inverse = np.linalg.inv(square)
    return CycleFit(
        centre,
        half,
        coefficients,
        np.asarray(inverse, dtype=np.float64),
        float(left_over @ left_over),
        angle.size - count,
    )


def regressors(angle: Array, centre: float, half: float, harmonics: int, order: int) -> Array:
    """(n, n_c): constant, sin and cos of each harmonic, drifting sin and cos; or their derivative of an order."""
    number = np.arange(1, harmonics + 1)
    turned = angle[:, None] * number + order * (np.pi / 2)
    matrix = np.empty((angle.size, 2 * harmonics + 3))
    matrix[:, 0] = 1.0 if order == 0 else 0.0
    matrix[:, 1:-2:2] = number**order * np.sin(turned)
    matrix[:, 2:-2:2] = number**order * np.cos(turned)
    through = (angle - centre) / half
    matrix[:, -2] = through * matrix[:, 1]
    matrix[:, -1] = through * matrix[:, 2]
    if order > 0:
        before = angle + (order - 1) * (np.pi / 2)
        matrix[:, -2] += order / half * np.sin(before)
        matrix[:, -1] += order / half * np.cos(before)
    return matrix
