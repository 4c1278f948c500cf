"""Gain on the excited lines, and the power of noise and distortion around it, by three methods: over realisations,
over free lines, and over neighbouring lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.lines import Harmonics, Lines
from pysim.identify.multisine.local_fit import apart, local_fit, powers, windows
from pysim.identify.multisine.steady import SteadySpectra
from pysim.types import BadInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


# Smallest number of complex degrees of freedom of a gain's variance. If there are too few realisations, variances of
# neighbouring lines are pooled, since the level of noise and distortion is smoother than the gain.
_ENOUGH = 6


@dataclass(frozen=True)
class LinearPart:
    """The gain on the excited lines.

    Args:
        gain: (n_f,) complex.
        variance: (n_f,) E|error|^2 of the gain.
        variance_degrees: (n_f,) real degrees of freedom of `variance`.
        power: (n_f,) power of noise and distortion in one realisation, in gain unit squared.
        degrees: (n_f,) real degrees of freedom of `power`.
        noise: (n_f,) power of the noise alone, or None.
        noise_weight: (n_f,) factor from `noise` to the noise's part of `variance`.
        shared: number of neighbouring lines whose `power` shares data.
        apart: indices of gains that share no data with each other; None if no two gains share data.
    """

    gain: Complex
    variance: Array
    variance_degrees: Array
    power: Array
    degrees: Array
    noise: Array | None
    noise_weight: Array
    shared: float = 1.0
    apart: tuple[int, ...] | None = None


def over_realisations(spectra: SteadySpectra, lines: Lines) -> LinearPart:
    """The robust method: the mean over M realisations, and their scatter about it.

    With fewer than seven realisations, the gain's variance is averaged over neighbouring lines.

    With a reference r, the gain is the ratio of the responses of output and input to r, G_ry / G_ru, which noise on the
    measured input and feedback do not bias.

    Source: Pintelon and Schoukens, System Identification, 2nd edition, Section 4.3.1, Eq. 4-24 to 4-30 and 3-23.
    """
    m = spectra.values.shape[0]
    if m < 2:
        raise BadInput("robust method: one realisation does not scatter; record two or more, or use another method")
    gain, scaled, noise = _gain(spectra, lines.excited)
    power = np.sum(np.abs(scaled) ** 2, axis=0) / (m - 1)
    width = min(-(-_ENOUGH // (m - 1)) // 2 * 2 + 1, gain.size)
    mean = power[windows(np.arange(gain.size), np.arange(gain.size), width)].mean(axis=1)
    degrees = np.full(gain.size, 2.0 * (m - 1))
    return LinearPart(gain, mean / m, width * degrees, power, degrees, noise, np.full(gain.size, 1.0 / m))


def over_free_lines(spectra: SteadySpectra, lines: Lines, power: Array, degrees: Array) -> LinearPart:
    """The fast method: the power of noise and distortion on excited lines is taken from free odd lines.

    Args:
        power: (n_f,) that power at the excited lines, in gain unit squared; with its `degrees` of freedom.
    Source: as above, Section 4.3.2.
    """
    gain, _, noise = _gain(spectra, lines.excited)
    m = spectra.values.shape[0]
    return LinearPart(gain, power / m, degrees, power, degrees, noise, np.full(gain.size, 1.0 / m))


def over_neighbours(spectra: SteadySpectra, lines: Lines, *, order: int = 2, width: int = 9) -> LinearPart:
    """A polynomial in frequency, fitted to neighbouring excited lines; its residual is noise and distortion.

    One realisation is enough, and every line may be excited, but the gain has to be smooth over a window.

    Args:
        order: degree; the bias is of the order (width / 2)^(order + 1) times the gain's derivative of that order.
        width: number of excited lines in a window; more lines reduce the variance.
    Source: Pintelon, Vandersteen, Schoukens and Rolain, Mechanical Systems and Signal Processing 25 (2011), 2892-2922.
    """
    m, n_f = spectra.values.shape[0], lines.excited.size
    chosen = spectra.values[:, lines.excited - 1]
    has_reference = chosen.shape[2] == 3
    drive = chosen[:, :, 2 if has_reference else 0]
    answers = chosen[:, :, :2] if has_reference else chosen[:, :, 1:2]
    at = windows(np.arange(n_f), np.arange(n_f), width)
    x = powers((lines.excited[at] - lines.excited[:, None]).astype(np.float64), order)  # (n_f, width, order + 1)
    k = np.moveaxis(drive[:, at], 0, 1)[..., None] * x[:, None]  # (n_f, M, width, order + 1)
    right = np.moveaxis(answers[:, at], 0, 1)
    fit = local_fit(k.reshape(n_f, m * width, -1), right.reshape(n_f, m * width, -1))
    gain, residual, to_input = gain_from_responses(fit.coefficients[:, 0], fit.residual)
    inside = np.sum(np.abs(drive[:, at]) ** 2, axis=(0, 2)) / (m * width) * to_input  # mean square of the input's lines
    power, variance = residual / inside, residual * fit.gram[:, 0, 0].real / to_input
    noise = None
    if spectra.noise is not None:
        noise = noise_power(spectra.noise, lines.excited, gain)[at].mean(axis=1) / inside
    degrees = np.full(n_f, 2.0 * fit.degrees)
    return LinearPart(
        gain, variance, degrees, power, degrees, noise, variance / power, float(width), apart(at, np.arange(n_f))
    )


def first_gain(spectra: SteadySpectra, lines: Lines) -> Complex:
    """The gain (n_f,) on the excited lines, as a ratio of mean spectra."""
    return _gain(spectra, lines.excited)[0]


def noise_power(noise: Complex, numbers: Harmonics, gain: Complex) -> Array:
    """(n,) variance of y - G u on these harmonics, in the output's unit squared, from the noise covariance of all."""
    return equation_error(noise[numbers - 1], gain)


