"""A pass over sixteen times the data over a pass: its time grows as the data do, its memory hardly."""

from __future__ import annotations

from collections.abc import Iterator
from statistics import median

from validation.benchmarks.long_log import Cost, cost
from validation.benchmarks.measurement import Measurement

TIME, MEMORY, TIMES = 16.5, 1.1, 16
ROWS = 31_250


def measure(pairs: int) -> Iterator[Measurement]:
    """A pass is what lies between two points of a search; peak memory is that of the process which fits."""
    cost(ROWS)  # what is compiled once takes memory, too
    found = [(cost(TIMES * ROWS), cost(ROWS)) for _ in range(pairs)]
    passes = median(_one_pass(large) / _one_pass(small) for large, small in found)
    memory = median(large.peak / small.peak for large, small in found)
    large, small = found[-1]
    rows = f"{large.rows} rows over {small.rows}"
    words = f"CPU of a pass over {rows}: {_one_pass(large):.2f} s over {_one_pass(small):.3f} s"
    yield Measurement(words, passes, TIME)
    words = f"peak memory of a fit of {rows}: {large.peak / 1e6:.0f} MB over {small.peak / 1e6:.0f} MB"
    yield Measurement(words, memory, MEMORY)


def _one_pass(of: Cost) -> float:
    return median(of.passes)
