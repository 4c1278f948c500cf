"""The same fit by two Dask workers of one thread each, over two threads; and whether the numbers agree.

The cluster is the one that `distributed.LocalCluster(n_workers=2, threads_per_worker=1)` starts on this machine; the
same by two commands: `dask scheduler`, and `dask worker --nworkers 2 --nthreads 1 tcp://127.0.0.1:8786`.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from statistics import median

import numpy as np

from pysim.identify.greybox import Cluster, Simulation, Threads
from pysim.types import Fit
from validation.benchmarks import pump_fit
from validation.benchmarks.measurement import Measurement, in_turn, load, ratio
from validation.benchmarks.pump_fit import TESTS

AIM, SAME, WORKERS = 1.3, 1e-9, 2
_TESTS = TESTS[::3]  # a third of the measurements: every number is the same or is not


def measure(pairs: int) -> Iterator[Measurement]:
    """By the clock, since the work is in other processes."""
    words = f"fit by {WORKERS} Dask workers over {WORKERS} threads, by the clock"
    if find_spec("distributed") is None:
        why = 'Dask is not installed: python3 run.py python -m pip install "distributed>=2024.1"'
        yield Measurement(words, float("nan"), AIM, skipped=why)
        yield Measurement("largest difference of a number of both fits", float("nan"), SAME, skipped=why)
        return
    from distributed import Client, LocalCluster

    found: dict[str, Fit] = {}
    data = pump_fit.dataset(_TESTS)
    local = LocalCluster(n_workers=WORKERS, threads_per_worker=1, processes=True, dashboard_address=None)
    with local, Client(local) as client:
        ways = {"cluster": Simulation(workers=Cluster(client)), "threads": Simulation(workers=Threads(WORKERS))}

        def fitted(way: str) -> None:
            found[way] = pump_fit.whole_fit(data, ways[way])

        fitted("cluster")  # each worker loads what it needs once
        fitted("threads")
        both = in_turn(lambda: fitted("cluster"), lambda: fitted("threads"), pairs)
    one, two = (median(pair[k].wall for pair in both) for k in (0, 1))
    busy = load([threads for _, threads in both])
    yield Measurement(f"{words}: {one:.1f} s over {two:.1f} s, when {busy}", ratio(both, "wall"), AIM)
    yield Measurement(
        "largest difference of a number of both fits, of its size", _apart(found["cluster"], found["threads"]), SAME
    )


def _apart(one: Fit, other: Fit) -> float:
    """Over estimates, intervals, cost and simulated values; 0 where all are the same, to the last bit."""
    pairs = [(one.cost, other.cost), (one.misfit, other.misfit)]
    for a, b in zip(one.estimates, other.estimates, strict=True):
        pairs += [(a.value, b.value), *zip(a.interval, b.interval, strict=True)]
    apart = [abs(a - b) / abs(b) for a, b in pairs if a != b]
    for r, s in zip(one.records, other.records, strict=True):
        size = float(np.abs(s.simulated.values).max())
        apart.append(float(np.abs(r.simulated.values - s.simulated.values).max()) / size)
    return max(apart)
