"""One stepped-sine log, reduced to the harmonics of its last whole periods."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.harmonics import harmonic_count, interpolation, regressors, to_complex
from pysim.identify.greybox.settings import SteadySettings
from pysim.identify.greybox.treatment import SinePlan
from pysim.identify.logged import LoggedWave
from pysim.types import BadInput, Record

Array = NDArray[np.float64]

_SETTINGS = SteadySettings()


@dataclass(frozen=True)
class Sine:
    """offset + amplitude sin(2 pi frequency t + phase) from onset to end, s; frequency in Hz."""

    offset: float
    amplitude: float
    frequency: float
    phase: float
    onset: float
    end: float

    def at(self, time: Array) -> Array:
        """Phase (n_t,) in rad."""
        return 2 * np.pi * self.frequency * time + self.phase


def steady_sine(wave: LoggedWave) -> Sine:
    """The sine of a log's command, in the log's time, with a positive amplitude."""
    phase = wave.phase - 2 * np.pi * wave.frequency * wave.start
    if wave.amplitude < 0:
        return Sine(wave.offset, -wave.amplitude, wave.frequency, phase + np.pi, wave.start, wave.end)
    return Sine(wave.offset, wave.amplitude, wave.frequency, phase, wave.start, wave.end)


@dataclass(frozen=True)
class SineLog:
    """The compared samples of one log and their projection onto harmonics.

    Args:
        source: source of the log.
        sine: its command.
        measured: the last whole periods, compared columns only.
        noise: (n_y,) standard deviations, in the columns' units.
        count: number of harmonics.
        points: samples over one period of the model's orbit.
        columns, triangle: Q (n_t, n_h) and R (n_h, n_h) of the QR factorisation of mean and harmonics, as in
            `harmonics.regressors`.
        index: index of the log, as in `RecordFit`.
        middle: middle of the compared periods, s on the common clock of all records; None if not known.
    """

    source: str
    sine: Sine
    measured: Record
    noise: tuple[float, ...]
    count: int
    points: int
    columns: Array = field(repr=False)
    triangle: Array = field(repr=False)
    index: int = field(kw_only=True)
    middle: float | None = None

    @property
    def periods(self) -> int:
        """Number of compared periods."""
        time = self.measured.time
        return round(float(time[-1] - time[0]) * time.size / (time.size - 1) * self.sine.frequency)

    @property
    def phase(self) -> Array:
        """Phase of the command at the samples, (n_t,) rad."""
        return self.sine.at(self.measured.time)

    @cached_property
    def onto(self) -> Array:
        """Matrix (n_h, points) that maps a period of the model's orbit to coefficients of the columns of Q."""
        return np.asarray(self.columns.T @ interpolation(self.phase, self.points))

    @cached_property
    def harmonics(self) -> Array:
        """Measured coefficients of the columns of Q, (n_h, n_y) in the signals' units; uncorrelated for white noise."""
        return np.asarray(self.columns.T @ self.measured.values)

    @cached_property
    def unlike(self) -> float:
        """Difference of the first compared period from the later ones, in standard deviations: the largest one of a
        mean, sine or cosine amplitude; zero if the samples are too few for both.

        A large value means that the log has not settled: a slow valve or a sticking plate may need many periods.
        """
        phase = self.phase
        first = int(np.searchsorted(phase, phase[0] + (1 - 1e-6) * 2 * np.pi))
        if min(first, phase.size - first) < 2 * self.count + 2:
            return 0.0
        parts, back = [], np.linalg.inv(self.triangle)
        for part in (slice(first), slice(first, None)):
            columns, values = self.columns[part], self.measured.values[part]
            spread = np.linalg.inv(columns.T @ columns)
            found = spread @ (columns.T @ values)
            parts.append((back @ found, np.einsum("ij,jk,ik->i", back, spread, back), values - columns @ found))
        (begun, one, _), (rest, other, left) = parts
        noise = np.maximum(np.sqrt(np.mean(left**2, axis=0)), self.noise)  # a transient adds to the first period's
        return float(np.max(np.abs(rest - begun) / (noise * np.sqrt(one + other)[:, None])))

    def coefficients(self, uncorrelated: Array) -> NDArray[np.complex128]:
        """Coefficients (n_h, ...) as in `harmonics` -> mean and complex harmonics (count + 1, ...)."""
        return to_complex(np.asarray(np.linalg.solve(self.triangle, uncorrelated), dtype=np.float64))

    @property
    def variances(self) -> Array:
        """Variances of mean, sine and cosine amplitudes for white noise of variance 1, (n_h,)."""
        return np.asarray(np.sum(np.linalg.inv(self.triangle) ** 2, axis=1))

    @property
    def scatter(self) -> Array:
        """Root mean square of the samples less mean and harmonics, in the signals' units, (n_y,)."""
        rest = self.measured.values - self.columns @ self.harmonics
        return np.asarray(np.sqrt(np.mean(rest**2, axis=0)))

    def deviations(self) -> Array:
        """Standard deviation of mean and harmonic amplitudes for white noise of variance 1, (count + 1,)."""
        variance = self.variances
        return np.sqrt(np.concatenate([variance[:1], 0.5 * (variance[1::2] + variance[2::2])]))

    def fundamental(self) -> Array:
        """Matrix (2, n_h) that maps coefficients as in `harmonics` to sine and cosine amplitude of the fundamental."""
        return np.asarray(np.linalg.inv(self.triangle)[1:3])


