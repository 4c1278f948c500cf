"""Distortion on free lines, which are not excited."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.linear_part import noise_power
from pysim.identify.multisine.lines import Harmonics, Lines
from pysim.identify.multisine.local_fit import local_fit, powers, windows
from pysim.identify.multisine.statistics import distortion_level
from pysim.identify.multisine.steady import SteadySpectra
from pysim.types import Distortion

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def on_free_lines(
    spectra: SteadySpectra, lines: Lines, numbers: Harmonics, gain: Complex, amplitude: Array
) -> Distortion | None:
    """Power of y - G u on free lines, less the noise there; None for fewer than two lines or without noise estimate.

    Args:
        numbers: (n,) harmonic numbers of the free lines.
        gain, amplitude: (n_f,) of the excited lines.
    Source: Pintelon and Schoukens, System Identification, 2nd edition, Section 4.3.2: the response to the actuator's
    own power on these lines is subtracted.
    """
    if numbers.size < 2 or spectra.noise is None:
        return None
    m, position = spectra.values.shape[0], numbers.astype(np.float64)
    at_lines = interpolated(gain, lines.excited, numbers)
    height = np.interp(position, lines.excited, amplitude)
    u, y = spectra.values[:, numbers - 1, 0], spectra.values[:, numbers - 1, 1]
    power = np.mean(np.abs(y - at_lines * u) ** 2, axis=0) / height**2
    noise = noise_power(spectra.noise, numbers, at_lines) / height**2
    shared = max(1.0, spectra.span / float(np.median(np.diff(numbers))))
    return distortion_level(
        numbers / spectra.periods.period,
        power,
        np.full(numbers.size, 2.0 * m),
        noise,
        2 * spectra.degrees[numbers - 1],
        noise_shared=shared,
    )


def interpolated(gain: Complex, excited: Harmonics, numbers: Harmonics) -> Complex:
    """The gain (n,) at harmonic numbers (n,), from a least-squares parabola through the six nearest excited lines."""
    width = min(6, excited.size)
    order = min(2, width - 2)
    if order < 0:
        return np.full(numbers.size, gain.mean())
    at = windows(numbers, excited, width)
    fit = local_fit(powers((excited[at] - numbers[:, None]).astype(np.float64), order), gain[at][..., None])
    return fit.coefficients[:, 0, 0]
