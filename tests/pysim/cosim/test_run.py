"""Runs: what is refused ahead of them, failures on the way, events, initial values."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from time import sleep

import numpy as np
import pytest

from pysim.control import Gain
from pysim.cosim import (
    Connection,
    Doubling,
    GaussSeidel,
    Iterated,
    Jacobi,
    MemberFailed,
    Order,
    Run,
    Sampled,
    Setup,
    System,
    cosimulate,
)
from pysim.types import BadInput, Experiment, Outcome, Port, Signal, SimulationError
from tests.cosim_parts import Linear, oscillation, oscillators

TIMES = np.linspace(0, 1, 11)


def integrator(name: str = "i", **more: object) -> Linear:
    """dy/dt = u."""
    return Linear(name, (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]], **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("experiment", "step", "words"),
    [
        (Experiment(TIMES, ("i.y",)), 0.1, r"nothing drives i\.u; connect an output \(i\.y\), give .* inputs={'i.u'"),
        (Experiment(TIMES, ("i.z",), {"i.u": Signal.constant(1)}), 0.1, r"there is no output 'i\.z'.*of i: i\.y"),
        (Experiment(TIMES, ("i.y",), {"i.v": Signal.constant(1)}), 0.1, r"there is no input 'i\.v'.*inputs of i: i\.u"),
        (Experiment(TIMES, ("i.y",), {"i.u": Signal.constant(1)}, {"x0": 1}), 0.1, "override 'x0' is of no member"),
        (Experiment(TIMES, ("i.y",), {"i.u": Signal.constant(1)}, {"i.k": 1}), 0.1, "i has no k"),
        (Experiment(TIMES, ("i.y",), {"i.u": Signal.constant(1)}), 0.03, r"time 0\.1 s is no whole number of steps"),
        (Experiment(TIMES, ("i.y",), {"i.u": Signal.constant(1)}), 0.0, "the step is 0.0; give a positive number"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(experiment: Experiment, step: float, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        cosimulate(System((integrator(),)), experiment, step=step)


def test_settings_are_what_their_names_say() -> None:
    experiment = Experiment(TIMES, ("left.x",))
    with pytest.raises(BadInput, match=r"order is <class .*as GaussSeidel\(\)"):
        cosimulate(oscillators(), experiment, step=0.1, order=GaussSeidel)  # type: ignore[arg-type]
    with pytest.raises(BadInput, match=r"doubling is 0\.1; give Doubling"):
        cosimulate(oscillators(), experiment, step=0.1, doubling=0.1)  # type: ignore[arg-type]
    with pytest.raises(BadInput, match=r"give System\(\.\.\.\) and Experiment"):
        cosimulate(integrator(), experiment, step=0.1)  # type: ignore[arg-type]


def test_an_input_is_driven_once() -> None:
    system = System((integrator("a"), integrator("b")), (Connection("a.y", "b.u"), Connection("b.y", "a.u")))
    with pytest.raises(BadInput, match=r"a\.u has a signal and is driven by b\.y"):
        cosimulate(system, Experiment(TIMES, ("a.y",), {"a.u": Signal.constant(1)}), step=0.1)


def test_overrides_and_signals_reach_their_member() -> None:
    drive = {"i.u": Signal.steps([0.0, 0.5], [1.0, 3.0])}
    record = cosimulate(System((integrator(),)), Experiment(TIMES, ("i.y", "i.u"), drive, {"i.x0": 2.0}), step=0.1)
    assert record["i.y"] == pytest.approx(2 + TIMES + 2 * np.maximum(TIMES - 0.5, 0), rel=1e-12)
    assert record["i.u"] == pytest.approx(np.where(TIMES > 0.49, 3.0, 1.0))


def test_a_rate_comes_with_its_signal() -> None:
    wave = Signal.lines([0, 0.5, 1.0], [0.0, 1.0, -1.0])
    system = System((integrator("a"), integrator("b")))
    record = cosimulate(system, Experiment(TIMES, ("b.u",), {"a.u": wave}, rates={"b.u": "a.u"}), step=0.1)
    assert record["b.u"] == pytest.approx(np.where(TIMES < 0.49, 2.0, np.where(TIMES < 0.99, -4.0, 0.0)))


def test_steps_lie_where_multiplication_puts_them() -> None:
    seen = []

    class Watching(Linear):
        def step(self, time: float, end: float) -> float:
            seen.append((time, end))
            return super().step(time, end)

    member = Watching("i", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]])
    times = 0.3 + np.arange(1001) * 0.001
    cosimulate(System((member,)), Experiment(times, ("i.y",), {"i.u": Signal.constant(1)}, start=0.3), step=0.001)
    assert seen == [(0.3 + n * 0.001, 0.3 + (n + 1) * 0.001) for n in range(1000)]


@pytest.mark.parametrize("order", [Jacobi(), GaussSeidel(), Iterated()], ids=str)
@pytest.mark.parametrize(
    ("trouble", "outcome", "words"),
    [
        ({"fails": 0.55}, Outcome.MODEL_ERROR, r"t = 0\.5 s: a: the model divided by zero"),
        ({"bad": 0.55}, Outcome.NOT_FINITE, r"t = 0\.5 s: a: its output y is nan"),
    ],
)
def test_a_member_that_fails_is_named(order: Order, trouble: dict, outcome: Outcome, words: str) -> None:
    a, b = integrator("a", x0=[1.0], **trouble), integrator("b")
    system = System((b, a), (Connection("a.y", "b.u"), Connection("b.y", "a.u")))
    experiment = Experiment(TIMES, ("a.y", "b.y"))
    with pytest.raises(SimulationError, match=words) as caught:
        cosimulate(system, experiment, step=0.1, order=order)
    record = cosimulate(system, experiment, step=0.1, order=order, check=False)
    assert record.outcome is caught.value.record.outcome is outcome
    assert record.message == str(caught.value)
    assert record.time[-1] == pytest.approx(0.5)
    assert np.isfinite(record.values).all()
    assert a.closed == b.closed == 2


def test_a_failure_at_the_start_is_one_too() -> None:
    class Stillborn(Linear):
        def begin(self) -> None:
            raise OSError("no licence")

    member = Stillborn("i", (Port("u", start=0.0),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]])
    with pytest.raises(SimulationError, match="t = 0 s: i: OSError: no licence"):
        cosimulate(System((member,)), Experiment(TIMES, ("i.y",)), step=0.1)
    assert member.closed == 1


def test_initial_values_go_round_until_they_rest() -> None:
    parts = [Linear(n, (Port("u"),), (Port("y"),), A=[[0]], B=[[0]], C=[[0]], D=[[2.0]]) for n in "abcd"]
    wires = [Connection(f"{one}.y", f"{other}.u") for one, other in ("cb", "dc", "ba")]
    system = System(parts, wires)
    record = cosimulate(system, Experiment(TIMES, ("a.y", "d.y"), {"d.u": Signal.lines([0, 1], [1, 2])}), step=0.1)
    assert record["a.y"] == pytest.approx(16 * (1 + TIMES))


@pytest.mark.parametrize("order", [Jacobi(), GaussSeidel(), GaussSeidel(order=("a", "k")), Iterated()], ids=str)
def test_all_meet_at_an_event(order: Order) -> None:
    """A member is kicked within a step: what depends on it sees that at the event's own time."""
    kicked = integrator("k", breaks=(0.25, 0.5), kick=1.0)
    after = Linear("a", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]])
    system = System((after, kicked), (Connection("k.y", "a.u"),))
    experiment = Experiment(TIMES, ("k.y", "a.y"), {"k.u": Signal.constant(0.0)})
    record = cosimulate(system, experiment, step=0.1, order=order)
    assert record["k.y"] == pytest.approx(np.searchsorted([0.25, 0.5 - 1e-9], TIMES, side="right"))
    assert record["a.y"] == pytest.approx(np.maximum(TIMES - 0.25, 0) + np.maximum(TIMES - 0.5, 0), abs=1e-12)
    assert record.statistics["events"] == 2


