"""A controller that is a plain class: its ports, its units, its state, and the loop it closes."""

from collections import deque
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import pysim
import pysim.control
from pysim.cosim import Sampled
from pysim.cosim.plain import PlainBlock
from pysim.nouns.model import Model
from pysim.types import BadInput, SimulationError

DT = 1e-2
WIRES = {"mass.x": "pi.measured", "pi.u": "mass.F"}
STEP = {"pi.reference": [(0, 0), (0.1, 0.2)]}


class PI:
    def __init__(self, K_p: float, T_i: float, dt: float) -> None:
        self.K_p, self.T_i, self.dt, self.integral = K_p, T_i, dt, 0.0

    def step(self, t: float, reference: float, measured: float) -> float:
        error = reference - measured
        self.integral += error * self.dt / self.T_i
        return self.K_p * (error + self.integral)


def closed(mass: Model, controller: Any, **more: Any) -> pysim.nouns.run.Run:  # type: ignore[name-defined]
    given = {"dt": DT, "stop": 2.0, "wires": WIRES, "inputs": STEP, **more}
    return pysim.cosimulate({"mass": mass.set(d=8.0), "pi": controller}, **given)


def test_it_runs_as_the_block_with_ports_does(mass: Model) -> None:
    """pysim.control.PI has the same law, with ports and state written out."""
    plain = closed(mass, PI(20.0, 0.5, DT))
    block = Sampled("pi", pysim.control.PI(K_p=20.0, T_i=0.5, dt=DT, unit="m", output_unit="N"), DT)
    assert plain["mass.x"] == pytest.approx(closed(mass, block)["mass.x"], abs=2e-3)
    assert plain["mass.x"][-1] > 0.05
    assert plain.record.units[plain.record.names.index("pi.u")] == "N"
    assert len(repr(plain)) < 2000


def test_a_second_run_begins_where_the_first_did(mass: Model) -> None:
    """What its owner sets between two runs stays set; the integral of the first run is gone, and can be read before."""
    controller = PI(20.0, 0.5, DT)
    first = closed(mass, controller)
    assert controller.integral != 0.0
    assert closed(mass, controller)["pi.u"] == pytest.approx(first["pi.u"], abs=0.0)
    controller.K_p = 10.0
    assert closed(mass, controller)["pi.u"] == pytest.approx(closed(mass, PI(10.0, 0.5, DT))["pi.u"], abs=0.0)
    controller.integral = 0.3
    begun = PI(10.0, 0.5, DT)
    begun.integral = 0.3
    assert closed(mass, controller)["pi.u"] == pytest.approx(closed(mass, begun)["pi.u"], abs=0.0)


def test_units_come_from_the_wires() -> None:
    block = PlainBlock("pi", PI(1.0, 1.0, DT), ["u"], {"measured": "m", "u": "N"})
    assert [(p.name, p.unit, p.start) for p in block.inputs] == [("reference", "1", None), ("measured", "m", None)]
    assert [(p.name, p.unit) for p in block.outputs] == [("u", "N")]


class Delay:
    """Rows, whole numbers, a switch, a log, and a name."""

    def __init__(self) -> None:
        self.line = deque([0.0, 0.0], maxlen=2)
        self.matrix = np.zeros((2, 2))
        self.count, self.on, self.log, self.name = 0, False, list[float](), "delay"

    def step(self, t: float, x: float, gain: float = 2.0) -> dict[str, float]:
        y = self.line[0]
        self.line.append(x)
        self.matrix[0, 1] += x
        self.count, self.on = self.count + 1, not self.on
        self.log.append(t)
        return {"y": gain * y, "n": self.count}


def test_its_state_is_kept_and_brought_back_as_what_it_was() -> None:
    one = Delay()
    block = PlainBlock("delay", one, ["n", "y"], {})
    begin = block.state()
    outputs = [block.step(0.1 * k, (float(k + 1), 2.0)) for k in range(4)]
    assert outputs == [(1.0, 0.0), (2.0, 0.0), (3.0, 2.0), (4.0, 4.0)]
    block.restore(begin)
    assert (one.count, one.on, list(one.line), one.line.maxlen) == (0, False, [0.0, 0.0], 2)
    assert isinstance(one.count, int)
    assert isinstance(one.on, bool)
    assert one.matrix.shape == (2, 2)
    assert not one.matrix.any()
    assert [block.step(0.1 * k, (float(k + 1), 2.0)) for k in range(4)] == outputs
    assert len(one.log) == 8  # a log is no state
    assert block.inputs[1].start == 2.0


