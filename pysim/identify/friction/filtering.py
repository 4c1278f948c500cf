"""Zero-phase low-pass filter, and derivatives of noisy samples."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, sampling

Array = NDArray[np.float64]

_UNEVEN = 1e-3  # largest deviation of a sampling interval from their mean, as a share of it


def zero_phase(time: Array, values: Array, cutoff_hz: float, *, order: int = 2) -> Array:
    """Butterworth low-pass, run forward and then backward, so that there is no delay.

    The gain of both passes together is 1/sqrt(2) at `cutoff_hz`: each pass has a cutoff that is higher by the factor
    (sqrt(2) - 1)^(-1 / (2 order)). Before filtering, both ends are extended by their mirror image through the end
    point; within `settling_time` of an end, the result depends on this extension.

    Args:
        time: (n_t,) s, evenly spaced.
        values: (n_t,) or (n_t, n_y).
        cutoff_hz: below half the sampling rate.
        order: order of one pass.
    Raises:
        BadInput: uneven times, too few samples, or a cutoff that the sampling rate does not allow.
    Source: thesis Section 5.5 (a filter used forward and backward in time); the cutoff is not given there.
    """
    from scipy import signal  # half a second to import, and only friction tests need it

    rate = sampling_rate(time)
    single = cutoff_hz * (math.sqrt(2) - 1) ** (-1 / (2 * order))
    if not 0 < single < rate / 2:
        raise BadInput(
            f"zero-phase filter: a cutoff of {cutoff_hz:g} Hz needs samples faster than {2 * single:.4g} Hz, these "
            f"come at {rate:.4g} Hz; lower the cutoff"
        )
    padding = min(math.ceil(2 * settling_time(cutoff_hz) * rate), time.size - 1)
    sections = signal.butter(order, single, fs=rate, output="sos")
    return np.asarray(signal.sosfiltfilt(sections, values, axis=0, padtype="odd", padlen=padding))


def settling_time(cutoff_hz: float) -> float:
    """Time in s over which the ends of a log disturb the filtered values: one and a half periods of the cutoff.

    After that, the effect of a jump at the end has decayed to 3e-4.
    """
    return 1.5 / cutoff_hz


def sampling_rate(time: Array) -> float:
    """Sampling rate in Hz.

    Raises:
        BadInput: fewer than ten samples, or uneven spacing.
    """
    if time.size < 10:
        raise BadInput(f"zero-phase filter: {time.size} samples are too few; give at least ten")
    steps, found = np.diff(time), sampling(time)
    step = found.step
    worst = int(np.argmax(np.abs(steps - step)))
    if abs(steps[worst] - step) > max(_UNEVEN * step, found.digit):
        raise BadInput(
            f"zero-phase filter: {steps[worst]:g} s between samples at {time[worst]:g} s, {step:g} s elsewhere; "
            "log at an even rate, or use the pulses"
        )
    return 1.0 / step


def local_slope(time: Array, values: Array, *, half_width: int = 2, degree: int = 2) -> tuple[Array, Array, Array]:
    """Value and slope of a polynomial fitted to each sample's neighbours (Savitzky-Golay filter, any spacing).

    Near the ends, the nearest full window is used.

    Args:
        time, values: (n,), n at least 2 half_width + 1.
        half_width: number of neighbours on each side.
        degree: degree of the polynomial, below 2 half_width + 1.
    Returns:
        value (n,), slope (n,) per s, and the slope's standard deviation for samples with independent noise of 1, (n,).
    Raises:
        BadInput: too few samples, or a degree that is too large for the window.
    """
    width = 2 * half_width + 1
    if time.size < width or not 1 <= degree < width:
        raise BadInput(f"local slope: degree {degree} and {width} neighbours need more than {time.size} samples")
    first = np.clip(np.arange(time.size) - half_width, 0, time.size - width)
    window = first[:, None] + np.arange(width)
    away = time[window] - time[:, None]
    scale = np.abs(away).max(axis=1, keepdims=True)
    powers = (away / scale)[:, :, None] ** np.arange(degree + 1)
    estimator = np.linalg.pinv(powers)  # (n, degree + 1, width)
    coefficients = np.einsum("nkw,nw->nk", estimator[:, :2], values[window])
    noise = np.linalg.norm(estimator[:, 1], axis=1) / scale[:, 0]
    return coefficients[:, 0], coefficients[:, 1] / scale[:, 0], noise
