"""A controller that is a plain class: its ports, its units, its state, and the loop it closes."""

import re
import reprlib
from collections import deque
from dataclasses import dataclass, replace
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np
import pytest

import pysim
import pysim.control
from pysim.cosim import Run, Sampled, System
from pysim.cosim.plain import PlainBlock
from pysim.nouns.model import Model
from pysim.types import BadInput, Experiment, Signal, SimulationError
from tests.pysim.simulate.text_models import text_model

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


class Remembering:
    """Remembers in a dictionary, in what was nothing at first, in a row that grows, and by a `restore` that lies."""

    count = 0

    def __init__(self) -> None:
        self.held, self.last, self.log = {"sum": [0.0]}, None, list[float]()

    def restore(self, state: object) -> None:
        """Bring nothing back."""

    def step(self, t: float, reference: float, measured: float) -> float:
        self.held["sum"][0] += reference - measured
        self.last = measured if self.last is None else 0.5 * (self.last + measured)
        self.count += 1
        self.log.append(t)
        return self.held["sum"][0] - self.last + self.count  # type: ignore[no-any-return]


def test_a_run_leaves_the_controller_as_it_is_and_gives_what_it_made_of_it(mass: Model) -> None:
    controller = Remembering()
    first, second = closed(mass, controller), closed(mass, controller)
    assert np.array_equal(first["pi.u"], second["pi.u"])
    assert (controller.held, controller.last, controller.count) == ({"sum": [0.0]}, None, 0)
    assert first.controllers["pi"].count == first.time.size
    assert first.controllers["pi"].log == pytest.approx(first.time)
    controller.held["sum"][0] = 0.3
    begun = Remembering()
    begun.held["sum"][0] = 0.3
    assert np.array_equal(closed(mass, controller)["pi.u"], closed(mass, begun)["pi.u"])


class Cascade(pysim.control.Gain):
    """A block with ports, and a controller within it."""

    controller = "inner"


def test_a_block_is_given_back_whole() -> None:
    cascade = Cascade(2.0)
    run = pysim.cosimulate({"c": cascade}, dt=DT, stop=DT, wires={}, inputs={"c.u": 1.0}, record=["c.y"])
    assert run.controllers["c"] == cascade


def test_one_object_as_two_members_is_two_controllers(mass: Model) -> None:
    """Both see the same, so that both do the same."""
    one = PI(20.0, 0.5, DT)
    members = {"a": mass, "b": mass, "p": one, "q": one}
    wires = {"a.x": "p.measured", "p.u": "a.F", "b.x": "q.measured", "q.u": "b.F"}
    inputs = {"p.reference": 0.1, "q.reference": 0.1}
    run = pysim.cosimulate(members, dt=DT, stop=1.0, wires=wires, inputs=inputs)
    assert np.array_equal(run["p.u"], run["q.u"])
    assert np.ptp(run["p.u"]) > 0.1


def test_a_controller_that_cannot_be_copied_is_refused(mass: Model) -> None:
    controller = PI(1.0, 1.0, DT)
    controller.lock = Lock()  # type: ignore[attr-defined]
    with pytest.raises(BadInput, match=r"pi: it cannot be copied.*lock.*open files and connections in step"):
        closed(mass, controller)


def test_units_come_from_the_wires_and_an_output_has_its_own(mass: Model) -> None:
    """The angle comes in rad and goes out in deg, by one name; two members take it."""

    class Turn:
        def step(self, t: float, angle: float) -> dict[str, float]:
            return {"angle": np.degrees(angle)}

    angles = Sampled("plant", pysim.control.Gain(1.0, unit="rad", output_unit="rad"), DT)
    drives = [Sampled(n, pysim.control.Gain(1.0, unit="deg", output_unit="deg"), DT) for n in ("drive", "other")]
    run = pysim.cosimulate(
        {"plant": angles, "turn": Turn(), "drive": drives[0], "other": drives[1]},
        dt=DT,
        stop=DT,
        wires={"plant.y": "turn.angle", "turn.angle": ["drive.u", "other.u"]},
        inputs={"plant.u": np.pi},
        record=["turn.angle", "drive.y", "other.y"],
    )
    assert run.record.units == ("deg", "deg", "deg")
    assert run.record.values[-1] == pytest.approx(180.0)


