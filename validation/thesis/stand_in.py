"""The virtual bench, where the thesis' own measurements would be needed: they were never published."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from pysim.bench import BenchData, Plan, read_plan, run_plan
from pysim.bench.bench_tests import BenchTest
from pysim.thesis import pump_model
from pysim.types import Dataset, MeasuredRecord, Record

COMMAND, ANGLE, SPOOL = "alphaCMD", "alphaPercent", "u"
NOTE = (
    "The measured points were never published. The virtual bench stands in: the free model (Table 4.6) with noise of "
    "0.1 % of the angle and 12 bits, logged as Section 3.1.3 says. What it shows is the method, and the model; it says "
    "nothing of the pump."
)


def bench(tests: Sequence[BenchTest], *, parameter_set: str = "free", seed: int = 1) -> BenchData:
    """Drive the pump model through tests and log it as the thesis' bench would.

    Args:
        parameter_set: "free" (Table 4.6) or "locked" (Table 4.5).
        seed: of the noise.
    """
    return _run(tuple(tests), parameter_set, seed)


@cache
def _run(tests: tuple[BenchTest, ...], parameter_set: str, seed: int) -> BenchData:
    thesis = read_plan("thesis")
    plan = Plan("stand-in", NOTE, "pump", thesis.sensors, tests, thesis.logger)
    return run_plan(pump_model(parameter_set), plan, seed)


def logged(dataset: Dataset) -> tuple[tuple[MeasuredRecord, Record], ...]:
    """Every log with its samples."""
    return tuple((record, record.data) for record in dataset.logs() if isinstance(record.data, Record))
