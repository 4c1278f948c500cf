"""Magnitude and phase of a model's swing beside measured ones, with slopes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.types import FrequencyResponse

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

DB = 20 / np.log(10)  # dB per unit of the natural logarithm
# Weight of a dB against a degree. Source: thesis Eq. 2.25.
MAGNITUDE_WEIGHT = 90 / 20


@dataclass(frozen=True)
class LogResponse:
    """Natural logarithm of complex gains: ln(gain) + j phase, (n_f,), and its slopes (n_f, n_x)."""

    values: Complex
    slopes: Complex


def log_response(swing: Array, slopes: Array, amplitude: float) -> tuple[complex, Complex]:
    """One frequency of a LogResponse from sine and cosine parts (2,) and their slopes (2, n_x).

    A model that does not move has a gain whose logarithm is minus infinity; no fit can use such a point.
    """
    gain = complex(swing[0], swing[1]) / amplitude
    with np.errstate(divide="ignore", invalid="ignore"):
        return complex(np.log(gain)), np.asarray((slopes[0] + 1j * slopes[1]) / (amplitude * gain))


def differences(measured: Complex, simulated: LogResponse, reference: int | None) -> tuple[Array, Array]:
    """Measured minus simulated, and its slopes: magnitudes in dB and phases in degrees, (n_f, 1 + n_x) each.

    Args:
        reference: place of the frequency whose gain counts as 0 dB on both sides (Eq. 2.12); None: as they are.
    """
    gap = measured - simulated.values
    magnitude = DB * np.column_stack([gap.real, -simulated.slopes.real])
    if reference is not None:
        magnitude = magnitude - magnitude[reference]
    turned = np.unwrap(gap.imag)
    phase = turned - 2 * np.pi * np.round(turned[0] / (2 * np.pi))
    return magnitude, np.degrees(np.column_stack([phase, -simulated.slopes.imag]))


def thesis_deviation(measured: Complex, simulated: LogResponse, reference: int | None) -> Array:
    """90/20 of the magnitudes in dB, then the phases in degrees, (2 n_f, 1 + n_x). Source: thesis Eq. 2.25."""
    magnitude, phase = differences(measured, simulated, reference)
    return np.concatenate([MAGNITUDE_WEIGHT * magnitude, phase])


def beside_measured(measured: FrequencyResponse, simulated: LogResponse) -> FrequencyResponse:
    """The model's response, its phase in the turn next to the measured one."""
    gap = np.unwrap(simulated.values.imag - measured.phase)
    phase = measured.phase + gap - 2 * np.pi * np.round(gap[0] / (2 * np.pi))
    return replace(
        measured, gain=np.exp(simulated.values.real), phase=phase, origin="simulated", mean=None, covariance=None
    )
