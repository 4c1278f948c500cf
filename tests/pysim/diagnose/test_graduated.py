"""A mass that swings out of step with the model: smoothed, the sum of squares has one valley."""

from functools import partial

import numpy as np

from pysim.diagnose.descent import descend
from pysim.diagnose.graduated import WIDTHS, Smoothing, graduated, is_far
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.optimiser import Bounds
from pysim.simulate import Rodas
from pysim.types import Signal
from tests.pysim.diagnose.bench import Bench
from tests.pysim.diagnose.toy import base

TRUTH = {"m": 1.1, "d": 0.05, "k": 34.0}
NOISE = 2e-3  # m


def ringing(seed: int) -> tuple[Ruler, Extended]:
    """A staircase of pushes; at each the mass rings for a long time, at 34 N/m where the model has 20."""
    times = np.arange(0, 30, 0.02)
    rng, knots, swing = np.random.default_rng(seed), np.arange(0, 30.01, 0.02), np.zeros(1501)
    for edge, height in ((2, 4.0), (9, -7.0), (16, 9.0), (23, -6.0)):
        swing += height * 0.5 * (1 - np.cos(np.pi * np.clip((knots - edge) / 0.2, 0, 1)))
    push = Signal.through(knots, swing)
    ruler, what = Bench(("F", "N"), ("x", "m"), NOISE).measured(base(), times, push, TRUTH, rng)
    return ruler.with_other(solver=Rodas(rtol=1e-7, atol=1e-7)), what


def test_what_is_slow_leads_where_a_plain_descent_is_caught() -> None:
    ruler, what = ringing(seed=3)
    first = ruler.evaluation(what, what.space.to_search(what.space.start))
    caught = descend(partial(ruler.at, what), first, Bounds(*what.space.bounds()), steps=30)
    assert is_far(ruler, caught)
    end = refit(ruler, what, first)
    assert end.cost / end.residual.size < 1.1
    for name, value in what.space.values(end.x).items():
        assert abs(value / TRUTH[name] - 1) < 0.02, name


def test_near_the_end_nothing_is_smoothed() -> None:
    ruler, what = ringing(seed=4)
    there = ruler.evaluation(what, what.space.to_search(np.array([TRUTH[name] for name in what.space.keys])))
    assert not is_far(ruler, there)
    found = graduated(ruler, what, there)
    assert found is not None
    assert found.cost < there.cost * 1.1


def test_smoothing_keeps_white_noise_white_in_size_and_lets_other_rows_pass() -> None:
    rng = np.random.default_rng(5)
    smooth = Smoothing(((3, 4000, 2),), WIDTHS[1])
    rows = rng.standard_normal((8010, 2))
    found = smooth(rows)
    np.testing.assert_array_equal(found[:3], rows[:3])
    np.testing.assert_array_equal(found[8003:], rows[8003:])
    assert smooth.size == 8000
    assert abs(found[3:8003].var() - 1) < 0.15
    np.testing.assert_allclose(smooth(rows[:, 0]), found[:, 0])
    one = np.zeros(8010)
    one[3 + 2 * 2000] = 1.0  # of the first signal
    spread = smooth(one)[3:8003].reshape(4000, 2)
    assert not spread[:, 1].any()
    place = np.arange(4000) - 2000.0
    width = np.sqrt((place**2 * spread[:, 0]).sum() / spread[:, 0].sum())
    assert abs(width - 25) < 0.1  # samples: a 160th of 4000
