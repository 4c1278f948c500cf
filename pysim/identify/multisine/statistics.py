"""Intervals of variances and of their differences, and a test of distortion against noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtri, digamma, fdtrc, fdtri, ndtr, polygamma, stdtrit

from pysim.types import BestLinearApproximation, Distortion, Level

Array = NDArray[np.float64]

CONFIDENCE = 0.95


def variance_interval(variance: Array, degrees: Array, confidence: float = CONFIDENCE) -> tuple[Array, Array]:
    """Ends (n,) of the interval of variances (n,) estimated with `degrees` (n,) real degrees of freedom."""
    tail = (1 - confidence) / 2
    return variance * degrees / chdtri(degrees, tail), variance * degrees / chdtri(degrees, 1 - tail)


def difference_interval(
    first: Array, first_degrees: Array, second: Array, second_degrees: Array, confidence: float = CONFIDENCE
) -> tuple[Array, Array]:
    """Ends (n,) of the interval of the difference of two independently estimated variances.

    The lower end is above zero exactly if the F test of equal variances is significant.

    Source: Ting, Burdick, Graybill, Jeyaratnam and Lu, Confidence intervals on linear combinations of variance
    components that are unrestricted in sign, Journal of Statistical Computation and Simulation 35 (1990), 135-143.
    """
    tail = (1 - confidence) / 2
    difference = first - second
    f = fdtri(first_degrees, second_degrees, 1 - tail)
    g1, h2 = 1 - first_degrees / chdtri(first_degrees, tail), _excess(second_degrees, tail)
    g12 = ((f - 1) ** 2 - (g1 * f) ** 2 - h2**2) / f
    below = (g1 * first) ** 2 + (h2 * second) ** 2 + g12 * first * second
    f = fdtri(first_degrees, second_degrees, tail)
    h1, g2 = _excess(first_degrees, tail), 1 - second_degrees / chdtri(second_degrees, tail)
    h12 = ((1 - f) ** 2 - (h1 * f) ** 2 - g2**2) / f
    above = (h1 * first) ** 2 + (g2 * second) ** 2 + h12 * first * second
    return difference - np.sqrt(np.maximum(below, 0.0)), difference + np.sqrt(np.maximum(above, 0.0))


def _excess(degrees: Array, tail: float) -> Array:
    return np.asarray(degrees / chdtri(degrees, 1 - tail) - 1)


def plain_level(frequency: Array, variance: Array, degrees: Array) -> Level:
    """A level with the interval of its variance."""
    return Level(frequency, variance, *variance_interval(variance, degrees))


def distortion_level(
    frequency: Array,
    power: Array,
    degrees: Array,
    noise: Array,
    noise_degrees: Array,
    *,
    shared: float = 1.0,
    noise_shared: float = 1.0,
) -> Distortion:
    """Distortion: power (n,) on lines less the noise (n,) there, both in gain unit squared, with its interval."""
    low, high = difference_interval(power, degrees, noise, noise_degrees)
    return Distortion(frequency, power - noise, low, high, power, noise, degrees, noise_degrees, shared, noise_shared)


def pooled(distortion: Distortion, frequency: Array, count: int) -> Distortion:
    """The distortion at other frequencies (n,) in Hz, as the mean over the `count` lines nearest to each.

    A single line gives a variance to within a factor of 40 (one realisation, 95 percent); a mean over six, within 5.
    Lines that share data count as one, so a mean over such lines has the degrees of freedom of one line.
    """
    lines = distortion.frequency
    count = min(count, lines.size)
    first = np.clip(np.searchsorted(lines, frequency) - count // 2, 0, lines.size - count)
    at = first[:, None] + np.arange(count)
    step = np.median(np.diff(frequency)) / np.median(np.diff(lines)) if min(lines.size, frequency.size) > 1 else 1.0
    return distortion_level(
        frequency,
        distortion.power[at].mean(axis=1),
        distortion.degrees[at].mean(axis=1) * max(1.0, count / distortion.shared),
        distortion.noise[at].mean(axis=1),
        distortion.noise_degrees[at].mean(axis=1) * max(1.0, count / distortion.noise_shared),
        shared=max(1.0, (count + distortion.shared - 1) / float(step)),
        noise_shared=max(1.0, (count + distortion.noise_shared - 1) / float(step)),
    )


def added(first: Level, second: Level) -> Level:
    """The sum of two independent levels at the same frequencies.

    Source: the method of variance estimates recovery of Zou and Donner, Statistics in Medicine 27 (2008), 1693-1702.
    """
    total = first.variance + second.variance
    below = np.hypot(first.variance - first.low, second.variance - second.low)
    above = np.hypot(first.high - first.variance, second.high - second.variance)
    return Level(first.frequency, total, total - below, total + above)


def distortion_p_value(distortion: Distortion) -> float:
    """p-value of the ratios of power to noise for a linear system; small if there is distortion.

    It combines two tests: of the mean of the ratios' logarithms, whose distribution is known, and of the largest ratio
    (Bonferroni over the lines). The p-value is twice the smaller one, at most twice too large.
    """
    ratio, first, second = distortion.ratio, distortion.degrees, distortion.noise_degrees
    n = ratio.size
    if np.isinf(ratio).any():
        return 0.0
    single = n * float(np.min(fdtrc(first, second, np.maximum(ratio, 0.0))))
    if np.any(ratio <= 0):
        return min(1.0, 2 * single)
    a, b = first / 2, second / 2
    expected = digamma(a) - np.log(a) - digamma(b) + np.log(b)
    spread = distortion.shared * polygamma(1, a) + distortion.noise_shared * polygamma(1, b)
    whole = float(ndtr(-np.sum(np.log(ratio) - expected) / np.sqrt(np.sum(spread))))
    return min(1.0, 2 * min(whole, single))


def gain_interval(bla: BestLinearApproximation, confidence: float = CONFIDENCE) -> tuple[Array, Array]:
    """Half widths (n_f,) of the intervals of |G| (its unit) and of its phase (rad), to first order in the error.

    By Student's t distribution, since the variance is estimated too.
    """
    half = stdtrit(bla.degrees, (1 + confidence) / 2) * np.sqrt(bla.variance / 2)
    return half, half / np.abs(bla.gain)


def gain_radius(bla: BestLinearApproximation, confidence: float = CONFIDENCE) -> Array:
    """Radii (n_f,) of the circles in the complex plane that contain the true gain with this probability.

    Source: |error|^2 / variance is F distributed with 2 and `degrees` degrees of freedom.
    """
    return np.asarray(np.sqrt(bla.variance * fdtri(2, bla.degrees, confidence)))