class Growing:
    def __init__(self) -> None:
        self.row = [0.0]

    def step(self, t: float, x: float) -> float:
        self.row.append(x)
        return x


@dataclass(slots=True)
class Slotted:
    gain: float

    def step(self, t: float, reference: float, measured: float) -> float:
        return self.gain * (reference - measured)


@pytest.mark.parametrize(
    ("members", "more", "said"),
    [
        ({"pi": 3.0}, {}, "no step"),
        ({"pi": type("All", (), {"step": lambda self, t, *rest: 0.0})()}, {}, "name each input"),
        ({"pi": Slotted(2.0)}, {}, "without them"),
        ({"pi": PI(1.0, 1.0, DT)}, {"wires": {"mass.y": "pi.measured", "pi.u": "mass.F"}}, "mass.y"),
        ({"pi": PI(1.0, 1.0, DT)}, {"inputs": {}}, "reference"),
        ({"pi": PI(1.0, 1.0, 0.3 * DT)}, {}, "whole number"),
        ({"pi": PI(1.0, 1.0, DT)}, {"stop": 0.0}, "stop"),
        ({"pi": PI(1.0, 1.0, DT)}, {"stop": "1"}, "stop: '1' is no number"),
        ({"pi": PI(1.0, 1.0, DT)}, {"wires": [("mass.x", "pi.measured")]}, "wires: a list has no names"),
    ],
)
def test_mistakes_are_refused_with_a_cure(mass: Model, members: dict, more: dict, said: str) -> None:  # type: ignore[type-arg]
    with pytest.raises(BadInput, match=said):
        pysim.cosimulate({"mass": mass, **members}, **{"dt": DT, "stop": 1.0, "wires": WIRES, "inputs": STEP, **more})


def test_a_row_that_grows_is_no_state() -> None:
    one = Growing()
    block = PlainBlock("row", one, ["y"], {})
    block.step(0.0, (1.0,))
    with pytest.raises(BadInput, match="a row of 1 and is a row of 2"):
        block.state()


def test_a_controller_that_fails_says_when(mass: Model) -> None:
    class Broken(PI):
        def step(self, t: float, reference: float, measured: float) -> float:
            return 1 / 0.0 if t > 0.5 else 0.0

    with pytest.raises(SimulationError, match="pi"):
        closed(mass, Broken(1.0, 1.0, DT))
    assert closed(mass, Broken(1.0, 1.0, DT), check=False).time[-1] == pytest.approx(0.5, abs=2 * DT)


def test_inputs_that_nothing_drives_keep_their_start(mass: Model) -> None:
    run = pysim.cosimulate({"a": mass, "b": mass.set(m=2.0)}, dt=DT, stop=0.1, wires={}, inputs={"a.F": 1.0})
    assert run["a.x"][-1] > 0
    assert np.all(run["b.x"] == 0.0)


class Two:
    """A controller with two outputs."""

    def step(self, t: float, measured: float) -> dict[str, float]:
        return {"u": -measured, "v": 1.0}


def test_a_forgotten_wire_of_a_controller_is_said_with_its_cure(mass: Model) -> None:
    """Without it the plant would stay at rest, and all numbers be zeros."""
    inputs = {"pi.reference": 0.1}
    with pytest.raises(BadInput, match=r"pi\.u goes nowhere, so pi does nothing; connect it to .*mass\.F.* record"):
        closed(mass, PI(20.0, 0.5, DT), wires={"mass.x": "pi.measured"}, inputs=inputs)
    meant = closed(mass, PI(20.0, 0.5, DT), wires={"mass.x": "pi.measured"}, inputs=inputs, record=["mass.x", "pi.u"])
    assert meant["pi.u"][-1] != 0.0
    assert not meant.warnings


def test_an_output_beside_an_input_that_nothing_drives_is_a_warning(mass: Model) -> None:
    two = Two()
    two.outputs = ["u", "v"]  # type: ignore[attr-defined]
    members = {"mass": mass, "other": mass, "two": two}
    wires = {"mass.x": "two.measured", "two.u": "mass.F"}
    run = pysim.cosimulate(members, dt=DT, stop=0.1, wires=wires)
    (said,) = run.warnings
    assert said.startswith("two.v goes nowhere and nothing drives other.F")
    assert "'two.v': 'other.F'" in said
    assert f"! {said}" in repr(run)
    assert not pysim.cosimulate(members, dt=DT, stop=0.1, wires={**wires, "two.v": "other.F"}).warnings
    assert not pysim.cosimulate(members, dt=DT, stop=0.1, wires=wires, inputs={"other.F": 0.0}).warnings
