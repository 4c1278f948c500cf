"""A log of ten million rows fitted: the memory it takes. By itself this measures less and extrapolates."""

from __future__ import annotations

from collections.abc import Iterator

from validation.benchmarks.long_log import GIB, cost
from validation.benchmarks.measurement import Measurement

AIM, ROWS = 2.0, 10_000_000  # GiB
_FEW = (500_000, 2_000_000)  # rows: enough to see what a row takes
_ACCURACY = 1e-3


def measure(pairs: int) -> Iterator[Measurement]:
    """From two shorter logs: memory that grows by the row."""
    cost(_FEW[0] // 500)
    small, large = (cost(rows) for rows in _FEW)
    per_row = (large.peak - small.peak) / (large.rows - small.rows)
    peak = small.peak + per_row * (ROWS - small.rows)
    words = (
        f"a fit of {ROWS} rows, GiB at most, extrapolated from {small.rows} and {large.rows}: {per_row:.0f} bytes a row"
    )
    yield Measurement(words, peak / GIB, AIM, "GiB")


def measure_whole() -> Iterator[Measurement]:
    """All ten million rows, however long that takes."""
    found = cost(ROWS)
    words = f"a fit of {ROWS} rows, GiB at most, {sum(found.passes):.0f} s of CPU after the first point"
    yield Measurement(words, found.peak / GIB, AIM, "GiB")
    yield Measurement("largest error of a parameter of that fit, over its value", found.error, _ACCURACY)
