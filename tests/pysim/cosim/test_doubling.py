"""Step doubling: the error follows the tolerance, and time stays exact."""

import numpy as np
import pytest

from pysim.cosim import Connection, Doubling, GaussSeidel, Iterated, Jacobi, Order, System, cosimulate
from pysim.types import BadInput, Experiment, Outcome, Port, Signal, SimulationError
from tests.cosim_parts import Linear, oscillation, oscillators

TIMES = np.linspace(0, 2, 21)


@pytest.mark.parametrize("order", [Jacobi(), GaussSeidel(), Jacobi(lines=True), Iterated()], ids=str)
def test_the_error_follows_the_tolerance(order: Order) -> None:
    known, found, parts = oscillation(TIMES), [], []
    for rtol in (1e-3, 1e-4):
        experiment = Experiment(TIMES, ("left.x", "right.x_r"))
        record = cosimulate(oscillators(), experiment, step=0.1, order=order, doubling=Doubling(rtol=rtol))
        found.append(np.abs(record.values[:, :2] - known).max())
        parts.append(record.statistics["parts"])
    # The tolerance is of one step: the error of a run goes with it to the power p/(p+1), the number with -1/(p+1).
    p = order.accuracy
    assert np.log10(found[0] / found[1]) == pytest.approx(p / (p + 1), abs=0.25)
    assert np.log10(parts[1] / parts[0]) == pytest.approx(1 / (p + 1), abs=0.15)


def test_small_steps_lie_where_they_are_needed() -> None:
    ends = []

    class Watching(Linear):
        def step(self, time: float, end: float) -> float:
            ends.append(end)
            return super().step(time, end)

    follower = Watching("f", (Port("u"),), (Port("y"),), A=[[-50.0]], B=[[50.0]], C=[[1.0]])
    other = Linear("o", (Port("u"),), (Port("y"),), A=[[-1.0]], B=[[1.0]], C=[[1.0]])
    system = System((follower, other), (Connection("f.y", "o.u"),))
    experiment = Experiment(np.linspace(0, 4, 9), ("o.y",), {"f.u": Signal.steps([0, 2.0], [0, 1.0])})
    cosimulate(system, experiment, step=0.5, doubling=Doubling(rtol=1e-3))
    near, far = (sum(low < end <= low + 0.5 for end in ends) for low in (2.0, 1.0))
    assert near > 20 * far
    exact = np.array(ends) / 0.5 * 2**13
    assert np.array_equal(exact, np.round(exact))


def test_a_tolerance_out_of_reach_stops_the_run() -> None:
    experiment = Experiment(TIMES, ("left.x",))
    with pytest.raises(SimulationError, match=r"its error stays above rtol = 1e-12 with steps of 0\.025 s") as caught:
        cosimulate(oscillators(), experiment, step=0.1, doubling=Doubling(rtol=1e-12, halvings=2))
    assert caught.value.record.outcome is Outcome.STEP_TOO_SMALL


def test_settings_are_checked() -> None:
    for settings in ({"rtol": 0.0}, {"rtol": float("nan")}, {"halvings": -1}, {"halvings": 99}):
        with pytest.raises(BadInput, match="doubling: rtol"):
            Doubling(**settings)
