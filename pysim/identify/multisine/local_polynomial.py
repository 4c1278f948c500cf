"""The local polynomial method for any broadband signal, periodic or not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.linear_part import gain_from_responses
from pysim.identify.multisine.local_fit import LocalFit, apart, local_fit, powers, windows
from pysim.identify.multisine.periods import checked_columns, refuse_still, sampling_interval
from pysim.identify.multisine.statistics import plain_level
from pysim.types import BadInput, BestLinearApproximation, MultisineTest, Record

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_CHUNK = 4096  # windows solved at once, so that long records fit into memory
_EXCITED = 1e-2  # share of the largest smoothed input amplitude above which a line is in the default band: 40 dB
_NOTHING = 1e-5  # share below which there is only rounding: 100 dB
# Smallest share of the input's amplitude in a window that a polynomial must leave as residual. Below it, gains of the
# pump's chirp and of noisy second-order systems are wrong by 100 percent; above it, by 1 percent.
_ROUGH = 0.3


@dataclass(frozen=True)
class LocalPolynomial:
    """Settings: gain and transient are polynomials over 2 half_width + 1 lines around each line.

    A window has 2 (order + 1) unknowns, so that q = 2 half_width + 1 - 2 (order + 1) complex degrees of freedom remain
    for the noise. A wide window reduces the variance of the gain, but its bias grows as (half_width / d)^(order + 1),
    where d is the duration of the record.

    Args:
        order: degree R; for even degrees, the bias in the middle of a window is smaller by one power.
        half_width: n, in lines.
    Raises:
        BadInput: a window that leaves no degree of freedom.
    """

    order: int = 2
    half_width: int = 6

    def __post_init__(self) -> None:
        if self.order < 0 or self.degrees < 1:
            raise BadInput(
                f"local polynomial: order {self.order} needs a half width of at least {self.order + 1} lines, "
                f"got {self.half_width}"
            )

    @property
    def degrees(self) -> int:
        """Complex degrees of freedom q."""
        return 2 * self.half_width + 1 - 2 * (self.order + 1)


def local_polynomial_approximation(
    record: Record,
    columns: Sequence[str],
    *,
    band: tuple[float, float] | None = None,
    settings: LocalPolynomial | None = None,
) -> BestLinearApproximation:
    """The gain from one record of any length and excitation, free of leakage to the order of the polynomials.

    Y(k + r) = (sum_s g_s r^s) U(k + r) + sum_s t_s r^s + V(k + r) is solved for r = -n ... n around every line k. The
    gain is g_0, and the transients of plant and noise are t_0. Without periods, noise and stochastic distortion cannot
    be separated; `total` is the sum of both.

    Args:
        record: equidistant samples.
        columns: names of input and output. If the input is measured with noise, or depends on the output by feedback,
            also that of a known command; the gain is then the ratio of the responses to the command.
        band: lowest and highest frequency in Hz; None takes lines where the input is within 40 dB of its largest line.
            Lines where the input is too smooth to be separated from a transient are always left out.
        settings: order and width.
    Returns:
        a gain per line of the record's spectrum; estimates up to 2 half_width lines apart share data.
    Raises:
        BadInput: samples that are not equidistant, too few lines in the band, an input that does not excite them, or a
            constant output.
    Source: Pintelon, Schoukens, Vandersteen and Barbé, Estimation of nonparametric noise and FRF models for
    multivariable systems, Part I: theory, Mechanical Systems and Signal Processing 24 (2010), 573-595.
    """
    settings = settings or LocalPolynomial()
    names = tuple(columns)
    spectra = prepare(record, names, band, settings)
    fit = solve(spectra.drive, spectra.answers, spectra.chosen, settings)
    gain, error, to_input = gain_from_responses(fit.coefficients[:, 0], fit.residual)
    variance = error * fit.gram[:, 0, 0].real / to_input
    at = windows(spectra.chosen, np.arange(spectra.drive.size), 2 * settings.half_width + 1)
    amplitude = np.sqrt(np.mean(np.abs(spectra.input[at]) ** 2, axis=1))
    frequency, degrees = (spectra.chosen + 1) / spectra.length, np.full(gain.size, 2.0 * settings.degrees)
    units = tuple(record.units[record.names.index(name)] for name in names)
    rms, offset = float(np.std(record[names[0]])), float(np.mean(record[names[0]]))
    return BestLinearApproximation(
        frequency,
        gain,
        variance,
        degrees,
        None,
        MultisineTest(names[0], names[1], units[0], units[1], offset, rms, spectra.length, 1, 1),
        f"local polynomial: order {settings.order} over {2 * settings.half_width + 1} lines",
        record.origin,
        amplitude,
        float(np.mean(record[names[1]])),
        float(error[0]) / 4,  # the line at 0 has twice the mean as amplitude; its power is that of the lowest line
        plain_level(frequency, error / amplitude**2, degrees),
        apart=apart(at, spectra.chosen),
    )


@dataclass(frozen=True)
class WholeSpectra:
    """Spectrum of a whole record of a length in s, from line 1 on: reference or input that drives the plant (n_l,), the
    input (n_l,), the responses (n_l, n_y), and the indices of the lines to estimate."""

    drive: Complex
    input: Complex
    answers: Complex
    chosen: NDArray[np.intp]
    length: float


def prepare(
    record: Record, columns: Sequence[str], band: tuple[float, float] | None, settings: LocalPolynomial
) -> WholeSpectra:
    """Spectra of the columns and the band; arguments as `local_polynomial_approximation`."""
    names = checked_columns(columns)
    length = record.time.size * sampling_interval(record)
    lines = _spectra(np.column_stack([record[name] for name in names]))
    drive = lines[:, 2 if len(names) == 3 else 0]
    frequency = np.arange(1, lines.shape[0] + 1) / length
    chosen = _band(drive, frequency, band, settings)
    refuse_still(record[names[1]], names[1])
    return WholeSpectra(drive, lines[:, 0], lines[:, :2] if len(names) == 3 else lines[:, 1:2], chosen, length)


def _spectra(values: Array) -> Complex:
    """Complex amplitudes (n_l, n_s) of the lines above zero and below the Nyquist frequency."""
    n = values.shape[0]
    spectrum = np.fft.rfft(values - values.mean(axis=0), axis=0) * (2 / n)
    return np.asarray(spectrum[1 : (n - 1) // 2 + 1], dtype=np.complex128)


def solve(drive: Complex, answers: Complex, chosen: NDArray[np.intp], settings: LocalPolynomial) -> LocalFit:
    """Fit the windows around the chosen lines, a few thousand at a time."""
    positions = np.arange(drive.size)
    parts = []
    for first in range(0, chosen.size, _CHUNK):
        centres = chosen[first : first + _CHUNK]
        at = windows(centres, positions, 2 * settings.half_width + 1)
        x = powers((positions[at] - centres[:, None]).astype(np.float64), settings.order)
        regressors = np.concatenate([x * drive[at][..., None], x], axis=2)
        parts.append(local_fit(regressors, answers[at]))
    return LocalFit(
        np.concatenate([part.coefficients for part in parts]),
        np.concatenate([part.gram for part in parts]),
        np.concatenate([part.residual for part in parts]),
        parts[0].degrees,
    )


def _band(
    drive: Complex, frequency: Array, band: tuple[float, float] | None, settings: LocalPolynomial
) -> NDArray[np.intp]:
    """Indices of the lines to estimate."""
    width = 2 * settings.half_width + 1
    if drive.size < width:
        raise BadInput(f"local polynomial: {drive.size} lines do not fill a window of {width}; record longer")
    smooth = np.sqrt(np.convolve(np.abs(drive) ** 2, np.full(width, 1 / width), mode="same"))
    if not smooth.max() > 0:
        raise BadInput("local polynomial: the input stands still; name the column that was excited")
    lowest, highest = band or (0.0, float("inf"))
    inside = (frequency >= lowest * (1 - 1e-9)) & (frequency <= highest * (1 + 1e-9))
    if not inside.any():
        raise BadInput(
            f"local polynomial: no lines from {lowest:g} to {highest:g} Hz, the record has them from {frequency[0]:g} "
            f"to {frequency[-1]:g} Hz; give the lower end first, or record longer"
        )
    excited = smooth >= (_EXCITED if band is None else _NOTHING) * smooth.max()
    chosen = np.flatnonzero(inside & excited & _is_rough(drive, settings))
    if chosen.size == 0:
        raise BadInput(
            "local polynomial: the input has no power in the band, or is as smooth there as a transient; narrow the "
            "band to what it excites"
        )
    return np.asarray(chosen, dtype=np.intp)


def _is_rough(drive: Complex, settings: LocalPolynomial) -> NDArray[np.bool_]:
    """(n_l,) whether a polynomial leaves a large enough residual of the input in the window around each line."""
    width = 2 * settings.half_width + 1
    distance = np.arange(width, dtype=np.float64) - settings.half_width
    basis, _ = np.linalg.qr(powers(distance[None], settings.order)[0].real)
    rows = np.lib.stride_tricks.sliding_window_view(drive, width)
    whole = np.sum(np.abs(rows) ** 2, axis=1)
    smooth = np.sum(np.abs(rows @ basis) ** 2, axis=1)
    rough = whole - smooth > _ROUGH**2 * whole
    first = np.clip(np.arange(drive.size) - settings.half_width, 0, rough.size - 1)
    return np.asarray(rough[first])
