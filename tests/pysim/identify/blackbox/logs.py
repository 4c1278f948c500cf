"""A linear system as tables and as logs of a bench."""

from __future__ import annotations

import numpy as np

from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record, SineTest
from tests.pysim.identify.blackbox.systems import from_roots, pairs

SYSTEM = from_roots([], pairs(-9 + 30j), 981.0)
F = (0.1, 0.5, 1.0, 2.0, 4.0, 6.0, 9.0)
SIGNALS = (
    MeasuredSignal("u", "input", "%", "command", "u"),
    MeasuredSignal("y", "output", "%", "answer", "y", noise=0.01),
    MeasuredSignal("p", "output", "%", "other answer", "p", noise=0.01),
)


def table(offset: float, amplitude: float, use: str = "fit", output: str = "y") -> MeasuredRecord:
    """A response as a table, exact."""
    response = SYSTEM.response(np.array(F), SineTest(offset, amplitude, "u", output), origin="a table")
    return MeasuredRecord("t.csv", "frequency-response-table", use, response)


def log(f: float, seed: int, use: str = "fit", gain: float = 1.0, output: str = "y") -> MeasuredRecord:
    """A stepped sine around 20 percent with 5 percent amplitude, already swinging steadily; the answer times a gain."""
    t = np.linspace(0.0, max(2.0, 3 / f), 1500)
    g = complex(SYSTEM.at(np.array([f]))[0])
    u, y = (20 + 5 * np.imag(z * np.exp(2j * np.pi * f * t)) for z in (1.0, g))
    noise = 0.01 * np.random.default_rng(seed).standard_normal(t.size)
    data = Record(t, np.column_stack([u, gain * y + noise]), ("u", output), ("%", "%"))
    return MeasuredRecord(f"{f}.txt", "frequency-response", use, data, 20.0, 5.0, f)


def dataset(*records: MeasuredRecord) -> Dataset:
    """Of these records."""
    return Dataset("bench", "-", "-", SIGNALS, records)
