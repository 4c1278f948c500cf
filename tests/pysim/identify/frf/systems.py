"""A second-order system with closed-form answers, and logs of it."""

import math

import numpy as np
from scipy.signal import lfilter

from pysim.excitation import SteppedSineCommand
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record

OMEGA, ZETA, GAIN = 2 * np.pi * 8.0, 0.6, 0.9  # rad/s, 1, output unit per input unit


def response(frequency: np.ndarray | float) -> np.ndarray:
    """GAIN omega^2 / (s^2 + 2 zeta omega s + omega^2) at frequencies in Hz."""
    s = 2j * np.pi * np.asarray(frequency)
    return GAIN * OMEGA**2 / (s**2 + 2 * ZETA * OMEGA * s + OMEGA**2)


def steady(test: SteppedSineCommand, time: np.ndarray) -> np.ndarray:
    """The system's steady answer to a sine, without transients."""
    g = response(test.frequency)
    angle = 2 * np.pi * test.frequency * (time - test.onset)
    return GAIN * test.offset + abs(g) * test.amplitude * np.sin(angle + np.angle(g))


def white(n: int, sigma: float, seed: int) -> np.ndarray:
    return sigma * np.random.default_rng(seed).standard_normal(n)


def coloured(n: int, sigma: float, seed: int, pole: float = 0.9) -> np.ndarray:
    """Noise of that standard deviation with a memory of 1/(1 - pole) samples."""
    drive = white(n + 500, sigma * math.sqrt(1 - pole**2), seed)
    return lfilter([1.0], [1.0, -pole], drive)[500:]


def log(
    frequency: float,
    *,
    noise: np.ndarray | float = 0.0,
    offset: float = 50.0,
    amplitude: float = 10.0,
    periods: float = 20.0,
    told: tuple[float | None, float | None] = (50.0, 10.0),
    add: float = 0.0,
) -> MeasuredRecord:
    """The sine of a test with its steady answer at 250 Hz; `add` is a third harmonic, as a share of the answer."""
    test = SteppedSineCommand(offset, amplitude, frequency, periods)
    time = 2.0 + np.arange(round(periods / frequency * 250) + 1) / 250
    y = steady(test, time)
    swing = y - GAIN * offset
    third = add * np.max(np.abs(swing)) * np.sin(3 * 2 * np.pi * frequency * (time - 2.0) + 0.4)
    y = y + third + (noise[: time.size] if isinstance(noise, np.ndarray) else noise)
    values = np.column_stack([np.round(test.signal().value(time), 5), y])
    data = Record(np.round(time, 4), values, ("cmd", "y"), ("%", "deg"), origin="measured")
    return MeasuredRecord(f"{frequency:g}Hz.txt", "frequency-response", "fit", data, *told, frequency)


def dataset(*records: MeasuredRecord, noise: float | None = None, resolution: float | None = None) -> Dataset:
    signals = (
        MeasuredSignal("cmd", "input", "%", "command", "cmd"),
        MeasuredSignal("y", "output", "deg", "angle", "y", noise, resolution),
    )
    return Dataset("bench", "", "", signals, records)