class Delay:
    """Rows, whole numbers, a switch and a log."""

    def __init__(self) -> None:
        self.line = deque([0.0, 0.0], maxlen=2)
        self.count, self.on, self.log = 0, False, list[float]()

    def step(self, t: float, x: float, gain: float = 2.0) -> dict[str, float]:
        y = self.line[0]
        self.line.append(x)
        self.count, self.on = self.count + 1, not self.on
        self.log.append(t)
        return {"y": gain * y, "n": self.count + 10.0 * self.on}


def test_a_run_that_goes_back_brings_all_of_it_back() -> None:
    """Its outputs are those of two samples ago, twice, and how many there were, with 10 at every other."""
    block = PlainBlock("delay", Delay(), {}, {"n": "1", "y": "1"})
    system = System((Sampled("delay", block, 0.1),))
    ramp, times = Signal.lines([0, 1], [1.0, 11.0]), 0.1 * np.arange(11)
    known = np.column_stack([np.arange(1, 12) + 10 * (np.arange(11) % 2 == 0), np.append([0, 0], 2 * np.arange(1, 10))])
    with Run(system, Experiment(times, ("delay.n", "delay.y"), {"delay.x": ramp}), step=0.1) as run:
        run.advance(0.3)
        kept = run.save()
        for _ in range(2):
            run.advance()
            assert run.record().values == pytest.approx(known)
            assert run.blocks["delay"].controller.log == pytest.approx(times)  # type: ignore[attr-defined]
            run.restore(kept)
    assert block.inputs[1].start == 2.0


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
        ({"pi": PI}, {}, r"pi: PI is a class; give an object of it, PI\(...\)"),
        ({"pi": lambda: 0.0}, {}, "takes no time"),
        ({"pi": max}, {}, "pi: its step does not tell its arguments .*call it in a function of your own"),
        ({"pi": PI(1.0, 1.0, DT)}, {"dt": 0.03}, "no whole number of steps of 0.03 s"),
        ({"pi": PI(1.0, 1.0, DT)}, {"wires": {"mass.y": "pi.measured", "pi.u": "mass.F"}}, "mass.y"),
        ({"pi": PI(1.0, 1.0, DT)}, {"inputs": {}}, "reference"),
        ({"pi": PI(1.0, 1.0, 0.3 * DT)}, {}, "whole number"),
        ({"pi": PI(1.0, 1.0, DT)}, {"stop": 0.0}, "stop"),
        ({"pi": PI(1.0, 1.0, DT)}, {"stop": np.inf}, "stop = inf s is no whole number of steps"),
        ({"pi": PI(1.0, 1.0, DT)}, {"stop": "1"}, "stop: '1' is no number"),
        ({"pi": PI(1.0, 1.0, DT)}, {"wires": [("mass.x", "pi.measured")]}, "wires: a list has no names"),
    ],
)
def test_mistakes_are_refused_with_a_cure(mass: Model, members: dict, more: dict, said: str) -> None:  # type: ignore[type-arg]
    with pytest.raises(BadInput, match=said):
        pysim.cosimulate({"mass": mass, **members}, **{"dt": DT, "stop": 1.0, "wires": WIRES, "inputs": STEP, **more})


@pytest.mark.parametrize(
    "controller",
    [
        lambda t, reference, measured: 2.0 * (reference - measured),
        lambda t, reference, measured: np.array(2.0 * (reference - measured)),
        lambda t, reference, measured: np.array([[2.0 * (reference - measured)]]),
        lambda t, reference, measured: [2.0 * (reference - measured)],
        Slotted(2.0),
    ],
)
def test_a_function_is_a_controller_and_an_array_of_one_is_a_number(mass: Model, controller: Any) -> None:
    """m x'' + d x' + (k + 2) x = 2 r, where the force is held: it comes to rest at 2 r / (k + 2)."""
    run = closed(mass, controller, stop=8.0)
    assert run["mass.x"][-1] == pytest.approx(2.0 * 0.2 / (20.0 + 2.0), rel=1e-3)


@pytest.mark.parametrize("given", [None, "5", (1.0, 2.0), [None], {"v": 1.0}, "five"])
def test_what_is_no_number_is_refused_with_its_cure(mass: Model, given: object) -> None:
    cure = "end it with return and a number, u"
    with pytest.raises(pysim.SimulationError, match=re.escape(f"{reprlib.repr(given)}; {cure}")) as caught:
        closed(mass, lambda t, reference, measured: given)
    assert caught.value.record.time.size == 0


