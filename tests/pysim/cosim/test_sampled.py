"""Sampled blocks: rate, delay and hold, to one sample."""

import re
from collections.abc import Sequence
from threading import Lock

import numpy as np
import pytest

from pysim.control import PI, Gain
from pysim.cosim import Connection, Run, Sampled, System, cosimulate
from pysim.types import BadInput, Experiment, Outcome, Port, Signal, SimulationError
from tests.cosim_parts import Linear


class Clock:
    """Its own time, squared, and what it read."""

    inputs = (Port("u"),)
    outputs = (Port("y", start=-1.0), Port("read"))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, float]:
        return time**2, inputs[0]


def run(sampled: Sampled, *, step: float, end: float = 1.0, start: float = 0.0) -> dict[str, np.ndarray]:
    times = start + step * np.arange(round(end / step) + 1)
    experiment = Experiment(times, ("c.y", "c.read"), {"c.u": Signal.lines([start, start + 10], [0, 10])}, start=start)
    record = cosimulate(System((sampled,)), experiment, step=step)
    return {"time": times, "y": record["c.y"], "read": record["c.read"]}


@pytest.mark.parametrize("start", [0.0, -3.0, 17.3])
def test_a_block_is_stepped_at_its_rate(start: float) -> None:
    found = run(Sampled("c", Clock(), every=0.03), step=0.01, start=start)
    ticks = np.arange(found["time"].size) // 3 * 3
    assert found["y"] == pytest.approx((start + ticks * 0.01) ** 2, rel=1e-12)
    assert found["read"] == pytest.approx(ticks * 0.01, abs=1e-12)


@pytest.mark.parametrize("late", [1, 3, 7])
def test_a_delay_is_a_number_of_steps(late: int) -> None:
    found = run(Sampled("c", Clock(), every=0.03, delay=late * 0.01), step=0.01)
    ticks = (np.arange(found["time"].size) - late) // 3 * 3
    assert found["y"] == pytest.approx(np.where(ticks < 0, -1.0, (ticks * 0.01) ** 2), rel=1e-12)


def test_first_order_hold_runs_on_along_its_line() -> None:
    found = run(Sampled("c", Clock(), every=0.05, hold=1), step=0.01)
    tick = np.arange(found["time"].size)
    sample = tick // 5 * 5
    last, before = (sample * 0.01) ** 2, (np.maximum(sample - 5, 0) * 0.01) ** 2
    assert found["y"] == pytest.approx(last + (tick - sample) / 5 * (last - before), rel=1e-12, abs=1e-15)
    assert found["read"] == pytest.approx(tick * 0.01, abs=0.05 + 1e-9)


def test_a_controller_on_a_plant_is_its_difference_equation() -> None:
    plant = Linear("plant", (Port("u"),), (Port("y"),), A=[[-2.0]], B=[[1.0]], C=[[1.0]])
    wires = (Connection("plant.y", "c.measured"), Connection("c.u", "plant.u"))
    system = System((plant, Sampled("c", PI(3.0, 0.4, 0.02), every=0.02)), wires)
    times = np.arange(0, 401) * 0.005
    drive = {"c.reference": Signal.steps([0, 0.1], [0, 1.0])}
    record = cosimulate(system, Experiment(times, ("plant.y", "c.u"), drive), step=0.005)
    y, u, error, known = 0.0, 0.0, None, []
    for tick in range(401):
        if tick % 4 == 0:
            now = (1.0 if tick >= 20 else 0.0) - y
            before = now if error is None else error
            u, error = u + 3.0 * (now - before) + 3.0 * 0.02 / 0.4 * before, now
        known.append((y, u))
        y = np.exp(-0.01) * y + (1 - np.exp(-0.01)) / 2 * u
    assert record.values == pytest.approx(np.array(known), rel=1e-9, abs=1e-12)


def test_a_run_forgets_the_one_before() -> None:
    system = System((Sampled("c", PI(1.0, 1.0, 0.1), every=0.1),))
    experiment = Experiment(
        np.linspace(0, 1, 11), ("c.u",), {"c.reference": Signal.constant(1.0), "c.measured": Signal.constant(0.0)}
    )
    first, second = (cosimulate(system, experiment, step=0.1).values for _ in range(2))
    assert np.array_equal(first, second)
    assert first[-1] > 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"every": 0.0}, "every = 0.0 s"),
        ({"every": 0.1, "delay": -0.1}, "delay = -0.1 s"),
        ({"every": 0.1, "hold": 2}, "hold is 2; give 0 or 1"),
    ],
)
def test_settings_are_checked(arguments: dict[str, float], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        Sampled("c", Gain(1.0), **arguments)  # type: ignore[arg-type]


def test_a_block_made_for_another_rate_is_refused() -> None:
    with pytest.raises(BadInput, match=r"the block has dt = 0.01 s but is sampled every 0.02 s"):
        Sampled("c", PI(1.0, 1.0, 0.01), every=0.02)
    with pytest.raises(BadInput, match="has no 'inputs'"):
        Sampled("c", object(), every=0.02)  # type: ignore[arg-type]
    bare = Gain(1.0)
    bare.inputs = ("u",)  # type: ignore[assignment]
    with pytest.raises(BadInput, match="c: its port 'u' is no Port; write Port"):
        Sampled("c", bare, every=0.02)


@pytest.mark.parametrize(("every", "delay"), [(0.015, 0.0), (0.02, 0.005), (0.001, 0.0)])
def test_rates_are_whole_numbers_of_steps(every: float, delay: float) -> None:
    with pytest.raises(BadInput, match=r"no whole number of steps of 0.01 s"):
        run(Sampled("c", Clock(), every=every, delay=delay), step=0.01)


class Failing(Clock):
    """Goes wrong at 0.25 s, in one of several ways."""

    def __init__(self, way: str) -> None:
        self.way = way

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, ...]:  # type: ignore[override]
        if time < 0.2499:
            return 1.0, 2.0
        return {
            "raise": lambda: 1 // 0,
            "nan": lambda: (1.0, float("nan")),
            "few": lambda: (1.0,),
            "text": lambda: "ab",
            "number": lambda: 3.0,
        }[self.way]()


