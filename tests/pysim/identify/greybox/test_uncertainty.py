"""Intervals of an optimum with orthogonal columns, by hand, and of straight lines in noise of any colour."""

import numpy as np
import pytest
from scipy.stats import t as student

from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.uncertainty import Uncertainty, reach, uncertainty
from pysim.types import Direction, Estimate
from tests.pysim.identify.greybox.functions import space

NORMAL, NORMAL_ONE_SIDED = 1.959964, 1.644854  # 95 percent


def optimum(blocks: int = 1) -> Point:
    """Ten residuals of size 1; a unit of the first parameter moves them by 1 in all, one of the second by 2."""
    jacobian = np.zeros((10, 2))
    jacobian[:4, 0], jacobian[4:8, 1] = 0.5, 1.0
    signs = np.array([1.0, -1.0] * 5)
    return Point(np.array([5.0, -3.0]), 5.0, signs, jacobian, blocks=np.arange(10) * blocks // 10)


def test_few_blocks_give_the_interval_of_white_residuals() -> None:
    """Alternating residuals are as good as white ones: their score has no inflation."""
    found = uncertainty(space([5.0, -3.0]), optimum())
    assert found.blocks == 0
    excess = 10 / 8
    np.testing.assert_allclose(found.covariance, np.diag([1.0, 0.25]) * excess, atol=1e-12)
    quantile = student.ppf(0.975, 10 - 2)
    for one, std in zip(found.estimates, (1.0, 0.5), strict=True):
        reach = quantile * std * excess**0.5
        assert one.interval == pytest.approx((one.value - reach, one.value + reach), rel=1e-6)


def test_at_a_bound_the_interval_has_one_side() -> None:
    first, _ = uncertainty(space([5.0, -3.0], [5.0, -np.inf]), optimum()).estimates
    assert first.at == "lower"
    assert first.interval[0] == 5.0
    assert first.interval[1] > 5.0


def test_blocks_give_the_scatter_of_a_mean_and_its_degrees_of_freedom() -> None:
    """The mean of m equal blocks: the scatter of the block means over m - 1, with m - 1 degrees of freedom."""
    blocks, size = 12, 30
    y = np.random.default_rng(3).normal(size=blocks * size)
    rest = y - y.mean()
    point = Point(np.array([7.0]), 0.0, rest, np.ones((rest.size, 1)), blocks=np.arange(rest.size) // size)
    found = uncertainty(space([7.0]), point)
    means = rest.reshape(blocks, size).mean(axis=1)
    assert found.blocks == blocks
    assert found.covariance[0, 0] == pytest.approx(means @ means / (blocks * (blocks - 1)), rel=1e-9)
    reach = student.ppf(0.975, blocks - 1) * found.estimates[0].std
    assert found.estimates[0].interval == pytest.approx((7 - reach, 7 + reach), rel=1e-6)


def test_blocks_are_unbiased_for_white_residuals_however_uneven_their_leverage() -> None:
    """The covariance is quadratic in the residual: its mean is its sum over a basis of white noise."""
    rng = np.random.default_rng(4)
    rows = rng.normal(size=(60, 2))
    rows[:6, 1] *= 10.0  # the first of ten blocks knows most of the second
    left = np.eye(60) - rows @ np.linalg.pinv(rows)
    x = np.array([3.0, -2.0])
    total = np.zeros((2, 2))
    for rest in left:
        total += uncertainty(space(x.tolist()), Point(x, 0.0, rest, rows, blocks=np.arange(60) // 6)).covariance
    np.testing.assert_allclose(total, np.linalg.inv(rows.T @ rows), rtol=1e-9)


def test_what_one_block_alone_determines_has_the_interval_of_white_residuals() -> None:
    rows = np.zeros((60, 2))
    rows[6:, 0], rows[:6, 1] = 1.0, 1.0
    rest = np.tile([1.0, -1.0], 30)
    x = np.array([3.0, -2.0])
    found = uncertainty(space(x.tolist()), Point(x, 0.0, rest, rows, blocks=np.arange(60) // 6))
    assert found.covariance[1, 1] == pytest.approx(1 / 6)
    reach = NORMAL / 6**0.5
    assert found.estimates[1].interval == pytest.approx((-2 - reach, -2 + reach), rel=1e-6)


def slope_interval(noise: np.ndarray) -> Uncertainty:
    """Of the slope of a line through noise alone, with an offset beside it."""
    t = np.linspace(-1, 1, noise.size)
    columns = np.column_stack([np.ones_like(t), t])
    rest = noise - columns @ np.linalg.lstsq(columns, noise, rcond=None)[0]
    level = np.sqrt(np.mean(rest**2))
    blocks = np.arange(t.size) * 24 // t.size
    x = np.linalg.lstsq(columns, noise, rcond=None)[0]
    return uncertainty(space(x.tolist()), Point(x, 0.0, rest / level, -columns / level, blocks=blocks))


@pytest.mark.parametrize("memory", [0.0, 0.8])
def test_intervals_hold_the_truth_in_white_and_in_coloured_noise(memory: float) -> None:
    """Of 400 lines, 95 percent within the 99.9 percent binomial interval."""
    hits = 0
    for seed in range(400):
        draws = np.random.default_rng(seed).normal(size=600)
        noise = np.empty_like(draws)
        last = 0.0
        for i, draw in enumerate(draws):
            noise[i] = last = memory * last + draw
        low, high = slope_interval(noise).estimates[1].interval
        hits += low < 0.0 < high
    assert 0.91 < hits / 400 < 0.985


def test_a_ratio_tells_of_coloured_noise() -> None:
    noise = np.repeat(np.random.default_rng(1).normal(size=60), 10)
    assert slope_interval(noise).ratio[1] > 1.5


def test_a_direction_reaches_to_the_first_end_of_an_interval_that_it_meets() -> None:
    """T from 2 to 20 at 4, k from 1 to 8 at 2: T alone s = 0.5 to 5; with k by s^2, 0.707 to 2; by s^-1, 0.5 to 2."""
    ends = {"T": (4.0, 2.0, 20.0), "k": (2.0, 1.0, 8.0), "z": (0.0, -1.0, 1.0)}
    known = [
        Estimate(name, "1", value, value, low, high, 1.0, (low, high)) for name, (value, low, high) in ends.items()
    ]
    for exponents, expected in (
        ({"T": 1.0}, (0.5, 5.0)),
        ({"T": 1.0, "k": 2.0}, (0.5**0.5, 2.0)),
        ({"T": 1.0, "k": -1.0}, (0.5, 2.0)),
        ({"T": 1.0, "z": 1.0}, (0.5, 5.0)),
        ({"z": 1.0}, (0.0, np.inf)),
    ):
        assert reach(Direction(exponents, 50.0), known) == pytest.approx(expected)
    leak = Estimate("k", "1", 2.0, 2.0, 0.0, 10.0, 1.0, (0.0, 10.0))
    assert reach(Direction({"k": 1.0}, np.inf), [leak]) == pytest.approx((0.0, 5.0))
    assert reach(Direction({"k": -1.0}, np.inf), [leak]) == pytest.approx((0.2, np.inf))
