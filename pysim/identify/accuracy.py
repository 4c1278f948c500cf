"""Deviations of a model from its measurements, and the criteria for them (thesis Sections 1.3 and 2.7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.frequency_response import THESIS_REFERENCE_HZ, magnitude_db
from pysim.types import BadInput, Criterion, Deviation, FrequencyResponse

Array = NDArray[np.float64]

_TABLE_1_3, _TABLE_1_4 = "thesis Table 1.3", "thesis Table 1.4"
MEAN_MAGNITUDE = Criterion("mean magnitude deviation", "E_M mean", 0.5, "dB", _TABLE_1_3)
MAX_MAGNITUDE = Criterion("maximum magnitude deviation", "E_M max", 2.0, "dB", _TABLE_1_3)
MEAN_PHASE = Criterion("mean phase deviation", "E_P mean", 5.0, "deg", _TABLE_1_3)
MAX_PHASE = Criterion("maximum phase deviation", "E_P max", 35.0, "deg", _TABLE_1_3)
FREQUENCY_CRITERIA = (MEAN_MAGNITUDE, MAX_MAGNITUDE, MEAN_PHASE, MAX_PHASE)

MEAN_TIME = Criterion("mean error", "E_t mean", 2.0, "%", _TABLE_1_4)
MAX_TIME = Criterion("maximum error", "E_t max", 10.0, "%", _TABLE_1_4)
TIME_CRITERIA = (MEAN_TIME, MAX_TIME)


def mean_deviation(difference: Array) -> float:
    """Average absolute deviation, in the unit of `difference` (n,). Source: thesis Eq. 2.27."""
    return float(np.mean(np.abs(difference)))


def max_deviation(difference: Array) -> float:
    """Largest absolute deviation, in the unit of `difference` (n,). Source: thesis Eq. 2.28, with absolute values."""
    return float(np.max(np.abs(difference)))


def response_difference(
    simulated: FrequencyResponse, measured: FrequencyResponse, *, reference_hz: float | None = THESIS_REFERENCE_HZ
) -> tuple[Array, Array]:
    """Simulated minus measured: magnitude in dB (n_f,) and phase in degrees (n_f,).

    Both phases are continuous, but may differ by whole turns; these are subtracted so that the difference at the lowest
    frequency is within half a turn.

    Args:
        reference_hz: frequency at which both magnitudes count as 0 dB; None compares absolute gains.
    Raises:
        BadInput: the frequencies of the two differ, or the reference is not among them.
    """
    if simulated.frequency.shape != measured.frequency.shape or not np.allclose(
        simulated.frequency, measured.frequency, rtol=1e-6
    ):
        raise BadInput(f"compare: {simulated.origin} and {measured.origin} need the same frequencies")
    magnitude = magnitude_db(simulated, reference_hz) - magnitude_db(measured, reference_hz)
    phase = np.degrees(simulated.phase - measured.phase)
    return magnitude, phase - 360 * np.round(phase[0] / 360)


def frequency_deviations(
    simulated: FrequencyResponse, measured: FrequencyResponse, *, reference_hz: float | None = THESIS_REFERENCE_HZ
) -> tuple[Deviation, ...]:
    """The four deviations of thesis Table 1.3, in the order of FREQUENCY_CRITERIA."""
    magnitude, phase = response_difference(simulated, measured, reference_hz=reference_hz)
    values = (mean_deviation(magnitude), max_deviation(magnitude), mean_deviation(phase), max_deviation(phase))
    return tuple(Deviation(criterion, value) for criterion, value in zip(FREQUENCY_CRITERIA, values, strict=True))


def time_deviations(simulated: Array, measured: Array, full_scale: float) -> tuple[Deviation, ...]:
    """The two deviations of thesis Table 1.4 for one signal, of the samples that were measured.

    Args:
        simulated, measured: (n_t,) at the same times, in the same unit; not-a-number where nothing was measured.
        full_scale: value that counts as 100 percent, in that unit.
    """
    percent = 100 * (np.asarray(simulated) - np.asarray(measured))[np.isfinite(measured)] / full_scale
    values = (mean_deviation(percent), max_deviation(percent))
    return tuple(Deviation(criterion, value) for criterion, value in zip(TIME_CRITERIA, values, strict=True))
