"""Logs of a first-order lag K g / (T s + 1) from closed forms, with seeded noise."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pysim.types import Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, SineTest

Array = NDArray[np.float64]

NOISE = 0.02


def dataset(records: list[MeasuredRecord], noise: float | None = NOISE) -> Dataset:
    signals = (
        MeasuredSignal("w", "input", "1", "command", "w"),
        MeasuredSignal("y", "output", "1", "answer", "y", noise=noise),
    )
    return Dataset("lag", "a lag with known answer", "lag", signals, tuple(records))


def log(time: Array, w: Array, y: Array, source: str = "log.txt", use: str = "fit") -> MeasuredRecord:
    data = Record(time, np.column_stack([w, y]), ("w", "y"), ("1", "1"))
    return MeasuredRecord(source, "other", use, data)


def ramp_answer(t: Array, K: float, T: float) -> Array:
    """y to w = t from rest."""
    return K * (t - T * (1 - np.exp(-t / T)))


def ramp_log(
    K: float, T: float, seed: int, *, noise: float = NOISE, use: str = "fit", source: str = "log.txt"
) -> MeasuredRecord:
    t = np.arange(0, 3, 0.02)
    y = ramp_answer(t, K, T) + noise * np.random.default_rng(seed).standard_normal(t.size)
    return log(t, t, y, source, use)


def sine_log(
    K: float, T: float, f: float, seed: int, *, noise: float = NOISE, distort: Callable[[Array], Array] = lambda y: y
) -> MeasuredRecord:
    """A swing of 2 around 1, steady from the first sample, phase 0.3 at time 5."""
    t = 5 + np.arange(0, max(3.0, 4 / f), 0.01)
    angle = 2 * np.pi * f * (t - 5) + 0.3
    gain = K / (1 + 2j * np.pi * f * T)
    y = distort(K * 1.0 + 2 * np.abs(gain) * np.sin(angle + np.angle(gain)))
    y = y + noise * np.random.default_rng(seed).standard_normal(t.size)
    data = Record(t, np.column_stack([1 + 2 * np.sin(angle), y]), ("w", "y"), ("1", "1"))
    return MeasuredRecord(f"{f:g}Hz.txt", "frequency-response", "fit", data, 1.0, 2.0, f)


def table(K: float, T: float, frequencies: Array) -> MeasuredRecord:
    gain = K / (1 + 2j * np.pi * frequencies * T)
    response = FrequencyResponse(frequencies, np.abs(gain), np.angle(gain), SineTest(1.0, 2.0, "w", "y"), "closed form")
    return MeasuredRecord("table.csv", "frequency-response-table", "fit", response)
