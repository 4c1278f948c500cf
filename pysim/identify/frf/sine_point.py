"""One log of a stepped sine: gain and phase against the command as it was logged, their doubt, and the harmonics."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pysim.identify._near_orthogonal import near_orthogonal_fit
from pysim.identify.frf.noise import COLOURED, ResidualNoise, residual_noise
from pysim.identify.logged import LoggedWave, logged_wave
from pysim.types import BadInput, MeasuredRecord, Record

Array = NDArray[np.float64]

_HARMONICS = 10  # at most; those up to just below half the sampling rate
_UNLIKELY = 1e-3  # probability below which halves of a log are said to differ, and harmonics to be there


@dataclass(frozen=True)
class Window:
    """Which part of a log is fitted: the last whole periods, but for what is left for transients to die.

    Args:
        settle_periods: periods left out after the sine starts, or the log does, at least.
        settle_time: s left out there, at least.
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
    """What one log says.

    Args:
        source: the record's.
        frequency: Hz.
        command: the wave as it was logged.
        gain: output amplitude by command amplitude, output unit per input unit.
        phase: rad in (-pi, pi], of the output against the command.
        mean: of the output, in its unit.
        covariance: (3, 3) of gain, phase and mean.
        harmonics: (n_h,) amplitudes of the output at 2, 3, ... times the frequency, by that at the frequency.
        harmonics_noise: standard deviation of each of them that noise alone would give.
        distorted: whether there are harmonics beyond what noise gives: the response is not linear.
        noise: of the output.
        periods: whole periods that were fitted.
        remarks: what a reader must know before trusting the numbers.
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
    remarks: tuple[str, ...]

    @property
    def distortion(self) -> float:
        """Total harmonic distortion: the root of the sum of squares of `harmonics`."""
        return float(np.linalg.norm(self.harmonics))


def sine_point(
    record: MeasuredRecord, input_: str, output: str, *, window: Window | None = None, noise: float | None = None
) -> SinePoint:
    """Fit the command's wave and, over whole periods, the output's sine with its harmonics.

    Harmonics are fitted beside the sine, so that what is left over is noise; over whole periods that does not change
    the sine itself.

    Args:
        record: of kind "frequency-response", with its frequency; a log over time.
        input_, output: names of the columns.
        window: which periods are fitted.
        noise: standard deviation of the output's noise, in its unit, where it is known.
    Raises:
        BadInput: a command that is not the record's sine, an output that does not move, or less than one whole period.
    Source: thesis Eq. 2.4-2.13. Differs: amplitude and phase are referred to the command's fit, not to what it was
    meant to be; harmonics are part of the fit.
    """
    command = logged_wave(record, input_)
    assert isinstance(record.data, Record)  # logged_wave has refused anything else
    frequency = float(command.frequency)
    inside, periods, remarks = _fitted_part(record, command, window or Window())
    t, y = record.data.time[inside], record.data[output][inside]
    count = _harmonic_count(t, frequency)
    if count < 1:
        raise BadInput(
            f"{record.source}: the {t.size} samples of {periods} period{'s' if periods > 1 else ''} behind the settling"
            f" do not show {frequency:g} Hz; shorten the settling, record longer or sample faster"
        )
    waves = _waves(command.angle(t), count)
    coefficients = near_orthogonal_fit(waves, y)
    interval = float(t[-1] - t[0]) / (t.size - 1)
    judged = residual_noise(y - waves @ coefficients, waves, frequency, interval, declared=noise)
    amplitude = float(np.hypot(*coefficients[:2]))
    if amplitude <= 1e-12 * float(np.max(np.abs(y))):
        raise BadInput(f"{record.source}: {output} does not move at {frequency:g} Hz; there is no response")
    gain = amplitude / command.amplitude
    sizes = np.hypot(coefficients[0:-1:2], coefficients[1::2])
    spread = judged.deviation * math.sqrt(2 / t.size)  # of a coefficient: sum sin^2 is n/2
    power = float(np.sum(sizes[1:] ** 2)) / spread**2 if spread > 0 else math.inf * float(np.any(sizes[1:] > 0))
    distorted = bool(count > 1 and chi2.sf(power, 2 * (count - 1)) < _UNLIKELY)
    if periods > 1:
        remarks += _unsteady(command.angle(t), y, count, interval, noise)
    if judged.basis == COLOURED:
        remarks.append("residuals have a memory; intervals follow their spectrum")
    return SinePoint(
        source=record.source,
        frequency=frequency,
        command=command,
        gain=gain,
        phase=float(np.arctan2(coefficients[1], coefficients[0])),
        mean=float(coefficients[-1]),
        covariance=_covariance(command, gain, judged, t.size),
        harmonics=sizes[1:] / amplitude,
        harmonics_noise=spread / amplitude,
        distorted=distorted,
        noise=judged,
        periods=periods,
        remarks=tuple(remarks),
    )


def _fitted_part(record: MeasuredRecord, command: LoggedWave, window: Window) -> tuple[slice, int, list[str]]:
    """The samples of the last whole periods, how many, and what speaks against them."""
    assert isinstance(record.data, Record)
    t, period = record.data.time, 1 / command.frequency
    dt = float(np.median(np.diff(t)))
    available = (command.end - command.start + dt) / period + 1e-6
    settled = available - max(window.settle_periods, window.settle_time / period)
    if available < 1:
        raise BadInput(
            f"{record.source}: holds {available:.2g} periods of {command.frequency:g} Hz; record at least one behind "
            "the transients"
        )
    periods = max(int(settled), 1)
    remarks = []
    if settled < 1:
        before = command.end - period - command.start
        remarks.append(f"the fitted period begins {before:.2g} s after the sine; the transients may not have died")
    first = command.end - periods * period
    inside = slice(int(np.searchsorted(t, first + 0.5 * dt)), int(np.searchsorted(t, command.end + 0.5 * dt)))
    return inside, periods, remarks


def _harmonic_count(t: Array, frequency: float) -> int:
    """The sine itself and its harmonics, as many as sampling and number of samples allow; 0 where not even it."""
    if t.size < 2:
        return 0
    highest = 0.49 * (t.size - 1) / float(t[-1] - t[0])
    return max(min(int(highest / frequency), 1 + _HARMONICS, (t.size - 12) // 2), 0)


def _waves(angle: Array, count: int) -> Array:
    """sin and cos of 1 .. count times the angle, and a constant: (n, 2 count + 1)."""
    waves = [function(k * angle) for k in range(1, count + 1) for function in (np.sin, np.cos)]
    return np.column_stack([*waves, np.ones_like(angle)])


def _covariance(command: LoggedWave, gain: float, noise: ResidualNoise, samples: int) -> Array:
    """Of gain, phase and mean, to first order; noise of output and logged command."""
    sine = 2 * noise.at_frequency**2 / samples
    amplitude, phase = command.amplitude, command.covariance
    return np.diag(
        [
            sine / amplitude**2 + gain**2 * phase[0, 0] / amplitude**2,
            sine / (gain * amplitude) ** 2 + phase[1, 1],
            noise.at_zero**2 / samples,
        ]
    )


def _unsteady(angle: Array, y: Array, count: int, interval: float, declared: float | None) -> list[str]:
    """Whether amplitude or phase drift through the fitted part by more than noise."""
    through = np.linspace(-1.0, 1.0, angle.size)
    drifting = np.column_stack([_waves(angle, count), through * np.sin(angle), through * np.cos(angle)])
    coefficients = near_orthogonal_fit(drifting, y)
    frequency = float(angle[-1] - angle[0]) / (2 * np.pi * interval * (angle.size - 1))
    left_over = y - drifting @ coefficients
    noise = residual_noise(left_over, drifting, frequency, interval, declared=declared).at_frequency
    change = 2 * float(np.hypot(*coefficients[-2:]))
    variance = 4 * noise**2 * 2 / float(through @ through)
    if change <= 1e-9 * np.max(np.abs(y)) or (variance > 0 and chi2.sf(change**2 / variance, 2) > _UNLIKELY):
        return []
    share = change / float(np.hypot(*coefficients[:2]))
    return [f"the sine changes by {100 * share:.2g} percent within the fitted part; not settled, or not steady"]
