"""Makes a best linear approximation from gain and spectra, with levels of noise and distortion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.levels import on_free_lines
from pysim.identify.multisine.linear_part import LinearPart
from pysim.identify.multisine.lines import Lines
from pysim.identify.multisine.statistics import added, distortion_level, plain_level, pooled
from pysim.identify.multisine.steady import SteadySpectra
from pysim.types import BestLinearApproximation, Distortion, Level, MultisineTest

Array = NDArray[np.float64]

# Number of free lines whose mean power is taken as the distortion around an excited line.
POOLED_LINES = 6
# An offset below this share of the signal's root mean square is rounding and counts as zero.
_ROUNDING = 1e-12


def assemble(
    spectra: SteadySpectra, lines: Lines, part: LinearPart, method: str, on_lines: Distortion | None = None
) -> BestLinearApproximation:
    """The best linear approximation for a known gain; `on_lines` replaces the distortion that the gain's part has."""
    frequency, amplitude, p = hertz(spectra, lines), amplitude_of(spectra, lines), spectra.periods
    noise = even = odd = distortion = None
    if part.noise is not None:
        shared = max(1.0, spectra.span / float(np.median(np.diff(lines.excited))))
        per_line = 2 * spectra.degrees[lines.excited - 1]
        noise_degrees = per_line * max(1.0, part.shared / shared)
        noise = plain_level(frequency, part.noise, noise_degrees)
        on_lines = on_lines or distortion_level(
            frequency,
            part.power,
            part.degrees,
            part.noise,
            noise_degrees,
            shared=part.shared,
            noise_shared=part.shared + shared - 1,
        )
        if lines.are_odd:  # otherwise even and odd powers are on the same lines
            even = on_free_lines(spectra, lines, lines.even, part.gain, amplitude)
            odd = on_free_lines(spectra, lines, lines.odd, part.gain, amplitude) or on_lines
        distortion = on_lines if even is None else _sum(on_lines, even)
    mean, mean_variance = _mean(spectra)
    return BestLinearApproximation(
        frequency,
        part.gain,
        part.variance,
        part.variance_degrees,
        None if part.noise is None else part.noise * part.noise_weight,
        _test(spectra),
        method,
        p.origin,
        amplitude,
        mean,
        mean_variance,
        plain_level(frequency, part.power, part.degrees),
        noise,
        on_lines,
        even,
        odd,
        distortion,
        part.apart,
    )


def _sum(on_lines: Distortion, even: Distortion) -> Level:
    """The sum of distortion on the excited lines and of even distortion nearby."""
    return added(on_lines, pooled(even, on_lines.frequency, POOLED_LINES))


def amplitude_of(spectra: SteadySpectra, lines: Lines) -> Array:
    """Root mean square over the realisations of the input's amplitudes on the excited lines, (n_f,)."""
    return np.asarray(np.sqrt(np.mean(np.abs(spectra.values[:, lines.excited - 1, 0]) ** 2, axis=0)))


def hertz(spectra: SteadySpectra, lines: Lines) -> Array:
    """Frequencies of the excited lines, (n_f,) Hz."""
    return lines.excited / spectra.periods.period


def _mean(spectra: SteadySpectra) -> tuple[float, float]:
    """The output's mean and its variance: over realisations, or over periods if there is only one realisation."""
    means = spectra.means[:, :, 1]
    samples = means.mean(axis=1) if means.shape[0] > 1 else means[0]
    variance = float(np.var(samples, ddof=1) / samples.size) if samples.size > 1 else float("nan")
    return float(means.mean()), variance


def _test(spectra: SteadySpectra) -> MultisineTest:
    p = spectra.periods
    m, count = p.values.shape[:2]
    rms = float(np.sqrt(np.mean(np.sum(np.abs(spectra.values[:, :, 0]) ** 2, axis=1)) / 2))
    offset = float(spectra.means[:, :, 0].mean())
    offset = 0.0 if abs(offset) < _ROUNDING * rms else offset
    return MultisineTest(p.names[0], p.names[1], p.units[0], p.units[1], offset, rms, p.period, m, count)