def test_several_outputs_have_their_names_from_the_controller(mass: Model) -> None:
    """Those of a row are the order of its own `outputs`; the order of wires says nothing."""

    def row(t: float, measured: float) -> tuple[float, float]:
        return 1.0, -2.0

    members = {"mass": mass, "other": mass, "two": row}
    wires = {"mass.x": "two.measured", "two.v": "other.F", "two.u": "mass.F"}
    with pytest.raises(SimulationError, match="return and a dictionary of numbers, v, u"):
        pysim.cosimulate(members, dt=DT, stop=0.1, wires=wires)
    row.outputs = ["u", "v"]  # type: ignore[attr-defined]
    run = pysim.cosimulate(members, dt=DT, stop=0.1, wires=wires)
    assert (run["two.u"][-1], run["two.v"][-1]) == (1.0, -2.0)


@pytest.mark.parametrize("kept", [1.0, np.zeros(3), [0.0, 1.0], "speed", ("speed",)])
def test_what_a_controller_keeps_as_its_outputs_is_its_own_but_for_names(kept: object) -> None:
    def double(t: float, x: float) -> float:
        return 2.0 * x

    double.outputs = kept  # type: ignore[attr-defined]
    members, wires = {"c": double, "g": lambda t, x: x}, {"c.speed": "g.x"}
    run = pysim.cosimulate(members, dt=DT, stop=DT, wires=wires, inputs={"c.x": 1.0}, record=["g.u"])
    assert run["g.u"][-1] == 2.0


def test_a_fast_function_drives_a_long_run(mass: Model) -> None:
    """It was looked at 2001 times, which of this one saw zeros alone."""
    run = pysim.cosimulate(
        {"a": mass}, dt=0.02, stop=600.0, wires={}, inputs={"a.F": lambda t: np.sin(10 * np.pi * t)}, record=["a.F"]
    )
    assert run["a.F"] == pytest.approx(np.sin(10 * np.pi * run.time), abs=1e-9)


def test_a_function_that_jumps_is_a_step(mass: Model) -> None:
    """The same as pairs, also at 0.29 s, which is 29*0.01 but for its last digit."""
    pairs = [(0.0, 0.0), (0.1, 1.0), (0.29, -2.0)]
    runs = [
        pysim.cosimulate({"a": mass}, dt=DT, stop=1.0, wires={}, inputs={"a.F": one})
        for one in (pairs, lambda t: 0.0 if t < 0.1 else 1.0 if t < 0.29 else -2.0)
    ]
    assert runs[0]["a.x"] == pytest.approx(runs[1]["a.x"], abs=1e-12)
    assert np.ptp(runs[0]["a.x"]) > 0.01


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


def test_an_input_that_is_a_text_stays_as_it_is(mass: Model) -> None:
    compiled = mass.compiled
    note = replace(compiled["F"], name="note", reference=10**6, type="String", start=None)
    texted = replace(compiled, variables=(*compiled.variables, note))
    runs = [pysim.cosimulate({"a": one}, dt=DT, stop=0.1, wires={}, inputs={"a.F": 1.0}) for one in (texted, mass)]
    assert np.array_equal(runs[0]["a.x"], runs[1]["a.x"])


def test_a_wire_goes_before_the_rate_of_a_driven_input(tmp_path: Path) -> None:
    """Its name alone makes p_t the rate of p, which is 2 here; the wire brings 3."""
    text = """model Rated
  input Real p(start=0);
  input Real p_t(start=0);
  output Real y(start=0, fixed=true);
equation
  der(y) = p_t;
end Rated;
"""
    given = {"dt": 0.1, "stop": 1.0, "inputs": {"m.p": lambda t: 2 * t}}
    members = {"m": text_model(text, tmp_path), "c": lambda t: 3.0}
    assert pysim.cosimulate(members, wires={"c.u": "m.p_t"}, **given)["m.y"][-1] == pytest.approx(3.0)
    assert pysim.cosimulate({"m": members["m"]}, wires={}, **given)["m.y"][-1] == pytest.approx(2.0)


@pytest.mark.parametrize(("stop", "count"), [(0.7, 1), (25.0, 25), (250.0, 100)])
def test_a_run_says_how_far_it_is(stop: float, count: int) -> None:
    """Every thousand steps, and a hundred times at most."""
    told: list[Any] = []
    gain = Sampled("g", pysim.control.Gain(2.0), 1e-3)
    run = pysim.cosimulate(
        {"g": gain}, dt=1e-3, stop=stop, wires={}, inputs={"g.u": 1.0}, record=["g.y"], progress=told.append
    )
    assert len(told) == count
    assert told[-1].stage == f"at {stop:g} of {stop:g} s"
    assert run["g.y"][-1] == 2.0


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
