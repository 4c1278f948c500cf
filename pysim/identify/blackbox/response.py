"""Measured complex gains with their noise, to which a transfer function is fitted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, FrequencyResponse

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

WEIGHTS = ("covariance", "uniform", "relative")


@dataclass(frozen=True)
class ComplexResponse:
    """Complex gains over frequency.

    Args:
        frequency: (n_f,) Hz, positive, increasing.
        values: (n_f,) complex gain, output unit per input unit; the phase is negative if the output lags.
        covariance: (n_f, 2, 2) of real and imaginary part, in the square of that unit; None if not known.
        origin: description for legends and tables.
    Raises:
        BadInput: shapes that do not match, numbers that are not finite, frequencies that do not increase.
    """

    frequency: Array
    values: Complex
    covariance: Array | None = None
    origin: str = "measured"

    def __post_init__(self) -> None:
        n_f = np.size(self.frequency)
        for name, shape, kind in (
            ("frequency", (n_f,), np.float64),
            ("values", (n_f,), np.complex128),
            ("covariance", (n_f, 2, 2), np.float64),
        ):
            if getattr(self, name) is None:
                continue
            array = np.array(getattr(self, name), dtype=kind)
            if array.shape != shape or not np.isfinite(array).all():
                raise BadInput(f"complex response: {name} needs shape {shape} and finite numbers, got {array.shape}")
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        if n_f == 0 or self.frequency[0] <= 0 or np.any(np.diff(self.frequency) <= 0):
            raise BadInput("complex response: frequencies must be positive and increase")
        if not np.any(self.values):
            raise BadInput(f"complex response: {self.origin} is zero at every frequency; there is nothing to fit")


def complex_response(response: FrequencyResponse) -> ComplexResponse:
    """Complex gain from gain and phase; the covariance of real and imaginary part from that of amplitude and phase.

    To first order: d G = exp(j phase) (d gain + j gain d phase), d gain = d amplitude / commanded amplitude.
    """
    values = response.gain * np.exp(1j * response.phase)
    covariance = None
    if response.covariance is not None:
        cos, sin = np.cos(response.phase), np.sin(response.phase)
        turn = np.array([[cos / response.test.amplitude, -response.gain * sin], [sin, response.gain * cos]])
        turn[1, 0] /= response.test.amplitude
        turn = np.moveaxis(turn, -1, 0)
        covariance = turn @ response.covariance[:, :2, :2] @ np.swapaxes(turn, 1, 2)
    return ComplexResponse(response.frequency, values, covariance, response.origin)


def whitening(response: ComplexResponse, weights: str) -> Array:
    """Matrices (n_f, 2, 2) that turn deviations (real, imaginary) into independent ones of equal variance.

    Args:
        weights: "covariance": by the response's covariance, to variance 1; "uniform": all points equal, over the root
            mean square gain; "relative": each point over its own gain, which means equal dB and degrees.
    Raises:
        BadInput: unknown weights, or a covariance that is missing or not positive definite.
    """
    n_f, gain = response.frequency.size, np.abs(response.values)
    if weights == "covariance":
        return _inverse_root(response)
    if weights not in WEIGHTS:
        raise BadInput(f"weights: {weights!r} is not known; use one of {', '.join(WEIGHTS)}")
    size = np.full(n_f, np.sqrt(np.mean(gain**2))) if weights == "uniform" else gain
    if not np.all(size > 0):
        raise BadInput(f"weights: a gain of zero cannot be weighted as {weights!r}; use uniform, or drop the point")
    return np.eye(2) / size[:, None, None]


def _inverse_root(response: ComplexResponse) -> Array:
    if response.covariance is None:
        raise BadInput(
            f"weights: {response.origin} has no covariance; use the weights uniform (noise alike at every frequency) "
            "or relative (noise in proportion to the gain)"
        )
    try:
        return np.linalg.inv(np.linalg.cholesky(response.covariance))
    except np.linalg.LinAlgError:
        raise BadInput(
            f"weights: the covariance of {response.origin} is not positive definite at every frequency, as of a signal "
            "without noise; use the weights uniform or relative"
        ) from None


def whiten(roots: Array, columns: Complex) -> Array:
    """Complex columns (n_f, n) -> whitened real ones (2 n_f, n); the two rows of a frequency follow each other."""
    white = np.empty((columns.shape[0], 2, columns.shape[1]))
    real, imag = columns.real, columns.imag
    for row in (0, 1):
        white[:, row] = roots[:, row, :1] * real + roots[:, row, 1:] * imag
    return white.reshape(2 * columns.shape[0], -1)
