"""Heave compensation: a wave, the references a crane makes of it, and how well the rig follows."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.excitation import LeadIn, PiersonMoskowitz, StochasticWave
from pysim.rig.rig_system import OUTPUTS
from pysim.rig.standstill import standstills
from pysim.types import BadInput, Experiment, Record, Signal

Array = NDArray[np.float64]

_ROW = 2e-3
REFERENCES = ("crane.omegaS_ref", "crane.pL_ref", "crane.z_PL")


@dataclass(frozen=True)
class HeaveTest:
    """A vessel that heaves in a stochastic wave after some seconds at rest under the payload's weight.

    Args:
        significant_height: m, of the vessel's heave.
        peak_period: s.
        length: s of the wave.
        seed: of its phases.
        rest: s before it, for the load pressure to come up.
        settle: s from the start that the figures leave out.
    Raises:
        BadInput: what StochasticWave refuses, or times that are negative.
    Source: thesis Eq. 5.42 and Appendix A, whose sea state is not published: by default a swell that turns the drum by
    up to some 50 rad/s.
    """

    significant_height: float = 2.0
    peak_period: float = 10.0
    length: float = 60.0
    seed: int = 1
    rest: float = 3.0
    settle: float = 6.0
    _wave: StochasticWave = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        spectrum = PiersonMoskowitz(self.significant_height, self.peak_period)
        wave = StochasticWave(spectrum, self.length, self.seed, lead=LeadIn.none())
        object.__setattr__(self, "_wave", wave)
        if not (0 <= self.rest < math.inf and 0 <= self.settle < self.rest + self.length):
            raise BadInput(
                f"heave test: rest = {self.rest:g} s, settle = {self.settle:g} s; give seconds within the test"
            )

    def velocity(self) -> Signal:
        """Of the vessel, upwards, m/s: zero at rest, then the wave's rate from one of its zeros on."""
        amplitude, phase, omega = self._wave.waves().T
        start = _first_zero(amplitude * omega, phase, omega)
        sines = np.column_stack([amplitude * omega, phase + omega * start + math.pi / 2, omega, 0 * omega])
        if self.rest == 0:
            return Signal(np.zeros(1), np.zeros((1, 4)), sines[None])
        return Signal(np.array([0.0, self.rest]), np.zeros((2, 4)), np.stack([0 * sines, sines]))

    def experiment(self, *, every: float = _ROW) -> Experiment:
        """For `rig_system` with a crane, a row every so many seconds, a whole number of communication steps."""
        times = np.arange(round((self.rest + self.length) / every) + 1, dtype=np.float64) * every
        return Experiment(times, (*OUTPUTS, *REFERENCES), {"crane.z_v_t": self.velocity()})


@dataclass(frozen=True)
class HeaveFigures:
    """How well speed and load pressure followed, over all that the test does not leave out.

    Args:
        speed_rms, speed_max: rad/s, true speed less reference.
        pressure_rms, pressure_max: Pa, load pressure less reference.
        pressure_slow_rms: Pa, the same below 1 Hz: what the waves leave, without stick and slip.
        supply_low, supply_high: Pa, least and largest pressure across the supply motor.
        held: (n, 2) s, where the shaft stands still.
        held_longest, held_reference: s, the longest of these, and the longest that the reference asks for.
    """

    speed_rms: float
    speed_max: float
    pressure_rms: float
    pressure_max: float
    pressure_slow_rms: float
    supply_low: float
    supply_high: float
    held: Array
    held_longest: float
    held_reference: float


def heave_figures(record: Record, test: HeaveTest) -> HeaveFigures:
    """What a record of the test is worth.

    Raises:
        BadInput: a record that ends within what is left out, or lacks a signal.
    """
    counts = record.time >= test.settle
    if counts.sum() < 100:
        raise BadInput(f"heave figures: the record ends before {test.settle:g} s; run it to the end")
    time, speed = record.time[counts], record["rig.omega"][counts]
    reference = record["crane.omegaS_ref"][counts]
    error, pressure = speed - reference, record["rig.pL"] - record["crane.pL_ref"]
    slow = slow_part(pressure, record.time)[counts]
    pressure, supply = pressure[counts], record["rig.pS"][counts]
    held, wanted = standstills(time, speed), standstills(time, reference)
    return HeaveFigures(
        _rms(error),
        float(np.abs(error).max()),
        _rms(pressure),
        float(np.abs(pressure).max()),
        _rms(slow),
        float(supply.min()),
        float(supply.max()),
        held,
        _longest(held),
        _longest(wanted),
    )


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _longest(spans: Array) -> float:
    return float((spans[:, 1] - spans[:, 0]).max(initial=0.0))


def slow_part(values: Array, time: Array) -> Array:
    """What of values (n_t,) at evenly spaced times is below 1 Hz, without lag."""
    from scipy.signal import butter, sosfiltfilt  # half a second to import, for those alone who tried controllers

    rate = (time.size - 1) / (time[-1] - time[0])
    return np.asarray(sosfiltfilt(butter(4, 1.0, fs=rate, output="sos"), values), dtype=np.float64)


def _first_zero(amplitude: Array, phase: Array, omega: Array) -> float:
    """The first time at which the sum of a cos(omega t + phase) passes zero, s, by bisection."""

    def value(t: Array) -> Array:
        return np.asarray((amplitude * np.cos(omega * t[:, None] + phase)).sum(axis=1))

    times = np.arange(0.0, 40 * math.pi / omega.mean(), 0.1 / omega.max())
    signs = np.signbit(value(times))
    at = int(np.flatnonzero(signs[1:] != signs[:-1])[0])
    low, high = times[at], times[at + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if np.signbit(value(np.array([middle])))[0] == signs[at] else (low, middle)
    return float(0.5 * (low + high))
