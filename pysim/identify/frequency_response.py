"""Magnitude and phase over frequency from the records of a stepped-sine test (thesis Section 2.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.identify.sine_fit import sine_fit
from pysim.types import BadInput, FrequencyResponse, Record, SineTest

Array = NDArray[np.float64]

THESIS_REFERENCE_HZ = 0.1  # the frequency whose amplitude counts as 0 dB, Eq. 2.12


def frequency_response(
    records: Sequence[Record],
    frequencies: Sequence[float],
    test: SineTest,
    *,
    onset: float,
    noise: float | None = None,
) -> FrequencyResponse:
    """Fit the sine of each record, and make a frequency response of the fits.

    Args:
        records: one per frequency, with the output in steady state.
        frequencies: (n_f) Hz, increasing, one per record.
        test: the commanded sines; the test's output is a column of every record.
        onset: time in s when the sine started with phase zero.
        noise: standard deviation of the output's samples, in its unit; None estimates it from the residuals.
    Returns:
        gain = fitted amplitude / commanded amplitude; the phase relative to the command, unwrapped from the lowest
        frequency upwards, which assumes less than half a turn between neighbouring frequencies.
    Raises:
        BadInput: a record whose sine cannot be fitted or has no amplitude, or numbers that do not match.
    Source: thesis Eq. 2.11-2.13. Differs: the gain is absolute; `magnitude_db` makes it relative to 0.1 Hz.
    """
    if len(records) != len(frequencies):
        raise BadInput(f"frequency response: {len(records)} records for {len(frequencies)} frequencies")
    fits = [
        sine_fit(record.time, record[test.output], f, origin=onset, noise=noise)
        for record, f in zip(records, frequencies, strict=True)
    ]
    for f, fit in zip(frequencies, fits, strict=True):
        if fit.amplitude == 0.0:
            raise BadInput(f"frequency response: {test.output} does not move at {f:g} Hz; there is nothing to compare")
    return FrequencyResponse(
        frequency=np.asarray(frequencies, dtype=np.float64),
        gain=np.array([fit.amplitude for fit in fits]) / test.amplitude,
        phase=np.unwrap([fit.phase for fit in fits]),
        test=test,
        origin=records[0].origin if records else "",
        mean=np.array([fit.offset for fit in fits]),
        covariance=np.array([fit.covariance for fit in fits]),
    )


def magnitude_db(response: FrequencyResponse, reference_hz: float | None = THESIS_REFERENCE_HZ) -> Array:
    """Magnitude in dB, (n_f,): relative to the gain at `reference_hz`, or absolute for None.

    Raises:
        BadInput: the response was not taken at the reference frequency.
    Source: thesis Eq. 2.12.
    """
    magnitude = 20 * np.log10(response.gain)
    return magnitude if reference_hz is None else magnitude - magnitude[_reference(response, reference_hz)]


def standard_deviations(
    response: FrequencyResponse, reference_hz: float | None = THESIS_REFERENCE_HZ
) -> tuple[Array, Array]:
    """Standard deviations of `magnitude_db` in dB and of the phase in degrees, (n_f,) each, to first order.

    For relative magnitudes, the reference's variance adds to that of every other point, and its own is zero.

    Raises:
        BadInput: the response has no covariance, or was not taken at the reference frequency.
    """
    if response.covariance is None:
        raise BadInput(
            f"{response.origin}, {response.test.label}: its doubt is not known; measure it, or fit it to logs"
        )
    relative = response.covariance[:, 0, 0] / (response.gain * response.test.amplitude) ** 2
    phase = np.degrees(np.sqrt(response.covariance[:, 1, 1]))
    if reference_hz is not None:
        at = _reference(response, reference_hz)
        relative = np.where(np.arange(relative.size) == at, 0.0, relative + relative[at])
    return 20 / np.log(10) * np.sqrt(relative), phase


def _reference(response: FrequencyResponse, reference_hz: float) -> int:
    """Index of the reference frequency."""
    at = np.flatnonzero(np.isclose(response.frequency, reference_hz, rtol=1e-6))
    if at.size == 0:
        raise BadInput(
            f"{response.origin}, {response.test.label}: magnitudes relative to {reference_hz:g} Hz need that "
            f"frequency; measured are {response.frequency[0]:g} to {response.frequency[-1]:g} Hz: take one of these, "
            "or none for absolute gains"
        )
    return int(at[0])
