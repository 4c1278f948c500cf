"""Logs as a bench writes them: a command sampled, with a lead-in or without, rounded, quantised or noisy."""

import numpy as np

from pysim.excitation import Excitation
from pysim.types import MeasuredRecord, Record


def log(
    test: Excitation,
    kind: str,
    *,
    frequency: float | None = None,
    first: float | None = None,
    last: float | None = None,
    rate: float = 250.0,
    decimals: int = 5,
    noise: float = 0.0,
    step: float = 0.0,
    seed: int = 0,
    jitter: float = 0.0,
) -> MeasuredRecord:
    """The command of a test from `first` to `last` (s; by default from its onset to its end), in a column "cmd".

    noise and step are the standard deviation and the quantisation of the column; jitter is that of the clock, s: the
    written times are even, the true ones are not.
    """
    draw = np.random.default_rng(seed)
    first = test.onset if first is None else first
    last = test.end if last is None else last
    time = first + np.arange(int(np.floor((last - first) * rate + 1e-6)) + 1) / rate
    values = test.signal().value(time + jitter * draw.standard_normal(time.size))
    values = values + noise * draw.standard_normal(time.size)
    values = np.round(values / step) * step if step else np.round(values, decimals)
    data = Record(np.round(time, 9), values[:, None], ("cmd",), ("%",), origin="measured")
    return MeasuredRecord("log.txt", kind, "fit", data, frequency=frequency)
