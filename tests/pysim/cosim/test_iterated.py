"""Iterated steps: stability where held inputs have none, exactness on lines, and the limit."""

import numpy as np
import pytest

from pysim.cosim import Connection, GaussSeidel, Iterated, Jacobi, Order, System, cosimulate
from pysim.types import BadInput, Experiment, Outcome, Port, SimulationError
from tests.cosim_parts import Linear


def stiff(gain: float, before: str = "") -> System:
    """dx/dt = -gain x, cut in two: one member integrates, the other gives the rate at once. Released from 1."""
    state = Linear(f"{before}state", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]], x0=[1.0])
    law = Linear(f"{before}law", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[0.0]], C=[[0.0]], D=[[-gain]])
    lines = Connection(f"{before}state.y", f"{before}law.u"), Connection(f"{before}law.y", f"{before}state.u")
    return System((state, law), lines)


def test_stiff_coupling_is_stable() -> None:
    """With steps of ten time constants, the trapezoidal rule's factor is (1 - 5)/(1 + 5), and that of holding -9."""
    experiment = Experiment(np.linspace(0, 4, 5), ("state.y",))
    held = cosimulate(stiff(10.0), experiment, step=1.0, order=Jacobi())
    assert held["state.y"] == pytest.approx((-9.0) ** np.arange(5))
    found = cosimulate(stiff(10.0), experiment, step=1.0, order=Iterated())
    assert found["state.y"] == pytest.approx((-4 / 6) ** np.arange(5), rel=1e-6)


def test_the_tolerance_is_met_and_counted() -> None:
    experiment = Experiment(np.linspace(0, 4, 5), ("state.y",))
    loose, tight = (cosimulate(stiff(0.5), experiment, step=1.0, order=Iterated(rtol=r)) for r in (1e-2, 1e-12))
    assert tight["state.y"] == pytest.approx((0.75 / 1.25) ** np.arange(5), rel=1e-11)
    assert loose["state.y"] == pytest.approx(tight["state.y"], abs=5e-2)
    assert loose.statistics["iterations"] <= tight.statistics["iterations"]


def test_the_limit_stops_the_run() -> None:
    experiment = Experiment(np.linspace(0, 4, 5), ("state.y",))
    with pytest.raises(
        SimulationError, match=r"t = 0 s: (state|law): .* after 2 evaluations of a step of 1 s"
    ) as caught:
        cosimulate(stiff(10.0), experiment, step=1.0, order=Iterated(limit=2))
    assert caught.value.record.outcome is Outcome.NOT_CONVERGED


def test_what_still_moves_is_named_and_nothing_beside_it() -> None:
    quiet, moving = stiff(0.01, "quiet_"), stiff(10.0)
    system = System((*quiet.members, *moving.members), (*quiet.connections, *moving.connections))
    with pytest.raises(SimulationError, match=r"t = 0 s: (state|law): \1\.y still changes by"):
        cosimulate(system, Experiment(np.linspace(0, 1, 2), ("state.y",)), step=1.0, order=Iterated(limit=2))


@pytest.mark.parametrize("order", [Jacobi(lines=True), GaussSeidel(lines=True), Iterated()], ids=str)
@pytest.mark.parametrize("takes_rates", [False, True])
def test_a_ramp_is_integrated_exactly(order: Order, takes_rates: bool) -> None:
    ramp = Linear("ramp", (), (Port("y"),), A=[[0.0, 1.0], [0.0, 0.0]], B=np.zeros((2, 0)), C=[[1.0, 0.0]], x0=[1, 2])
    more = {"takes_rates": takes_rates}
    sum_ = Linear("sum", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]], **more)
    system = System((sum_, ramp), (Connection("ramp.y", "sum.u"),))
    times = np.linspace(0, 2, 21)
    record = cosimulate(system, Experiment(times, ("sum.y",)), step=0.1, order=order)
    off = 0.01 if order == Jacobi(lines=True) else 0.0  # its first step has nothing to extrapolate from
    assert record["sum.y"][2:] == pytest.approx((times + times**2 - off)[2:], abs=1e-12)


def test_settings_are_checked() -> None:
    for settings in ({"rtol": 0.0}, {"limit": 0}):
        with pytest.raises(BadInput, match="iterated: rtol"):
            Iterated(**settings)
