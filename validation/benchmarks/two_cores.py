"""How much of a whole fit runs side by side: its time by the clock over its own processor time."""

from __future__ import annotations

import os
from collections.abc import Iterator
from statistics import median

from validation.benchmarks import pump_fit
from validation.benchmarks.measurement import Measurement, load, timed

AIM, CORES = 0.6, 2


def measure(pairs: int) -> Iterator[Measurement]:
    """One would be a single core, one half is all that two cores can give."""
    if os.cpu_count() != CORES and len(os.sched_getaffinity(0)) < CORES:
        yield Measurement("wall over own CPU", float("nan"), AIM, skipped=f"needs {CORES} cores")
        return
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:CORES])
    data = pump_fit.dataset()
    pump_fit.warm_up()
    times = [timed(lambda: pump_fit.whole_fit(data)) for _ in range(pairs)]
    found = median(t.wall / t.cpu for t in times)
    yield Measurement(f"whole fit on {CORES} cores, {pairs} runs: wall over own CPU, {load(times)}", found, AIM)
