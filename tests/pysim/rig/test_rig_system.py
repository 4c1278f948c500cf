from collections.abc import Sequence

import numpy as np
import pytest

from pysim.control import CompensatedLoadController
from pysim.cosim import Connection, cosimulate
from pysim.cosim.members import Fmu
from pysim.rig import HeaveTest, StepTest, rig_member, rig_system
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Experiment, Port, Record
from tests.pysim.rig.rigs import model

FINE = Rodas(rtol=1e-7, atol=1e-7)
TEST = StepTest("load", 40e5, speed=30.0, at=1.2, length=0.8)


def test_it_is_the_monolithic_rig_sample_by_sample() -> None:
    """Controllers in Python against their Modelica twins inside the model; the solvers' steps differ."""
    run = TEST.experiment()
    found = cosimulate(rig_system(rig_member(model("LoadCircuit.Rig"), solver=FINE)), run, step=1e-3)
    names = ("rig.omega", "rig.pL", "rig.pS", "speed.alphaCMD", "load.u_ref")
    inputs = {"omegaS_ref": TEST.reference("speed"), "pL_ref": TEST.reference("load")}
    whole = simulate(model("LoadCircuit.SampledTestBench"), Experiment(run.times, names, inputs), solver=FINE)
    for name in names:
        scale = np.abs(whole[name]).max()
        assert np.abs(found[name] - whole[name]).max() < 1e-4 * scale, name
        assert scale > 0


def crane_run(**options: object) -> Record:
    system = rig_system(
        rig_member(model("LoadCircuit.Rig")),
        crane=Fmu("crane", model("Crane.IdealCompensation")),
        **options,  # type: ignore[arg-type]
    )
    return cosimulate(system, HeaveTest(length=2.0, rest=1.0, settle=1.0).experiment(), step=1e-3)


def test_a_crane_gives_the_references() -> None:
    record = crane_run()
    wanted = -HeaveTest(rest=1.0).velocity().value(record.time) / 0.03  # Eq. 5.50, drum of 30 mm
    assert record["crane.omegaS_ref"] == pytest.approx(wanted, abs=1e-9)
    held = record["crane.pL_ref"][record.time > 0.5]
    assert held == pytest.approx(np.full(held.size, held[0]), rel=1e-3)  # the payload stands still, Eq. 5.51
    assert held[0] == pytest.approx((390 - 1025 * 0.05) * 9.81 * 0.03 * 2 * np.pi / 60e-6, rel=1e-3)
    feed = record["speed.alphaCMD"] / 100 * 71e-6 * 1450 / 60 * 2 * np.pi / 60e-6
    assert np.corrcoef(feed, wanted)[0, 1] > 0.99


def test_other_controllers_and_another_feed_forward() -> None:
    compensated = crane_run(load=CompensatedLoadController(1e-3), feed="true")
    assert not np.allclose(compensated["load.u_ref"], crane_run()["load.u_ref"], atol=1e-4)
    late = crane_run(delay=5e-3)
    first = np.flatnonzero(crane_run()["load.u_ref"])[0]
    assert np.flatnonzero(late["load.u_ref"])[0] - first == pytest.approx(2.5, abs=0.6)  # rows of 2 ms


class OwnLoadController:
    """A feed forward that knows the pressure drop; nothing of the thesis' classes."""

    inputs = (Port("reference", "Pa"), Port("measured", "Pa"), Port("speed", "rad/s"), Port("supply", "Pa"))
    outputs = (Port("u_ref", "1"), Port("pi", "1"))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, float]:
        _, measured, speed, supply = inputs
        return speed * 1e-3 * (supply - measured) / 300e5, 0.0


def test_an_own_load_controller_is_told_the_supply_pressure() -> None:
    rig, crane = rig_member(model("LoadCircuit.Rig")), Fmu("crane", model("Crane.IdealCompensation"))
    wires = rig_system(rig, load=OwnLoadController(), crane=crane).connections
    assert Connection("rig.pSupply", "load.supply") in wires
    assert Connection("rig.pSupply", "load.supply") not in rig_system(rig, crane=crane).connections


def test_misuse_is_told() -> None:
    rig, crane = rig_member(model("LoadCircuit.Rig")), Fmu("crane", model("Crane.IdealCompensation"))
    with pytest.raises(BadInput, match="'reference', 'measured' or 'true'"):
        rig_system(rig, feed="guessed")  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="call it 'rig'"):
        rig_system(crane)
    with pytest.raises(BadInput, match="make both one"):
        rig_system(rig, load=CompensatedLoadController(2e-3))
