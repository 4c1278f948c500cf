"""A long log becomes triangles while it is simulated: the same fit, interval and blocks as from all of its rows."""

import gc
import math
import weakref
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.identify.greybox import NoiseSettings, Parameter, Problem, Simulation, Treatment, fit, problem
from pysim.identify.greybox.reduction import Reduction
from pysim.identify.greybox.residuals import Carried, Point
from pysim.identify.greybox.runs import simulate_runs
from pysim.simulate import Esdirk, open_runs
from pysim.types import BadInput, Experiment, Model, Signal
from tests.pysim.identify.greybox import measurements as m

Array = NDArray[np.float64]

ROWS = 20_000  # three stretches of the kernel
TIGHT = Simulation(solver=Esdirk(rtol=1e-8, atol=1e-8), mismatch=1e-7)


def records(seed: int = 1) -> list[Any]:
    """A long log of the lag behind a ramp beside a short one, from K = 2 and T = 0.7 s."""
    t = np.linspace(0.0, 20.0, ROWS)
    noise = 0.02 * np.random.default_rng(seed).standard_normal(ROWS)
    return [
        m.log(t, np.minimum(t, 5.0), m.ramp_answer(t, 2.0, 0.7) - behind(t) + noise),
        m.ramp_log(2.0, 0.7, seed=2, source="b"),
    ]


def behind(t: Array) -> Array:
    """What the ramp's end at 5 s takes off."""
    late = np.maximum(t - 5.0, 0.0)
    return m.ramp_answer(late, 2.0, 0.7)


def task(lag: Model, whole: int) -> Problem:
    treatment = Treatment(noise=NoiseSettings(whole=whole))
    return problem(lag, [m.dataset(records())], [Parameter("K", 1.5), Parameter("T", 1.0)], treatment=treatment)


def at(this: Problem, carried: Carried | None = None) -> Point:
    x = this.space.to_search(np.array([2.0, 0.7]))
    return this.residuals(simulation=TIGHT).evaluate(this.model, this.space, x, carried)


def products(point: Point, block: int) -> Array:
    """Sums of squares and products of residual and slopes in one block."""
    own = point.blocks == block
    rows = np.column_stack([point.residual, point.jacobian])[own]
    return np.asarray(rows.T @ rows)


def test_squares_and_products_are_those_of_all_rows(lag: Model) -> None:
    whole, reduced = at(task(lag, ROWS)), at(task(lag, ROWS - 1))
    assert reduced.residual.size < 0.05 * whole.residual.size
    assert reduced.count == whole.count
    assert reduced.cost == pytest.approx(whole.cost, rel=1e-12)
    np.testing.assert_allclose(reduced.levels, whole.levels, rtol=1e-12)
    for one, other in zip(reduced.steps, whole.steps, strict=True):
        if one is not None and other is not None:
            np.testing.assert_allclose(one.by, other.by, rtol=1e-6)
    carried = reduced.carried_to(reduced.x, math.inf)  # which knows how long its pieces have to be
    again = at(task(lag, ROWS - 1), carried)
    for block in range(NoiseSettings().blocks):
        expected = products(whole, block)
        np.testing.assert_allclose(products(again, block), expected, atol=1e-9 * np.max(expected))


def test_the_fit_is_the_same_and_finds_the_truth(lag: Model) -> None:
    whole, reduced = (fit(task(lag, count), simulation=TIGHT) for count in (ROWS, ROWS - 1))
    for one, other, truth in zip(reduced.estimates, whole.estimates, (2.0, 0.7), strict=True):
        assert one.value == pytest.approx(other.value, rel=1e-6)
        assert one.interval == pytest.approx(other.interval, rel=1e-4)
        assert abs(one.value - truth) < 4 * one.std
    assert reduced.misfit == pytest.approx(whole.misfit, rel=1e-9)


def test_rows_are_handed_over_in_order_and_what_is_raised_there_ends_the_pass(lag: Model) -> None:
    t = np.linspace(0.0, 4.0, ROWS)
    experiment = Experiment(t, ("y",), {"w": Signal.lines([0.0, 4.0], [0.0, 4.0])}, {"K": 2.0, "T": 0.7})
    found: list[Array] = []

    def take(first: int, values: Array, slopes: Array) -> None:
        assert first == sum(len(part) for part in found)
        found.append(np.concatenate([values, slopes[:, 0]], axis=1))

    def refuse(first: int, values: Array, slopes: Array) -> None:
        raise BadInput(f"row {first} is not wanted")

    with open_runs(lag) as runs:
        (kept,) = runs.sensitivities([experiment], ("K", "T"))
        (handed,) = runs.sensitivities([experiment], ("K", "T"), takes=[take])
        with pytest.raises(BadInput, match="row 0 is not wanted"):
            runs.sensitivities([experiment], ("K", "T"), takes=[refuse])
    assert handed.record.values.shape == (0, 1)
    rows = np.concatenate(found)
    np.testing.assert_array_equal(rows, np.concatenate([kept.record.values, kept.by_parameter[:, 0]], axis=1))
    np.testing.assert_allclose(rows[:, 0], m.ramp_answer(t, 2.0, 0.7), atol=1e-3)


def test_a_pass_is_gone_with_its_last_user(lag: Model) -> None:
    """What it keeps grows with a log's rows, and the collector of circles does not know how large that is."""
    model, space, one = lag, task(lag, ROWS - 1).space, task(lag, ROWS - 1).observations[0]
    reduction = Reduction(one.runs[0].measured, 0, NoiseSettings().blocks)
    gone = weakref.ref(reduction)
    gc.disable()
    try:
        simulate_runs(model, space, one.runs, space.to_search(space.start), [None], TIGHT, reductions=[reduction])
        assert reduction.count == ROWS
        assert reduction.table.size
        del reduction
        assert gone() is None
    finally:
        gc.enable()
