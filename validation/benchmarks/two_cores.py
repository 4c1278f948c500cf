"""How much of a whole fit runs side by side: its time by the clock over its own processor time."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from statistics import median

from validation.benchmarks import pump_fit
from validation.benchmarks.measurement import Measurement, Timed, load, timed
from validation.benchmarks.runnable import CORES, watched

AIM = 0.6


def measure(pairs: int) -> Iterator[Measurement]:
    """One would be a single core, one half is all that two cores can give.

    The aim is held against what two free cores would give: by the clock a busy machine fails whatever the code does.
    """
    claim = f"whole fit on {CORES} cores, {pairs} runs: wall over own CPU"
    if not sys.platform.startswith("linux") or len(os.sched_getaffinity(0)) < CORES:
        yield Measurement(claim, float("nan"), AIM, skipped=f"needs Linux and {CORES} cores")
        return
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:CORES])
    data = pump_fit.dataset()
    pump_fit.warm_up()
    times: list[Timed] = []
    free: list[float] = []
    for _ in range(pairs):
        with watched(os.getpid()) as seen:
            times.append(timed(lambda: pump_fit.whole_fit(data)))
        free.append(seen.free / seen.cpu)
    yield Measurement(f"{claim}, had both been free", median(free), AIM)
    yield Measurement(f"the same by the clock, {load(times)}", median(t.wall / t.cpu for t in times))