def test_two_members_with_events_meet_at_the_earlier_one() -> None:
    parts = [integrator(n, breaks=(time,), kick=1.0) for n, time in (("a", 0.27), ("b", 0.23))]
    wires = (Connection("a.y", "b.u"), Connection("b.y", "a.u"))
    record = cosimulate(System(parts, wires), Experiment(TIMES[:4], ("a.y", "b.y")), step=0.1, order=Jacobi())
    # b jumps to 1 at 0.23, a then grows by 1/s until its own jump at 0.27, with inputs held from event to event
    assert record["a.y"][-1] == pytest.approx(1 + 0.04 + 0.03)
    assert record["b.y"][-1] == pytest.approx(1 + 0.03 * 1.04)


def test_an_event_that_others_cannot_share_is_told() -> None:
    kicked, stiff = integrator("k", breaks=(0.25,), kick=1.0), integrator("s", can_vary_step=False)
    system = System((stiff, kicked), (Connection("k.y", "s.u"),))
    record = cosimulate(system, Experiment(TIMES, ("k.y", "s.y"), {"k.u": Signal.constant(0.0)}), step=0.1)
    assert record["k.y"][-1] == 1
    assert record["s.y"][-1] == pytest.approx(0.7)  # sees it from 0.3 s on
    assert record.statistics["unaligned"] == 1