def sine_log(source: str, data: Record, sine: Sine, noise: tuple[float, ...], plan: SinePlan, *, index: int) -> SineLog:
    """Cut the last whole periods after settling, and choose how many harmonics are compared.

    Raises:
        BadInput: no whole period is left, or too few samples.
    """
    period = 1 / sine.frequency
    gap = float(np.median(np.diff(data.time))) if data.time.size > 1 else 0.0
    end, begin = min(data.time[-1], sine.end) + gap, max(sine.onset, data.time[0])
    settling = max(plan.settle_time or 0.0, plan.settle_periods * period)
    usable = end - begin - settling
    whole = int(np.floor(usable / period + 0.01))
    if whole < 1:
        raise BadInput(
            f"{source}: {end - begin:.3g} s of a sine of {sine.frequency:g} Hz leave no whole period after "
            f"{settling:.3g} s of settling; record longer, or settle shorter"
        )
    keep = (data.time > end - whole * period - 0.5 * gap) & (data.time < end - 0.5 * gap)
    cut = Record(data.time[keep], data.values[keep], data.names, data.units, origin=data.origin)
    least, most = (harmonic_count(sine.frequency, 1 / gap, n) for n in (plan.harmonics, plan.points // 4))
    if cut.time.size < 2 * least + 2:
        raise BadInput(f"{source}: {cut.time.size} samples in {whole} periods are too few; record faster")
    phase = sine.at(cut.time)
    most = max(least, most) if len(phase) > 3 * most else least  # enough samples remain to estimate the noise
    columns, triangle = np.linalg.qr(regressors(phase, most))
    count = max(least, _seen(cut.values, columns))
    size = 2 * count + 1
    columns, triangle = columns[:, :size].copy(), triangle[:size, :size]
    return SineLog(source, sine, cut, noise, count, plan.points, columns, triangle, index=index)


def _seen(values: Array, columns: Array) -> int:
    """The highest harmonic that is significant in some column of values (n_t, n_y), against the remaining noise; or 0.

    A valve's dead band shows in high harmonics, which would count as noise if they were not compared.

    Args:
        columns: (n_t, n_h) orthonormal columns that span mean and harmonics.
    """
    parts = columns.T @ values
    freedom, most = len(values) - columns.shape[1], columns.shape[1] // 2
    rest = np.maximum(np.sum(values**2, axis=0) - np.sum(parts**2, axis=0), 0.0) / freedom
    pairs = np.sum(parts[1:].reshape(most, 2, -1) ** 2, axis=1)
    found = np.flatnonzero((pairs > -2 * np.log(_SETTINGS.chance) * rest).any(axis=1))
    return int(found[-1]) + 1 if found.size else 0