@pytest.mark.parametrize(
    ("way", "words"),
    [
        ("raise", r"t = 0.25 s: c: ZeroDivisionError: integer .* by zero \(test_sampled\.py, line \d+\)$"),
        ("nan", "t = 0.25 s: c: its step returned read = nan"),
        ("few", "t = 0.25 s: c: its step returned 1 value for 2 outputs"),
        ("text", "t = 0.25 s: c: TypeError"),
        ("number", r"t = 0.25 s: c: its step returned the number 3\.0; let it return \(y, read\)"),
    ],
)
def test_a_block_that_goes_wrong_is_named(way: str, words: str) -> None:
    with pytest.raises(SimulationError, match=words) as caught:
        run(Sampled("c", Failing(way), every=0.05), step=0.01)
    record = caught.value.record
    assert record.time[-1] == pytest.approx(0.24)
    assert record.outcome is (Outcome.NOT_FINITE if way == "nan" else Outcome.MODEL_ERROR)


class Constant:
    """Returns what it was given."""

    inputs, outputs = (), (Port("u"),)

    def __init__(self, row: object) -> None:
        self.row = row

    def step(self, time: float, inputs: Sequence[float]) -> object:
        return self.row


@pytest.mark.parametrize("late", [{}, {"delay": 0.1}, {"hold": 1}], ids=["at once", "delay", "hold"])
@pytest.mark.parametrize(
    ("row", "shown"),
    [
        ((np.array([1.0]),), "array([1.])"),
        (np.array([[1.0]]), "array([1.])"),
        ((np.array([1.0, 2.0]),), "array([1., 2.])"),
        ((1 + 0j,), "(1+0j)"),
        ((10**400,), "100000000000000000...0000000000000000000"),
        (("1",), "'1'"),
        ([None], "None"),
    ],
)
def test_an_output_that_is_no_number_is_shown(row: object, shown: str, late: dict[str, float]) -> None:
    system = System((Sampled("c", Constant(row), 0.1, **late),))  # type: ignore[arg-type]
    words = re.escape(f"t = 0 s: c: its step returned u = {shown}") + r".*; return a number, as float\(\.\.\.\)$"
    with pytest.raises(SimulationError, match=words):
        cosimulate(system, Experiment(np.arange(3) * 0.1, ("c.u",)), step=0.1)


@pytest.mark.parametrize("value", [True, np.float32(3), np.bool_(True), np.int64(2)])
def test_numbers_of_all_kinds_are_taken(value: object) -> None:
    record = cosimulate(
        System((Sampled("c", Constant((value,)), 0.1),)),  # type: ignore[arg-type]
        Experiment(np.arange(3) * 0.1, ("c.u",)),
        step=0.1,
    )
    assert record["c.u"].tolist() == [float(value)] * 3  # type: ignore[arg-type]


class Adding:
    """Adds up, in an array."""

    inputs, outputs = (), (Port("u"),)

    def __init__(self) -> None:
        self.total, self.gain = np.zeros(1), 1.0

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        self.total += self.gain
        return (float(self.total[0]),)


def test_a_block_is_as_its_owner_left_it_when_a_run_begins() -> None:
    """It remembers in an array, and is two members of one system."""
    block, experiment = Adding(), Experiment(np.arange(4) * 0.1, ("c.u", "d.u"))
    system = System((Sampled("c", block, 0.1), Sampled("d", block, 0.2)))
    assert cosimulate(system, experiment, step=0.1).values.tolist() == [[1, 1], [2, 1], [3, 2], [4, 2]]
    block.gain = 2.0
    assert cosimulate(system, experiment, step=0.1)["c.u"].tolist() == [2, 4, 6, 8]
    with Run(system, experiment, step=0.1) as run, Run(system, experiment, step=0.1) as beside:
        run.advance()
        beside.advance()
        assert np.array_equal(run.record().values, beside.record().values)
    assert block.total == 0.0


class Logging(Adding):
    """Holds what cannot be copied from its first step on."""

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        self.lock = Lock()
        return super().step(time, inputs)


class LeavingOut(Logging):
    def __getstate__(self) -> dict[str, object]:
        return {name: value for name, value in vars(self).items() if name != "lock"}


def test_a_state_that_cannot_be_copied_is_refused_with_its_cure() -> None:
    experiment = Experiment(np.arange(4) * 0.1, ("c.u",))
    with Run(System((Sampled("c", Logging(), 0.1),)), experiment, step=0.1) as run:
        run.advance(0.1)
        with pytest.raises(BadInput, match=r"c: it cannot be copied, .*lock.* leave them out of its __getstate__"):
            run.save()
    with Run(System((Sampled("c", LeavingOut(), 0.1),)), experiment, step=0.1) as run:
        run.advance(0.1)
        kept = run.save()
        for _ in range(2):
            run.advance()
            assert run.record()["c.u"].tolist() == [1, 2, 3, 4]
            run.restore(kept)
