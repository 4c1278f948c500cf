"""What follows a model's signals, and what is only noise: residuals that are made up, of a model that is there."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.diagnosis.candidate import Models
from pysim.diagnosis.floors import Floors, white_floors
from pysim.diagnosis.left import Follows, follows
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.rivals import of
from pysim.types import Dataset, Record
from pysim.types.answer import FloorSource
from tests.pysim.diagnosis.plants import given, measured, refitted

Array = NDArray[np.float64]

NOISE, CHANNEL, SAMPLES = 1e-3, ("mass", "x"), 800


@cache
def data() -> Dataset:
    return measured("mass", fit=(1, 2), length=SAMPLES / 50)


@cache
def fit() -> FinalFit:
    return refitted(Models(given("mass", data(), ())))


@cache
def signals() -> Array:
    """(2, n_t, 2) command and simulated position of both logs."""
    rests = of(fit()).residual.reshape(2, SAMPLES)
    logs = [record.data for record in data().logs() if record.use == "fit"]
    return np.array([np.column_stack([log["F"], log["x"] - rest]) for log, rest in zip(logs, rests, strict=True)])


def leaving(rests: Array) -> FinalFit:
    """The refitted model as if its logs had left these (2, n_t), in m."""
    rest, point = rests.ravel(), fit().point
    size = float(np.sqrt(np.mean(rest**2)))
    made = replace(point, residual=rest / size, levels=np.array([size]), squares=np.array([rest @ rest]))
    return replace(fit(), state=replace(fit().state, best=made))


def found(rests: Array, blocks: int = 6) -> Follows:
    """As the logs would be that leave these."""
    records = list(data().records)
    for k, (own, rest) in enumerate(zip(signals(), rests, strict=True)):
        values = np.column_stack([own[:, 0], own[:, 1] + rest])
        records[k] = replace(records[k], data=replace(records[k].data, values=values))
    answer = follows(leaving(rests), replace(data(), records=tuple(records)), blocks)
    assert answer is not None
    return answer


def noise(seed: int, kept: float = 0.0) -> Array:
    """(2, n_t), each number the one before times `kept` and something new."""
    drawn = NOISE * np.random.default_rng(seed).standard_normal((2, SAMPLES))
    for t in range(1, SAMPLES if kept else 0):
        drawn[:, t] = kept * drawn[:, t - 1] + math.sqrt(1 - kept**2) * drawn[:, t]
    return drawn


def test_white_noise_follows_nothing() -> None:
    every = [found(noise(seed)) for seed in range(200)]
    assert sum(one.t > 3 for one in every) <= 1
    assert max(one.share for one in every) < 0.02


def test_a_signal_that_only_some_logs_have_is_left_out() -> None:
    rests = noise(1) + 1e-3 * signals()[:, :, 0]
    records = list(data().records)
    for k, (own, rest) in enumerate(zip(signals(), rests, strict=True)):
        log = records[k].data
        assert isinstance(log, Record)
        values = np.column_stack([own[:, 0], own[:, 1] + rest, own[:, 0] ** 2])
        names, units = (*log.names, "more")[: 2 + k], (*log.units, "1")[: 2 + k]
        records[k] = replace(records[k], data=replace(log, values=values[:, : 2 + k], names=names, units=units))
    answer = follows(leaving(rests), replace(data(), records=tuple(records)), 6)
    assert answer is not None
    assert answer == found(rests)
    assert answer.t > 3


def test_coloured_noise_follows_nothing() -> None:
    """It remembers five samples, and nothing of the command."""
    every = [found(noise(seed, 0.8)) for seed in range(40)]
    assert sum(one.t > 3 for one in every) <= 1
    assert max(one.share for one in every) < 0.1


@pytest.mark.parametrize(
    "law",
    [
        lambda u, x: np.abs(u) / np.abs(u).mean(),
        lambda u, x: np.sign(np.gradient(x, axis=1)),
        lambda u, x: np.roll(u, 16, axis=1) / u.std(),
    ],
)
def test_a_share_that_follows_the_signals_is_found(law: Callable[[Array, Array], Array]) -> None:
    part = NOISE * law(signals()[:, :, 0], signals()[:, :, 1])
    for seed in range(3):
        rest = noise(seed) + part
        answer, share = found(rest), np.sum(part**2) / np.sum(rest**2)
        assert answer.t > 3
        assert 0.8 * share < answer.share < 1.05 * share + 0.01


def test_too_few_samples_say_nothing() -> None:
    short = measured("mass", fit=(1,), length=8.0)
    assert follows(refitted(Models(given("mass", short, ()))), short, 6) is None


def test_the_floor_is_what_is_white_in_a_residual() -> None:
    """A slow misfit five times as large as the noise lies in few bands of the periodogram."""
    slow = 5 * NOISE * np.sin(2 * np.pi * 0.4 * np.arange(SAMPLES) / 50)
    floor = white_floors(leaving(3 * noise(1) + slow))[CHANNEL]
    assert floor.source is FloorSource.SPECTRUM
    assert floor.sd == pytest.approx(3 * NOISE, rel=0.1)


def test_the_floor_is_never_below_what_is_specified() -> None:
    floor = white_floors(leaving(0.2 * noise(1)))[CHANNEL]
    assert (floor.sd, floor.source) == (NOISE, FloorSource.SPECIFIED)


def test_what_is_left_is_counted_over_the_least_floor_that_any_model_showed() -> None:
    floors = Floors().with_(leaving(4 * noise(1))).with_(leaving(2 * noise(1))).with_(leaving(3 * noise(1)))
    worse = leaving(6 * noise(1))
    assert floors.over(worse)[CHANNEL] == pytest.approx(3.0, rel=0.1)
    ratio = floors.over(worse)[CHANNEL]
    assert floors.potential(worse) == pytest.approx(2 * SAMPLES * math.log(ratio))
    assert floors.potential(leaving(1e-3 * noise(1))) == 0.0


def test_a_short_log_is_judged_beside_a_long_one_that_logs_more() -> None:
    """As where a next test was run: it is short, and one of its signals was never logged before."""
    whole = measured("axis", fit=(1, 2), length=2 * SAMPLES / 50)
    first, *rest = whole.records
    assert isinstance(first.data, Record)
    names = ("x_ref", "x")
    short = Record(first.data.time[:100], np.column_stack([first.data[n][:100] for n in names]), names, ("m", "m"))
    joined = replace(whole, records=(replace(first, data=short), *rest))
    found = follows(refitted(Models(given("axis", joined, ()))), joined, 24)
    assert found is not None
    assert found.share < 0.02


def test_the_roughest_runs_are_as_rough_as_the_noise_forgives() -> None:
    floors, own = Floors().with_(fit()), fit()
    errors = {}
    for forgiven in (math.inf, 0.1, 0.003, 0.0):
        rough = floors.roughest(own, forgiven)
        errors[rough.simulation.solver.rtol] = difference = floors.between(own, rough)
        assert difference == pytest.approx(math.dist(of(own).residual, of(rough).residual) / NOISE / 40, rel=0.1)
        assert difference < forgiven or rough is own
    assert max(errors) == own.simulation.rough().solver.rtol
    assert len(errors) > 2
