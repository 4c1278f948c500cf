"""What the bench is driven through, from standstill: stairs, sines, a wave; the servo valve goes along with the pump.

Edges of steps last 0.1 s, and waves fade in, so that a log at 100 Hz tells the whole command.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.bench import Logger, Plan, Run, Sensor
from pysim.types import MeasuredSignal, Signal

Array = NDArray[np.float64]

RATE = 100.0  # Hz
# Of the servo valve's command per percent of the pump's: -K_L/K_qu omega (thesis Eq. 5.37), 1.85 rad/s per percent.
ALONG = -0.00505
OUTPUTS = ("omega", "pS", "pL")
NOISE = {"omega": 0.05, "pS": 3e4, "pL": 3e4}  # rad/s, Pa
_BEGIN = 1.0  # s of standstill


@dataclass(frozen=True)
class Drawn:
    """A command through its samples.

    Args:
        values: (n_t,) percent, from time 0 on at the log's rate.
    """

    values: tuple[float, ...]

    @property
    def onset(self) -> float:
        """The log starts with the command."""
        return 0.0

    @property
    def end(self) -> float:
        """Of the log, s."""
        return (len(self.values) - 1) / RATE

    @property
    def duration(self) -> float:
        """Of the whole command, s."""
        return self.end

    @property
    def highest_hz(self) -> float:
        """It is no sum of sines to the bench."""
        return 0.0

    def signal(self) -> Signal:
        """Smooth between the samples."""
        return Signal.through(np.arange(len(self.values)) / RATE, np.array(self.values))


@dataclass(frozen=True)
class DrawnTest:
    """One run with a command of our own."""

    name: str
    use: str
    command: Drawn
    input: str = "alphaCMD"
    outputs: tuple[str, ...] = OUTPUTS

    def runs(self, unit: float) -> Iterator[Run]:
        """The one run; its file is named by the test."""
        yield Run(f"{self.name}.txt", "other", self.use, self.input, self.outputs, self.command, 0.0)


def plan() -> Plan:
    """Three tests to fit, two held out."""
    stairs = (1, 18), (3.5, 12), (6, 24), (8.5, -14), (11, -20), (13.5, -11), (16, 15), (18, 20)
    tests = (
        DrawnTest("stairs", "fit", _steps(20, *stairs)),
        DrawnTest("other_stairs", "fit", _steps(16, (1, -16), (4, -22), (7, 13), (10, 18), (13, -12))),
        DrawnTest("sines", "fit", _sines(25, 0.8, 1.6, 8)),
        DrawnTest("steps", "validate", _steps(9, (1, -17), (4, 15), (7, -12))),
        DrawnTest("wave", "validate", _wave(35, 1.5, 9, seed=7)),
    )
    inputs = (("alphaCMD", "%", "command of the pump"), ("u_ref", "1", "command of the servo valve"))
    outputs = (("omega", "rad/s", "speed"), ("pS", "Pa", "supply pressure"), ("pL", "Pa", "load pressure"))
    sensors = [Sensor(MeasuredSignal(name, "input", unit, what, name)) for name, unit, what in inputs]
    sensors += [Sensor(MeasuredSignal(n, "output", unit, what, n, noise=NOISE[n])) for n, unit, what in outputs]
    about = "the pump moves the shaft, the servo valve goes along as the thesis' feed forward has it"
    follows = {"u_ref": ("alphaCMD", ALONG)}
    return Plan("rig", about, "test bench", tuple(sensors), tests, Logger(((1, RATE),)), follows=follows)


def _times(length: float) -> Array:
    return np.arange(round(length * RATE)) / RATE


def _sines(amplitude: float, low: float, high: float, length: float) -> Drawn:
    """Frequency that rises from low to high, Hz."""
    s = _times(length) - _BEGIN
    phase = 2 * np.pi * (low * s + (high - low) / (2 * (length - _BEGIN)) * s * s)
    return Drawn(tuple(np.where(s >= 0, amplitude * np.sin(phase), 0.0).tolist()))


def _wave(peak: float, period: float, length: float, *, seed: int) -> Drawn:
    """Twelve sines about a period, s, the largest sum as high as the peak."""
    rng, t = np.random.default_rng(seed), _times(length)
    frequencies, phases = rng.uniform(0.5 / period, 2.5 / period, 12), rng.uniform(0, 2 * np.pi, 12)
    wave = np.sin(2 * np.pi * np.multiply.outer(t, frequencies) + phases).sum(axis=1)
    return Drawn(tuple((peak * wave / np.abs(wave).max() * np.clip(t - 1.5, 0, 1)).tolist()))


def _steps(length: float, *edges: tuple[float, float]) -> Drawn:
    """(time in s, level in percent) of each edge."""
    knots, levels = [0.0], [0.0]
    for time, level in edges:
        knots += [time, time + 0.1]
        levels += [levels[-1], level]
    return Drawn(tuple(np.interp(_times(length), knots, levels).tolist()))
