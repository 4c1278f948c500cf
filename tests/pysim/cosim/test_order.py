"""What every order of stepping has to do: converge as it claims on two coupled oscillators, and repeat from a state."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from pysim.control import PI
from pysim.cosim import Connection, Doubling, GaussSeidel, Jacobi, Order, Run, Sampled, System, cosimulate
from pysim.types import Experiment, Port, Signal
from tests.cosim_parts import Linear, oscillation, oscillators
from tests.pysim.cosim.order_cases import ORDERS

END = 2.0  # s


def errors(order: Order, counts: tuple[int, ...], **more: bool) -> tuple[np.ndarray, np.ndarray]:
    """Largest error of both positions over the run, and the energy that the coupling made (J), for counts of steps."""
    system, times = oscillators(**more), np.linspace(0, END, 21)
    experiment = Experiment(times, ("left.x", "right.x_r"))
    records = [cosimulate(system, experiment, step=END / count, order=order) for count in counts]
    return (
        np.array([np.abs(record.values[:, :2] - oscillation(times)).max() for record in records]),
        np.array([abs(record["between.residual"][-1]) for record in records]),
    )


@pytest.mark.parametrize("takes_rates", [False, True])
@pytest.mark.parametrize("order", ORDERS, ids=str)
def test_converges_as_claimed(order: Order, takes_rates: bool) -> None:
    found, energy = errors(order, (400, 800), takes_rates=takes_rates)
    slopes = np.log2(found[:-1] / found[1:])
    # An extrapolation starts one order below its own, which shows in coarse steps as more than the claim.
    assert (slopes > order.accuracy - 0.1).all()
    assert (slopes < order.accuracy + 0.6).all()
    assert energy[-1] < 1e-6 or (np.log2(energy[:-1] / energy[1:]) > order.accuracy - 0.2).all()


def test_second_order_with_a_quarter_of_the_steps_is_better() -> None:
    first = errors(ORDERS[0], (800,))[0][0]
    assert all(errors(order, (200,))[0][0] < first / 5 for order in ORDERS if order.accuracy == 2)


def controlled() -> System:
    """The oscillators, with a controller that pushes the left one towards a reference, late by two steps."""
    system = oscillators()
    left, right = system.members
    push = Sampled("push", PI(5.0, 0.5, 0.01), every=0.01, delay=0.02, hold=1)
    extra = Linear(
        "sum", (right.outputs[0], push.outputs[0]), (left.inputs[0],), A=[[0]], B=[[0, 0]], C=[[0]], D=[[1, 1]]
    )
    wires = [c for c in system.connections if c.source != "right.F"]
    wires += [Connection("right.F", "sum.F"), Connection("push.u", "sum.u"), Connection("sum.F", "left.F")]
    wires += [Connection("left.x", "push.measured", factor=1.0)]
    return System((*system.members, extra, push), tuple(wires))


@pytest.mark.parametrize("doubling", [None, Doubling(rtol=1e-3)], ids=["fixed", "doubled"])
@pytest.mark.parametrize("order", [o for o in ORDERS if getattr(o, "order", ()) == ()], ids=str)
def test_save_and_restore_repeat_bit_for_bit(order: Order, doubling: Doubling | None) -> None:
    names = ("left.x", "left.F", "right.F", "right.x_r", "push.u", "push.measured")
    drive = {"push.reference": Signal.steps([0.0, 0.055], [0.0, 0.3])}
    experiment = Experiment(np.linspace(0, 0.4, 41), names, drive)
    with Run(controlled(), experiment, step=0.005, order=order, doubling=doubling) as run:
        run.advance(0.135)
        kept = run.save()
        run.advance()
        first = run.record()
        run.restore(kept)
        assert run.time == pytest.approx(0.135, abs=1e-15)
        run.advance()
        again = run.record()
    straight = cosimulate(controlled(), experiment, step=0.005, order=order, doubling=doubling)
    assert np.array_equal(first.values, again.values)
    assert np.array_equal(first.values, straight.values)
    assert first.statistics == again.statistics
    assert np.ptp(first["push.u"]) > 0.1


@pytest.mark.parametrize("takes_rates", [False, True])
@pytest.mark.parametrize("order", ORDERS[:3], ids=str)
def test_a_signal_is_no_coupling_and_of_second_order_in_all(order: Order, takes_rates: bool) -> None:
    """dx/dt = sin(3 t): x = (1 - cos(3 t)) / 3. Its recorded input is the signal at the time, not its mean."""
    member = Linear("i", (Port("u"),), (Port("x"),), A=[[0]], B=[[1]], C=[[1]], takes_rates=takes_rates)
    times = np.linspace(0, END, 21)
    wave = Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[1.0, 0.0, 3.0, 0.0]]]))
    experiment = Experiment(times, ("i.x", "i.u"), {"i.u": wave})
    errors = []
    for step in (0.1, 0.05):
        record = cosimulate(System((member,)), experiment, step=step, order=order)
        errors.append(np.abs(record["i.x"] - (1 - np.cos(3 * times)) / 3).max())
        assert record["i.u"] == pytest.approx(np.sin(3 * times), abs=1e-12)
    assert errors[0] < 0.01  # h^2/12 times 9 times the mean of the wave over half a period, and room
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.05)


@pytest.mark.parametrize("takes_rates", [False, True])
@pytest.mark.parametrize("order", ORDERS[:4], ids=str)
def test_a_step_stays_a_step(order: Order, takes_rates: bool) -> None:
    """It jumps at a communication point that rounding puts on either side, and between two: then at the next."""
    member = Linear("i", (Port("u"),), (Port("x"),), A=[[0]], B=[[1]], C=[[1]], takes_rates=takes_rates)
    times, steps = 0.1 * np.arange(11), Signal.steps([0.0, 0.3, 0.65, 0.9], [1.0, 3.0, -1.0, 0.0])
    record = cosimulate(System((member,)), Experiment(times, ("i.x",), {"i.u": steps}), step=0.1, order=order)
    known = np.cumsum([0, 1, 1, 1, 3, 3, 3, 3, -1, -1, 0]) * 0.1
    assert record["i.x"] == pytest.approx(known, abs=1e-12)


@pytest.mark.parametrize("takes_rates", [False, True])
@pytest.mark.parametrize("step", [0.01, 0.02])
def test_a_step_comes_in_time_in_a_run_that_starts_long_before(step: float, takes_rates: bool) -> None:
    """From -10 s on, so many steps end 4e-16 s ahead of 0.1 s, which is 26 times the rounding of 0.1."""
    member = Linear("i", (Port("u"),), (Port("x"),), A=[[0]], B=[[1]], C=[[1]], takes_rates=takes_rates)
    times = -10.0 + step * np.arange(round(10.2 / step) + 1)
    experiment = Experiment(times, ("i.x", "i.u"), {"i.u": Signal.steps([0.0, 0.1], [0.0, 1.0])}, start=-10.0)
    record = cosimulate(System((member,)), experiment, step=step)
    assert record["i.u"] == pytest.approx(1.0 * (times > 0.1 - 0.5 * step))
    assert record["i.x"] == pytest.approx(np.maximum(times - 0.1, 0.0), abs=1e-12)


def broken(*wires: Connection, rates: bool = False, back: bool = True) -> System:
    """Two integrators; every step of the first ends early at a quarter, with an event that changes nothing."""
    ports, breaks = ((Port("u"),), (Port("y"),)), tuple(0.1 * (n + 0.25) for n in range(10))
    more = {"A": [[0.0]], "B": [[1.0]], "C": [[1.0]], "can_rollback": back}
    return System((Linear("k", *ports, breaks=breaks, **more), Linear("i", *ports, takes_rates=rates, **more)), wires)


@pytest.mark.parametrize("rates", [False, True])
@pytest.mark.parametrize("lines", [False, True])
@pytest.mark.parametrize("make", [Jacobi, partial(GaussSeidel, ("k", "i")), partial(GaussSeidel, ("i", "k"))])
def test_an_input_runs_to_the_end_of_a_step_that_ends_early(
    make: Callable[..., Order], lines: bool, rates: bool
) -> None:
    """The integral of a ramp is exact, whether a member takes the line or its mean."""
    times, ramp = np.linspace(0, 1, 11), Signal.lines([0, 1], [0, 1])
    experiment = Experiment(times, ("k.y", "i.y"), {"k.u": ramp, "i.u": ramp})
    record = cosimulate(broken(rates=rates), experiment, step=0.1, order=make(lines=lines))
    assert record.values == pytest.approx(np.column_stack([times, times]) ** 2 / 2, abs=1e-12)
    assert record.statistics["events"] == 10


@pytest.mark.parametrize("rates", [False, True])
def test_those_behind_one_that_ends_early_follow_its_line(rates: bool) -> None:
    """Also if it cannot go back."""
    times = np.linspace(0, 1, 11)
    experiment = Experiment(times, ("i.y",), {"k.u": Signal.constant(1.0)})
    system = broken(Connection("k.y", "i.u"), rates=rates, back=False)
    record = cosimulate(system, experiment, step=0.1, order=GaussSeidel(lines=True))
    assert record["i.y"] == pytest.approx(times**2 / 2, abs=1e-12)
