"""Wherever the runs go, the fit is the same; what a worker loses is a bad point."""

import signal
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.identify.greybox import Cluster, Parameter, Processes, Simulation, Threads, problem
from pysim.identify.greybox.workers import Job, helper_processes
from pysim.io import read_model
from pysim.simulate import Esdirk
from pysim.types import Experiment, Model, Outcome
from tests.pysim.identify.greybox import measurements as m
from tests.pysim.simulate import fixture_fmus


class Client:
    """As a Dask client, in this process; loses shares on demand."""

    def __init__(self, lose: int | None = None) -> None:
        self.lose, self.calls = lose, 0

    def map(self, function: Any, shares: list, **_: Any) -> list[Future]:
        futures = []
        for share in shares:
            future: Future = Future()
            self.calls += 1
            if self.lose is not None and self.calls > self.lose:
                future.set_exception(RuntimeError("worker died"))
            else:
                future.set_result(function(share))
            futures.append(future)
        return futures


def task(lag: Model) -> Any:
    records = [m.ramp_log(2.0, 0.7, seed=2), *(m.sine_log(2.0, 0.7, f, seed=1) for f in (0.5, 1.0, 2.0))]
    return problem(lag, [m.dataset(records)], [Parameter("K"), Parameter("T")])


def at_start(this: Any, workers: Any = None) -> Any:
    """The objective where the search begins."""
    simulation = Simulation() if workers is None else Simulation(workers=workers)
    return this.residuals(simulation=simulation).evaluate(
        this.model, this.space, this.space.to_search(this.space.start)
    )


@pytest.mark.parametrize("workers", [Threads(1), Threads(3), Cluster(Client()), Cluster(Client(), chunks=1)])
def test_all_workers_give_the_same_numbers(lag: Model, workers: Any) -> None:
    this = task(lag)
    expected = at_start(this)
    found = at_start(this, workers)
    assert np.array_equal(found.residual, expected.residual)
    assert np.array_equal(found.jacobian, expected.jacobian)


def test_a_share_that_a_cluster_lost_is_a_bad_point(lag: Model) -> None:
    this = task(lag)
    found = at_start(this, Cluster(Client(lose=0)))
    assert not found.good
    assert "worker died" in str(found.failure)


@pytest.mark.slow
def test_processes_give_the_same_numbers(lag: Model) -> None:
    this = task(lag)
    expected = at_start(this)
    found = at_start(this, Processes(2))
    assert np.array_equal(found.residual, expected.residual)


@pytest.mark.slow
def test_an_fmu_that_crashes_ends_its_worker_and_not_the_run(tmp_path: Path) -> None:
    model = read_model(fixture_fmus.build(fixture_fmus.FRAGILE, 2, tmp_path))
    times = np.linspace(0.0, 3.0, 7)  # its state passes zero at 2 s, where manner 3 ends the process
    crash, fine = (Experiment(times[:n], ("x",), overrides={"manner": manner}) for n, manner in ((7, 3.0), (3, 0.0)))
    jobs = [Job(i, run, ("manner",), np.ones((1, 1))) for i, run in enumerate((fine, crash, fine))]
    first, lost, last = Processes(2).run(model, jobs, Esdirk())
    assert lost.record.outcome is not Outcome.DONE
    assert "crashed" in lost.record.message
    for result in (first, last):
        assert result.record.outcome is Outcome.DONE
        assert result.record["x"] == pytest.approx((1 - times[:3] / 2) ** 2, abs=3e-3)


def test_ctrl_c_ends_a_worker_process_at_once() -> None:
    """One that caught it would go on with the shares that wait, and show a traceback for each."""
    with helper_processes(1) as pool:
        assert pool.submit(signal.getsignal, signal.SIGINT).result() == signal.SIG_DFL


@pytest.mark.slow
def test_a_dask_cluster_gives_the_same_numbers(lag: Model) -> None:
    distributed = pytest.importorskip("distributed")
    this = task(lag)
    expected = at_start(this)
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = at_start(this, Cluster(client, chunks=2))
    assert np.array_equal(found.residual, expected.residual)
    assert np.array_equal(found.jacobian, expected.jacobian)
