"""One log of a stepped sine: gain and phase relative to the logged command, their covariance, and the harmonics."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtrc, fdtrc

from pysim.identify.frf.harmonic_fit import HarmonicFit, harmonic_fit, told_apart
from pysim.identify.frf.noise import COLOURED, DECLARED, ResidualNoise, residual_noise
from pysim.identify.logged import LoggedWave, logged_wave
from pysim.identify.sine_fit import to_polar
from pysim.types import BadInput, MeasuredRecord, Record, sampling
from pysim.types.note import Note, NoteCode

Array = NDArray[np.float64]

_HARMONICS = 10  # largest number of harmonics; they are also below half the sampling rate
_UNLIKELY = 1e-3  # p-value below which a drift through the log, or harmonics, are significant


@dataclass(frozen=True)
class Window:
    """Which part of a log is fitted: the last whole periods after the transients.

    Args:
        settle_periods: smallest number of periods that are left out at the start of the sine, or of the log.
        settle_time: shortest time in s that is left out there.
    Raises:
        BadInput: a number that is negative or not finite.
    Source: the defaults are those of `SteppedSine`, whose settling times follow from the pump's transients.
    """

    settle_periods: float = 1.0
    settle_time: float = 0.5

    def __post_init__(self) -> None:
        for name, value in (("settle_periods", self.settle_periods), ("settle_time", self.settle_time)):
            if not 0 <= value < math.inf:
                raise BadInput(f"frequency response: {name} is {value:g}; it must be finite and not negative")


@dataclass(frozen=True)
class SinePoint:
    """The response at one frequency, from one log.

    Args:
        source: source of the record.
        frequency: Hz.
        command: the sine of the logged command.
        gain: output amplitude over command amplitude, output unit per input unit.
        phase: rad in (-pi, pi], of the output relative to the command.
        mean: mean of the output, in its unit.
        covariance: (3, 3) of gain, phase and mean.
        harmonics: (n_h,) amplitudes of the output at 2, 3, ... times the frequency, over that at the frequency.
        harmonics_noise: standard deviation of these that noise alone would cause; for coloured noise, the root mean
            square over all harmonics.
        distorted: whether the harmonics are significant, so that the response is not linear.
        noise: noise of the output.
        periods: whole periods that were fitted.
        notes: reasons why the numbers may be wrong.
    """

    source: str
    frequency: float
    command: LoggedWave
    gain: float
    phase: float
    mean: float
    covariance: Array
    harmonics: Array
    harmonics_noise: float
    distorted: bool
    noise: ResidualNoise
    periods: int
    notes: tuple[Note, ...]

    @property
    def distortion(self) -> float:
        """Total harmonic distortion: the root of the sum of squares of `harmonics`."""
        return float(np.linalg.norm(self.harmonics))


def sine_point(
    record: MeasuredRecord, input_: str, output: str, *, window: Window | None = None, noise: float | None = None
) -> SinePoint:
    """Fit the command's sine and, over whole periods, the output's sine with its harmonics.

    Harmonics are fitted together with the sine, so that the residual is noise; over whole periods they do not change
    the sine itself.

    Args:
        record: a stepped sine, with its frequency; a log over time.
        input_, output: names of the columns.
        window: which periods are fitted.
        noise: standard deviation of the output's noise, in its unit; None if not specified.
    Raises:
        BadInput: a command that is not the record's sine, an output that does not move, or less than one whole period.
    Source: thesis Eq. 2.4-2.13. Differs: amplitude and phase are relative to the fitted command, not the nominal one;
    harmonics are part of the fit.
    """
    command = logged_wave(record, input_)
    assert isinstance(record.data, Record)  # logged_wave has refused anything else
    frequency = float(command.frequency)
    part = _fitted_part(record, command, window or Window())
    notes = list(part.notes)
    t, y = record.data.time[part.inside], record.data[output][part.inside]
    angle = command.angle(t)
    count = _harmonic_count(t, frequency, part)
    if count < 1:
        raise BadInput(
            f"{record.source}: the {t.size} samples of {part.periods} period{'s' if part.periods > 1 else ''} behind "
            f"the settling do not show {frequency:g} Hz; shorten the settling, record longer or sample faster"
        )
    if part.holes:
        count, told = _told_apart(record.source, angle, count, frequency, part.holes)
        notes += told
    interval = part.step if part.holes else float(t[-1] - t[0]) / (t.size - 1)
    lost = bool(part.holes)
    fit = harmonic_fit(angle, y, count, lost=lost)
    coefficients = fit.coefficients
    judged = residual_noise(fit.left_over, fit.columns, frequency, interval, declared=noise, harmonics=count - 1)
    hidden = judged.basis == COLOURED and part.periods == 1
    if hidden:
        judged = judged.at_least(fit.level_of_harmonics())
    amplitude = float(np.hypot(*coefficients[:2]))
    if amplitude <= 1e-12 * float(np.max(np.abs(y))):
        raise BadInput(f"{record.source}: {output} does not move at {frequency:g} Hz; there is no response")
    gain = amplitude / command.amplitude
    sizes = np.hypot(coefficients[0:-1:2], coefficients[1::2])
    noisy = np.full(count - 1, judged.at_frequency) if hidden else np.array(judged.at_harmonics)
    deviation = np.repeat(noisy if count > 1 else [judged.at_frequency], 2)  # of sine and cosine
    unit = np.diag(fit.inverse)[2 if count > 1 else 0 : -1]
    spread = math.sqrt(float(np.mean(deviation**2 * unit)))
    # Coloured noise at the harmonics is estimated only from the spectral lines between them, two numbers each.
    between = 2 * (count - 1) * (part.periods - 1)
    known = between if judged.basis == COLOURED and between else fit.freedom
    distorted = count > 1 and _by_chance(fit, slice(2, -1), deviation, judged.basis, known) < _UNLIKELY
    if part.periods > 1:
        notes += _unsteady(harmonic_fit(angle, y, count, lost=lost, drifting=True), y, frequency, interval, noise)
    if judged.basis == COLOURED:
        notes.append(Note(NoteCode.MEMORY_IN_HARMONICS if hidden else NoteCode.MEMORY, {}))
    return SinePoint(
        source=record.source,
        frequency=frequency,
        command=command,
        gain=gain,
        phase=float(np.arctan2(coefficients[1], coefficients[0])),
        mean=float(coefficients[-1]),
        covariance=_covariance(command, fit, judged),
        harmonics=sizes[1:] / amplitude,
        harmonics_noise=spread / amplitude,
        distorted=distorted,
        noise=judged,
        periods=part.periods,
        notes=tuple(notes),
    )


@dataclass(frozen=True)
class _Part:
    """The part of a log that is fitted.

    Args:
        inside: samples of the last whole periods.
        periods: number of periods.
        step: s between samples.
        holes: (from, to) in s, where samples are missing.
        notes: notes on the choice of the part.
    """

    inside: slice
    periods: int
    step: float
    holes: tuple[tuple[float, float], ...]
    notes: tuple[Note, ...]


def _fitted_part(record: MeasuredRecord, command: LoggedWave, window: Window) -> _Part:
    assert isinstance(record.data, Record)
    t, period = record.data.time, 1 / command.frequency
    found = sampling(t)
    dt = found.step
    available = (command.end - command.start + dt) / period + 1e-6
    settled = available - max(window.settle_periods, window.settle_time / period)
    if available < 1:
        raise BadInput(
            f"{record.source}: holds {available:.2g} periods of {command.frequency:g} Hz; record at least one behind "
            "the transients"
        )
    periods = max(int(settled), 1)
    notes: tuple[Note, ...] = ()
    if settled < 1:
        notes = (Note(NoteCode.TRANSIENTS, {"seconds": command.end - period - command.start}),)
    first = command.end - periods * period
    begin, end = (int(np.searchsorted(t, at + 0.5 * dt)) for at in (first, command.end))
    gaps = found.gaps[(found.gaps >= begin - 1) & (found.gaps < end - 1)]
    holes = tuple((max(float(t[k]), first), float(t[k + 1])) for k in gaps)
    return _Part(slice(begin, end), periods, dt, holes, notes)


def _harmonic_count(t: Array, frequency: float, part: _Part) -> int:
    """Number of sine and harmonics that sampling rate and number of samples allow; 0 if not even the sine."""
    if t.size < 2:
        return 0
    highest = 0.49 / part.step if part.holes else 0.49 * (t.size - 1) / float(t[-1] - t[0])
    return max(min(int(highest / frequency), 1 + _HARMONICS, (t.size - 12) // 2), 0)


def _told_apart(
    source: str, angle: Array, count: int, frequency: float, holes: tuple[tuple[float, float], ...]
) -> tuple[int, list[Note]]:
    """Number of sine and harmonics that are fitted if samples are missing, and notes on harmonics that are not.

    Harmonics that the samples cannot distinguish would make the fitted sine very uncertain.
    """
    few = told_apart(angle, count)
    begin, end = max(holes, key=lambda hole: hole[1] - hole[0])
    if few < 1:
        raise BadInput(
            f"{source}: no samples from {begin:.4g} to {end:.4g} s, and the others do not show {frequency:g} Hz; "
            "record it again, or more periods of it"
        )
    if few == count:
        return few, []
    lost = {"begin": begin, "end": end}
    if few == 1:
        return few, [Note(NoteCode.NO_HARMONICS, lost)]
    return few, [Note(NoteCode.FEW_HARMONICS, {**lost, "kept": few - 1, "count": count - 1})]


def _by_chance(fit: HarmonicFit, part: slice, deviation: Array, basis: str, freedom: int) -> float:
    """p-value of coefficients: the probability that noise alone makes them as large as they are, or larger.

    Args:
        part: the n_c coefficients.
        deviation: (n_c,) standard deviations of white noise that disturbs each coefficient as much.
        basis: basis of the noise; unless DECLARED, it is estimated from the residual, and this is an F test.
        freedom: degrees of freedom of that estimate.
    """
    chosen = fit.coefficients[part]
    if not deviation.all():
        return float(not chosen.any())
    relative = chosen / deviation
    power = float(relative @ np.linalg.solve(fit.inverse[part, part], relative))
    if basis == DECLARED:
        return float(chdtrc(chosen.size, power))
    return float(fdtrc(chosen.size, min(freedom, fit.freedom), power / chosen.size))


def _covariance(command: LoggedWave, fit: HarmonicFit, noise: ResidualNoise) -> Array:
    """Covariance of gain, phase and mean, to first order, from the noise of output and logged command."""
    sine, cosine = fit.coefficients[:2]
    amplitude = float(np.hypot(sine, cosine))
    scale = np.array([noise.at_frequency, noise.at_frequency, noise.at_zero])
    linear = scale[:, None] * fit.inverse[np.ix_([0, 1, -1], [0, 1, -1])] * scale
    polar = to_polar(linear, amplitude, float(np.arctan2(cosine, sine)))
    by = np.array([1 / command.amplitude, 1.0, 1.0])
    relative = amplitude / command.amplitude**2
    of_command = np.diag([relative**2 * command.covariance[0, 0], command.covariance[1, 1], 0.0])
    return np.asarray(by[:, None] * polar * by + of_command)


def _unsteady(drifting: HarmonicFit, y: Array, frequency: float, interval: float, declared: float | None) -> list[Note]:
    """A note if amplitude or phase drift significantly through the fitted part."""
    noise = residual_noise(drifting.left_over, drifting.columns, frequency, interval, declared=declared)
    change = 2 * float(np.hypot(*drifting.coefficients[-2:]))
    deviation = np.full(2, noise.at_frequency)
    chance = _by_chance(drifting, slice(-2, None), deviation, noise.basis, drifting.freedom)
    if change <= 1e-9 * np.max(np.abs(y)) or chance > _UNLIKELY:
        return []
    share = change / float(np.hypot(*drifting.coefficients[:2]))
    return [Note(NoteCode.DRIFTING, {"percent": 100 * share})]
