"""Magnitude and phase of a model's response compared with measured ones, with derivatives."""

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
    """Natural logarithm of complex gains: ln(gain) + j phase, (n_f,), and its derivatives (n_f, n_x)."""

    values: Complex
    slopes: Complex


def log_response(swing: Array, slopes: Array, amplitude: float) -> tuple[complex, Complex]:
    """One frequency of a LogResponse from sine and cosine amplitudes (2,) and their derivatives (2, n_x).

    The logarithm is minus infinity if the model does not move; a fit rejects this point.
    """
    gain = complex(swing[0], swing[1]) / amplitude
    with np.errstate(divide="ignore", invalid="ignore"):
        return complex(np.log(gain)), np.asarray((slopes[0] + 1j * slopes[1]) / (amplitude * gain))


def differences(measured: Complex, simulated: LogResponse, reference: int | None) -> tuple[Array, Array]:
    """Measured minus simulated magnitudes in dB and phases in degrees, each with derivatives, (n_f, 1 + n_x).

    Args:
        reference: index of the frequency whose gain counts as 0 dB for both (Eq. 2.12); None: absolute gains.
    """
    gap = measured - simulated.values
    magnitude = DB * np.column_stack([gap.real, -simulated.slopes.real])
    if reference is not None:
        magnitude = magnitude - magnitude[reference]
    turned = np.unwrap(gap.imag)
    phase = turned - 2 * np.pi * np.round(turned[0] / (2 * np.pi))
    return magnitude, np.degrees(np.column_stack([phase, -simulated.slopes.imag]))


def thesis_deviation(measured: Complex, simulated: LogResponse, reference: int | None) -> Array:
    """`differences` of magnitudes times 90/20, then of phases, (2 n_f, 1 + n_x). Source: thesis Eq. 2.25."""
    magnitude, phase = differences(measured, simulated, reference)
    return np.concatenate([MAGNITUDE_WEIGHT * magnitude, phase])


def beside_measured(measured: FrequencyResponse, simulated: LogResponse) -> FrequencyResponse:
    """The model's response, its phase shifted by whole turns to be near the measured one."""
    gap = np.unwrap(simulated.values.imag - measured.phase)
    phase = measured.phase + gap - 2 * np.pi * np.round(gap[0] / (2 * np.pi))
    return replace(
        measured, gain=np.exp(simulated.values.real), phase=phase, origin="simulated", mean=None, covariance=None
    )