def test_events_without_end_stop_the_run() -> None:
    class Chattering(Linear):
        def step(self, time: float, end: float) -> float:
            return time if time >= 0.3 else super().step(time, end)

    member = Chattering("c", (), (Port("y"),), A=[[0.0]], B=np.zeros((1, 0)), C=[[1.0]], breaks=(5.0,))
    with pytest.raises(SimulationError, match="events follow each other without time passing") as caught:
        cosimulate(System((member,)), Experiment(TIMES, ("c.y",)), step=0.1)
    assert caught.value.record.outcome is Outcome.TOO_MANY_EVENTS


def test_a_short_step_without_leave_is_an_error() -> None:
    class Lazy(Linear):
        def step(self, time: float, end: float) -> float:
            return 0.5 * (time + end)

    member = Lazy("c", (), (Port("y"),), A=[[0.0]], B=np.zeros((1, 0)), C=[[1.0]])
    with pytest.raises(SimulationError, match=r"c: a step to 0\.1 s ended at 0\.05 s, which it does not say"):
        cosimulate(System((member,)), Experiment(TIMES, ("c.y",)), step=0.1)


def test_members_start_with_what_drives_them() -> None:
    seen = []

    class Careful(Linear):
        def start(self, setup: Setup) -> None:
            seen.append(float(setup.inputs[0]))
            super().start(setup)

    last = Careful("last", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]])
    block = Sampled("g", Gain(3.0), 0.1)
    wires = (Connection("first.y", "last.u"), Connection("g.y", "first.u"))
    system = System((last, integrator("first", x0=[5.0]), block), wires)
    cosimulate(system, Experiment(TIMES, ("last.y",), {"g.u": Signal.constant(1.0)}), step=0.1)
    assert seen == [5.0]


def test_a_state_that_cannot_be_saved_is_named() -> None:
    class Forgetful(Linear):
        def save(self, into: object = None) -> object:
            raise MemberFailed("out of memory")

    member = Forgetful("i", (Port("u", start=0.0),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]])
    experiment = Experiment(TIMES, ("i.y",))
    with Run(System((member,)), experiment, step=0.1) as run:
        run.advance(0.2)
        with pytest.raises(SimulationError, match=r"t = 0\.2 s: i: out of memory"):
            run.save()
    with pytest.raises(SimulationError, match="i: out of memory"):
        cosimulate(System((member,)), experiment, step=0.1, order=Iterated())


