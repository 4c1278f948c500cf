"""Least-squares fit of a sine of known frequency, with its covariance (thesis Section 2.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SineFit:
    """amplitude sin(2 pi f (t - origin) + phase) + offset.

    covariance (3, 3) is that of (amplitude, phase, offset), in the signal's unit and rad; residual is the standard
    deviation of the residuals, in the signal's unit.
    """

    amplitude: float
    phase: float
    offset: float
    covariance: Array
    residual: float


def sine_fit(
    time: Array, values: Array, frequency: float, *, origin: float = 0.0, noise: float | None = None
) -> SineFit:
    """Fit amplitude, phase and offset.

    Args:
        time: (n_t,) s, at least four samples, not necessarily equidistant.
        values: (n_t,) the signal.
        frequency: Hz.
        origin: time in s at which the phase is given.
        noise: standard deviation of the samples, in the signal's unit; None estimates it from the residuals.
    Returns:
        the phase in (-pi, pi], and a covariance to first order in noise / amplitude.
    Raises:
        BadInput: samples that are not finite, of unequal number, or that do not determine a sine.
    Source: thesis Eq. 2.4-2.10. Differs: QR in place of the normal equations (2.7), which square the condition
    number; the four-quadrant arctangent in place of (2.9), which loses half a turn.
    """
    time, values = np.asarray(time, dtype=np.float64), np.asarray(values, dtype=np.float64)
    if time.shape != values.shape or time.ndim != 1 or time.size < 4:
        raise BadInput(
            f"sine fit: needs two rows of at least four samples, got {time.shape} times, {values.shape} values"
        )
    if not (np.isfinite(time).all() and np.isfinite(values).all()):
        raise BadInput("sine fit: every time and value must be finite")
    q, r = np.linalg.qr(_regressors(time - origin, frequency))
    if np.linalg.cond(r) > 1e8:
        raise BadInput(
            f"sine fit: {time.size} samples from {time[0]:g} to {time[-1]:g} s do not determine a sine of "
            f"{frequency:g} Hz; record at least half a period, sampled faster than twice the frequency"
        )
    projected = q.T @ values
    c = np.linalg.solve(r, projected)
    left_over = values - q @ projected
    residual = float(np.sqrt(left_over @ left_over / (time.size - 3)))
    inverse = np.linalg.inv(r)
    covariance = (residual if noise is None else noise) ** 2 * inverse @ inverse.T
    amplitude, phase = float(np.hypot(c[0], c[1])), float(np.arctan2(c[1], c[0]))
    return SineFit(amplitude, phase, float(c[2]), to_polar(covariance, amplitude, phase), residual)


def _regressors(time: Array, frequency: float) -> Array:
    """The matrix of Eq. 2.6, (n_t, 3)."""
    angle = 2 * np.pi * frequency * time
    return np.column_stack([np.sin(angle), np.cos(angle), np.ones_like(angle)])


def to_polar(covariance: Array, amplitude: float, phase: float) -> Array:
    """Covariance of (c_1, c_2, c_3) -> that of (amplitude, phase, offset), by the Jacobian of Eq. 2.8-2.10."""
    s, c = np.sin(phase), np.cos(phase)
    if amplitude == 0.0:  # the phase is undetermined
        turn = np.array([[c, s, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        return turn @ covariance @ turn.T + np.diag([0.0, np.inf, 0.0])
    turn = np.array([[c, s, 0.0], [-s / amplitude, c / amplitude, 0.0], [0.0, 0.0, 1.0]])
    return turn @ covariance @ turn.T
