"""Levels, initial states and sensor errors of the objective, against direct algebra on a lag with a closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox import (
    GaussNewton,
    Nuisance,
    NuisanceKind,
    Parameter,
    Problem,
    Simulation,
    Treatment,
    fit,
    problem,
)
from pysim.identify.greybox.comparison import compared
from pysim.identify.greybox.residuals import Carried, Point
from pysim.simulate import Esdirk
from pysim.types import MeasuredRecord, Model, Record
from tests.pysim.identify.greybox import measurements as m

TIGHT = Simulation(solver=Esdirk(rtol=1e-8, atol=1e-8), mismatch=1e-7)


def records() -> list[MeasuredRecord]:
    sines = [m.sine_log(2.0, 0.7, f, seed=4) for f in (0.5, 1.0)]
    return [m.ramp_log(2.0, 0.7, seed=1), m.ramp_log(2.0, 0.7, seed=2, source="b.txt"), *sines]


def task(lag: Model, initial: str = "near rest") -> Problem:
    return problem(lag, [m.dataset(records())], ["K", "T"], treatment=Treatment(initial=initial))


def at(this: Problem, x: np.ndarray, carried: Carried | None = None, **changed: object) -> Point:
    residuals = replace(this.residuals(simulation=TIGHT), **changed)
    return residuals.evaluate(this.model, this.space, x, carried)


@pytest.mark.parametrize("kind", [None, *NuisanceKind])
def test_the_cost_falls_as_its_linear_step_says(lag: Model, kind: NuisanceKind | None) -> None:
    """Slopes of the whole objective against central differences of it, what is carried along and all."""
    nuisances = () if kind is None else (Nuisance(kind, "lag", "y", 0.05),)
    this = task(lag)
    x = this.space.to_search(np.array([1.9, 0.6]))
    here = at(this, x, nuisances=nuisances)
    for direction in np.eye(2):
        ends = [
            at(this, x + sign * 1e-4 * direction, along(here, sign * 1e-4 * direction), nuisances=nuisances)
            for sign in (1.0, -1.0)
        ]
        numeric = (ends[0].cost - ends[1].cost) / 2e-4
        assert numeric == pytest.approx(float(here.residual @ here.jacobian @ direction), rel=2e-3, abs=2e-2)


def along(here: Point, p: np.ndarray) -> Carried:
    """What is carried where x moves by p, without the step that it takes where x stays."""
    return here.carried_to(here.x + p, damping=math.inf)


def test_initial_states_and_a_gain_take_what_they_can(lag: Model) -> None:
    """One linear step gains what it promises, since the lag is linear in its state, and a gain in its size."""
    this = task(lag, "estimate")
    x = this.space.to_search(np.array([1.9, 0.6]))
    floor = {channel: replace(floor, sd=10.0) for channel, floor in this.floors.items()}  # levels stay where they are
    error = (Nuisance(NuisanceKind.GAIN, "lag", "y", 0.05),)
    here = at(this, x, nuisances=error, floors=floor)
    there = at(this, x, here.carried_to(x), nuisances=error, floors=floor)
    assert here.own_gain() > 0
    assert here.cost - there.cost == pytest.approx(here.own_gain(), rel=1e-3)
    assert there.own_gain() < 1e-3 * here.own_gain()


@pytest.mark.parametrize("kind", NuisanceKind)
def test_an_error_that_is_known_counts_as_a_free_one_of_that_size(lag: Model, kind: NuisanceKind) -> None:
    """Without its prior and its slopes; and what is shown beside the measurements is what the sensor shows."""
    this, error, size = task(lag, "rest"), Nuisance(kind, "lag", "y", 0.05), 0.03
    x = this.space.to_search(np.array([1.9, 0.6]))
    free = at(this, x, Carried(nuisances=np.array([size])), nuisances=(error,))
    known = at(this, x, known=((error, size),))
    assert known.squares == pytest.approx(free.squares, rel=1e-12)
    assert known.squares != pytest.approx(at(this, x).squares, rel=1e-3) or kind is NuisanceKind.DRIFT
    shown = compared(this, x, TIGHT, errors=((error, size),)).records
    apart = [record.measured["y"] - record.simulated["y"] for record in shown]
    assert sum(float(rest @ rest) for rest in apart) == pytest.approx(float(known.squares.sum()), rel=1e-3)


def test_a_drift_is_seen_from_sine_to_sine(lag: Model) -> None:
    """Sines of a sensor that goes off by 1e-3 a second, logged an hour apart."""
    rate, drifted, still = 1e-3, list[MeasuredRecord](), list[MeasuredRecord]()
    for k, f in enumerate((0.5, 1.0, 2.0)):
        record = replace(m.sine_log(2.0, 0.7, f, seed=k, noise=0.0), begin=3600.0 * k)
        assert isinstance(record.data, Record)
        values = record.data.values.copy()
        values[:, 1] += rate * (3600.0 * k + record.data.time - record.data.time[0])
        drifted.append(replace(record, data=replace(record.data, values=values)))
        still.append(record)
    of, one = Treatment(initial="rest"), Nuisance(NuisanceKind.DRIFT, "lag", "y", 0.05)
    squares = []
    for logs, known in ((drifted, ()), (drifted, ((one, rate),)), (still, ())):
        this = problem(lag, [m.dataset(logs)], ["K", "T"], treatment=of)
        squares.append(float(at(this, this.space.to_search(np.array([1.9, 0.7])), known=known).squares.sum()))
    apart, told, right = squares
    assert apart > 10 * right
    assert told == pytest.approx(right, rel=0.02)


def test_a_level_never_falls_below_its_floor_nor_rises_above_its_residual(lag: Model) -> None:
    this = task(lag, "rest")
    point = at(this, this.space.to_search(np.array([2.0, 0.7])))
    rms = np.sqrt(point.squares / this.residuals().samples)
    assert point.levels == pytest.approx(np.maximum(rms, m.NOISE))
    far = at(this, this.space.to_search(np.array([1.0, 0.7])))
    assert far.levels == pytest.approx(np.sqrt(far.squares / this.residuals().samples))


def test_a_wrong_figure_for_the_noise_leaves_the_estimates_where_they_are(lag: Model) -> None:
    found = []
    for noise in (m.NOISE, 1e-4 * m.NOISE):
        this = problem(lag, [m.dataset(records(), noise)], ["K", "T"])
        found.append(fit(this, simulation=TIGHT, optimiser=GaussNewton(tolerance=1e-4)))
    for one, other in zip(found[0].estimates, found[1].estimates, strict=True):
        assert one.value == pytest.approx(other.value, abs=0.05 * one.std)


def test_a_plant_that_moves_when_its_log_begins(lag: Model) -> None:
    """Held at rest the parameters are wrong; near rest they are right, and held-out logs get states of their own."""
    t = np.arange(0, 3, 0.02)
    away = [
        m.log(t, t, m.ramp_answer(t, 2.0, 0.7) + x * np.exp(-t / 0.7) + m.NOISE * draw, f"{x}.txt", use)
        for x, use, draw in zip(
            (1.5, -0.8), ("fit", "validate"), np.random.default_rng(2).normal(size=(2, t.size)), strict=True
        )
    ]
    found = {
        initial: fit(problem(lag, [m.dataset(away)], ["K", "T"], treatment=Treatment(initial=initial)))
        for initial in ("near rest", "rest", "estimate")
    }
    for initial in ("near rest", "estimate"):
        for name, truth in (("K", 2.0), ("T", 0.7)):
            low, high = found[initial][name].interval
            assert low < truth < high
        assert found[initial].held_out()["-0.8.txt: y"] == pytest.approx(1.0, abs=0.2)
    assert abs(found["rest"]["T"].value - 0.7) > 0.2


def test_a_log_at_rest_costs_little(lag: Model) -> None:
    """The width of the intervals of white residuals, with and without free initial states."""
    width = {}
    for initial in ("near rest", "rest"):
        this = task(lag, initial)
        point = at(this, this.space.to_search(np.array([2.0, 0.7])))
        width[initial] = np.sqrt(np.diag(np.linalg.inv(point.jacobian.T @ point.jacobian)))
    assert np.all(width["near rest"] < 1.05 * width["rest"])


def test_every_row_has_a_block_and_every_block_some_of_every_log(lag: Model) -> None:
    this = task(lag)
    point = at(this, this.space.to_search(np.array([2.0, 0.7])))
    assert point.blocks.shape == point.series.shape == point.residual.shape == (len(point.jacobian),)
    assert set(point.blocks) == set(range(24))
    for number in (0, 1):  # the logs over time
        assert set(point.blocks[point.series == number]) == set(range(24))
    sines = [point.blocks[point.series == number] for number in set(point.series) if number > 1]
    assert len({block for one in sines for block in one}) == 2  # a steady sine is one cluster


def test_a_free_start_value_is_not_free_twice(lag: Model) -> None:
    this = problem(lag, [m.dataset(records())], ["K", Parameter("x", record="b.txt")])
    free = {run.record: run.free.size for one in this.observations for run in one.runs}
    assert (free["log.txt"], free["b.txt"]) == (1, 0)