def test_all_are_closed_whatever_one_does() -> None:
    class Clinging(Linear):
        def close(self) -> None:
            raise OSError("cannot be freed")

    parts = [
        kind(n, (), (Port("y"),), A=[[0.0]], B=np.zeros((1, 0)), C=[[1.0]])
        for kind, n in ((Linear, "a"), (Clinging, "b"), (Linear, "c"))
    ]
    system = System(parts)
    for _ in range(2):  # and none is taken to be at work still
        with pytest.raises(OSError, match="cannot be freed"):
            cosimulate(system, Experiment(TIMES, ("a.y",)), step=0.1)
    assert parts[0].closed == parts[2].closed == 2


def test_blocks_alone_are_a_system() -> None:
    system = System((Sampled("g", Gain(2.0), 0.1), Sampled("h", Gain(3.0), 0.1)), (Connection("g.y", "h.u"),))
    record = cosimulate(system, Experiment(TIMES, ("h.y",), {"g.u": Signal.lines([0, 1], [0, 1])}), step=0.1)
    assert record["h.y"] == pytest.approx(6 * TIMES)


def test_a_run_is_its_own() -> None:
    experiment = Experiment(TIMES, ("left.x",))
    system = oscillators()
    with Run(system, experiment, step=0.1) as run:
        with pytest.raises(BadInput, match="left is at work in another run"), Run(system, experiment, step=0.1):
            pass
        run.advance(0.5)
        kept = run.save()
        with pytest.raises(BadInput, match="stay within the experiment"):
            run.advance(0.2)
        with pytest.raises(BadInput, match="no whole number of steps"):
            run.advance(0.55)
        assert run.record().time[-1] == pytest.approx(0.5)
    with pytest.raises(BadInput, match="closed or has failed"):
        run.advance()
    with Run(system, experiment, step=0.1) as other, pytest.raises(BadInput, match="kept in another run"):
        other.restore(kept)


def test_of_two_threads_one_gets_the_member(monkeypatch: pytest.MonkeyPatch) -> None:
    class Slow(set[int]):
        """Lets another thread in after every look."""

        def __contains__(self, item: object) -> bool:
            found = super().__contains__(item)
            sleep(0.1)
            return found

    monkeypatch.setattr("pysim.cosim.run._at_work", Slow())
    system, experiment = System((integrator(x0=[1.0]),)), Experiment(TIMES, ("i.y",), {"i.u": Signal.constant(0.0)})
    both = Barrier(2)

    def enter() -> bool:
        try:
            with Run(system, experiment, step=0.1):
                both.wait(5.0)
        except BadInput:
            both.wait(5.0)
            return False
        return True

    with ThreadPoolExecutor(2) as threads:
        assert sorted(future.result() for future in [threads.submit(enter) for _ in range(2)]) == [False, True]


def test_going_back_forgets_what_was_recorded_after() -> None:
    with Run(oscillators(), Experiment(TIMES, ("left.x",)), step=0.1) as run:
        kept = run.save()
        run.advance(0.5)
        run.restore(kept)
        assert run.record().time.tolist() == [0.0]


def test_progress_is_told() -> None:
    told: list[float] = []
    experiment = Experiment(np.array([0.0, 2.5]), ("left.x",))
    record = cosimulate(oscillators(), experiment, step=0.001, progress=told.append)
    assert told == [1.0, 2.0, 2.5]
    assert record["left.x"][-1] == pytest.approx(oscillation([2.5])[0, 0], abs=0.05)


@pytest.mark.parametrize("can", ["can_rollback", "can_vary_step"])
def test_abilities_are_asked_for(can: str) -> None:
    system, experiment = oscillators(**{can: False}), Experiment(TIMES, ("left.x",))
    with pytest.raises(BadInput, match="step doubling: left, right"):
        cosimulate(system, experiment, step=0.1, doubling=Doubling())
    if can == "can_rollback":
        with pytest.raises(BadInput, match="iterated steps: left, right cannot save and restore"):
            cosimulate(system, experiment, step=0.1, order=Iterated())
        with Run(system, experiment, step=0.1) as run, pytest.raises(BadInput, match="save: left, right cannot"):
            run.save()