def equation_error(covariance: Complex, gain: Complex) -> Array:
    """(n,) variance of y - G u from the covariance (n, >= 2, >= 2) of u, y, ..."""
    weights = np.stack([-gain, np.ones_like(gain)], axis=1)
    return np.asarray(np.einsum("ki,kij,kj->k", weights, covariance[:, :2, :2], np.conj(weights)).real)


def _gain(spectra: SteadySpectra, excited: Harmonics) -> tuple[Complex, Complex, Array | None]:
    """Gain (n_f,), each realisation's deviation from it (M, n_f), and the noise's part of its power (n_f,) or None."""
    chosen = spectra.values[:, excited - 1]
    reference = chosen[:, :, 2] if chosen.shape[2] == 3 else chosen[:, :, 0]
    if np.any(np.abs(reference) == 0):
        raise BadInput("multisine: a line said to be excited has no power; correct the lines")
    u, y = chosen[:, :, 0] / reference, chosen[:, :, 1] / reference
    gain = y.mean(axis=0) / u.mean(axis=0)
    noise = None
    if spectra.noise is not None:
        noise = noise_power(spectra.noise, excited, gain)
        noise = noise * np.mean(1 / np.abs(reference) ** 2, axis=0) / np.abs(u.mean(axis=0)) ** 2
    return gain, (y - gain * u) / u.mean(axis=0), noise


def gain_from_responses(responses: Complex, covariance: Complex) -> tuple[Complex, Array, Array]:
    """Gain, variance of the equation error y - G u, and |G_ru|^2, from responses (n, n_y) of (input,) output."""
    if responses.shape[1] == 1:
        return responses[:, 0], covariance[:, 0, 0].real, np.ones(responses.shape[0])
    gain = responses[:, 1] / responses[:, 0]
    return gain, equation_error(covariance, gain), np.abs(responses[:, 0]) ** 2
