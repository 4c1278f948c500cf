"""The commanded sine or chirp, fitted to the column in which it was logged."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.logged.stretch import Log, Stretch, grow, wander
from pysim.identify.logged.wave_fit import chirp_start, fit_chirp, fit_sine, sine_start
from pysim.types import BadInput, MeasuredRecord, Record
from pysim.types.record_kind import CHIRP, STEPPED_SINE

Array = NDArray[np.float64]

# A residual of any structure is accepted up to this share of the amplitude, the resolution of ten bits.
_HARMLESS = 1e-3
# Largest noise on the logged command, as a share of the amplitude.
_NOISE = 0.05
# Before and after the wave, the command may move this many amplitudes to and fro, besides its lead-in and way back.
_WANDER = 2.5


@dataclass(frozen=True)
class LoggedWave:
    """offset + amplitude sin(phase + 2 pi (frequency + rate/2 s) s) with s = t - start, from start to end.

    Args:
        offset, amplitude: in the command's unit.
        phase: rad, at the start.
        frequency: Hz, at the start.
        rate: Hz/s; zero for a sine.
        start, end: s; the part of the log that is the wave.
        covariance: (2, 2) of amplitude (command's unit) and mean phase (rad), from the residual.
        residual: root mean square residual of the fit, in the command's unit.
    Source: thesis Eq. 2.1, 2.2.
    """

    offset: float
    amplitude: float
    phase: float
    frequency: float
    rate: float
    start: float
    end: float
    covariance: Array
    residual: float

    def angle(self, t: Array) -> Array:
        """Phase of the sine at times (n,) in s, in rad, unwrapped."""
        s = np.asarray(t, dtype=np.float64) - self.start
        return self.phase + 2 * np.pi * (self.frequency + 0.5 * self.rate * s) * s

    def frequency_at(self, t: Array) -> Array:
        """Hz at times (n,) in s."""
        return self.frequency + self.rate * (np.asarray(t, dtype=np.float64) - self.start)

    def time_of(self, angle: Array) -> Array:
        """Times in s at which `angle` has the values (n,) in rad, where it increases."""
        turns = (np.asarray(angle, dtype=np.float64) - self.phase) / (2 * np.pi)
        root = np.sqrt(np.maximum(self.frequency**2 + 2 * self.rate * turns, 0.0))
        return np.asarray(self.start + 2 * turns / (self.frequency + root))

    def value(self, t: Array) -> Array:
        """The command at times (n,) in s, in its unit."""
        return self.offset + self.amplitude * np.sin(self.angle(t))


def logged_wave(record: MeasuredRecord, column: str) -> LoggedWave:
    """Fit the wave of a stepped-sine or chirp record to its logged command.

    The log may have a lead-in before the wave and a ramp after it, which are left out. A stepped sine has
    the record's frequency; a chirp's start frequency and rate are fitted.

    Args:
        record: a stepped sine with its frequency, or a chirp.
        column: name of the logged command.
    Raises:
        BadInput: another kind, no frequency, a column that is no sine or chirp, or whose fit leaves more than rounding
            and noise.
    """
    log = Log.of(_data(record), column)
    where, lost = f"{record.source}, {column}", ""
    if record.kind == STEPPED_SINE.name:
        if record.frequency is None:
            raise BadInput(f"{record.source}: a stepped sine needs its frequency; give it in the record")
        omega = 2 * np.pi * record.frequency
        what = f"a sine of {record.frequency:g} Hz"
        start = sine_start(log.time, log.values, omega, log.step, log.interval)
        stretch = grow(log, start, lambda t, y, w: fit_sine(t, y, omega))
    elif record.kind == CHIRP.name:
        what, lost = "a chirp", _lost(log)
        found = chirp_start(log.time, log.values)
        if found is None:
            raise BadInput(
                f"{where}: this is no chirp: it swings less than three times; correct the record's kind{lost}"
            )
        stretch = grow(log, found, fit_chirp)
    else:
        raise BadInput(f"{record.source}: a {record.kind} record has no closed form; only stepped sines and chirps do")
    _check(log, stretch, where, what, lost)
    return _logged(stretch, log)


def _data(record: MeasuredRecord) -> Record:
    if not isinstance(record.data, Record):
        raise BadInput(f"{record.source}: holds a response over frequency, not a log over time; nothing to fit")
    return record.data


def _check(log: Log, stretch: Stretch, where: str, what: str, lost: str) -> None:
    """Raise BadInput if the residual is more than rounding or noise, or if the command oscillates outside the wave.

    Args:
        lost: end of the messages, on missing samples.
    """
    wave, rms = stretch.wave, stretch.residual
    allowed = log.step + 3 * wave.amplitude * wave.fastest(log.time[stretch.inside]) * log.jitter
    harmless = rms <= max(allowed, _HARMLESS * wave.amplitude)
    if not (harmless or (stretch.is_noise and rms <= _NOISE * wave.amplitude)):
        raise BadInput(
            f"{where}: this is not {what}: its best fit leaves over {rms:.3g} rms of an amplitude of "
            f"{wave.amplitude:.3g}, more than rounding and noise; correct the record's kind or frequency, or call it "
            f'"other"{lost}'
        )
    first, last = stretch.inside.start, stretch.inside.stop
    for part, name, at in ((log.values[:first], "before", first), (log.values[last:], "behind", last - 1)):
        if part.size > 1 and wander(part, 5 * rms + log.step) > _WANDER * wave.amplitude:
            raise BadInput(
                f"{where}: {name} {log.time[at]:g} s this is not {what} any more, but it still swings; correct the "
                f"record's frequency or kind, or cut the log{lost}"
            )


def _lost(log: Log) -> str:
    """End of a message on a chirp with a gap, since no turn of a chirp may be lost; empty without a gap."""
    if log.gap is None:
        return ""
    return f"; or cut it where samples are lost, from {log.gap[0]:g} to {log.gap[1]:g} s"


def _logged(stretch: Stretch, log: Log) -> LoggedWave:
    """The fit, with phase and frequency at the wave's start."""
    wave, start = stretch.wave, stretch.start
    last = stretch.inside.stop - 1
    n = max(last - stretch.inside.start - 2, 1)
    variance = 2 * max(stretch.residual, log.step / np.sqrt(12)) ** 2 / n
    return LoggedWave(
        offset=wave.offset,
        amplitude=wave.amplitude,
        phase=float(np.remainder(wave.angle(start) + np.pi, 2 * np.pi) - np.pi),
        frequency=float(wave.omega_at(start) / (2 * np.pi)),
        rate=wave.kappa / (2 * np.pi),
        start=start,
        end=float(log.time[last]),
        covariance=np.diag([variance, variance / wave.amplitude**2]),
        residual=stretch.residual,
    )
