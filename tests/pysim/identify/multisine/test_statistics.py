"""Intervals cover what they claim, and the test for distortion cries wolf as often as it says."""

import numpy as np
import pytest
from scipy import stats

from pysim.identify.multisine import distortion_p_value, gain_interval, gain_radius, pooled, variance_interval
from pysim.identify.multisine.statistics import added, difference_interval, distortion_level, plain_level
from pysim.types import BestLinearApproximation, MultisineTest

RUNS = 20000  # a coverage of 95 percent is then known to 0.15 percent (one sigma)


def draws(variance: float, degrees: float, seed: int) -> np.ndarray:
    return variance * np.random.default_rng(seed).chisquare(degrees, RUNS) / degrees


def test_interval_of_a_variance() -> None:
    low, high = variance_interval(draws(3.0, 8.0, 0), np.full(RUNS, 8.0))
    assert np.mean((low < 3.0) & (high > 3.0)) == pytest.approx(0.95, abs=0.006)


@pytest.mark.parametrize("first", [1.0, 1.5, 4.0, 100.0])
@pytest.mark.parametrize("degrees", [(4.0, 20.0), (12.0, 60.0), (2.0, 16.0)])
def test_interval_of_a_difference(first: float, degrees: tuple[float, float]) -> None:
    a, b = draws(first, degrees[0], 1), draws(1.0, degrees[1], 2)
    low, high = difference_interval(a, np.full(RUNS, degrees[0]), b, np.full(RUNS, degrees[1]))
    # the method's authors found 94.5 to 97 percent for such sizes
    assert 0.944 < np.mean((low <= first - 1.0) & (high >= first - 1.0)) < 0.972


def test_the_lower_end_is_above_zero_where_the_f_test_says_so() -> None:
    a, b = draws(2.0, 6.0, 3), draws(1.0, 10.0, 4)
    low, _ = difference_interval(a, np.full(RUNS, 6.0), b, np.full(RUNS, 10.0))
    np.testing.assert_array_equal(low > 0, a / b > stats.f.isf(0.025, 6, 10))


def test_sums_of_levels_keep_their_coverage() -> None:
    a, b = draws(2.0, 10.0, 5), draws(5.0, 6.0, 6)
    f = np.arange(1.0, RUNS + 1)
    total = added(plain_level(f, a, np.full(RUNS, 10.0)), plain_level(f, b, np.full(RUNS, 6.0)))
    assert 0.94 < np.mean((total.low < 7.0) & (total.high > 7.0)) < 0.98


@pytest.mark.parametrize("degrees", [(2.0, 16.0), (6.0, 48.0), (12.0, 400.0)])
def test_p_values_of_pure_noise_are_not_too_small(degrees: tuple[float, float]) -> None:
    rng, lines, runs = np.random.default_rng(7), 40, 700
    first = rng.chisquare(degrees[0], (runs, lines)) / degrees[0]
    second = rng.chisquare(degrees[1], (runs, lines)) / degrees[1]
    f, one = np.arange(1.0, lines + 1), np.ones(lines)
    p = [
        distortion_p_value(distortion_level(f, a, degrees[0] * one, b, degrees[1] * one))
        for a, b in zip(first, second, strict=True)
    ]
    share = np.mean(np.array(p) < 0.05)
    assert 0.02 < share < 0.07  # at most 5 percent, and no less than half of it; 700 runs know it to 0.8 percent


def test_p_values_see_a_little_everywhere_and_a_lot_at_one_line() -> None:
    rng = np.random.default_rng(8)
    f, one = np.arange(1.0, 41.0), np.ones(40)
    noise = rng.chisquare(40, 40) / 40
    everywhere = distortion_level(f, 2.5 * rng.chisquare(6, 40) / 6, 6 * one, noise, 40 * one)
    assert distortion_p_value(everywhere) < 1e-4
    power = rng.chisquare(6, 40) / 6
    power[17] = 30.0
    assert distortion_p_value(distortion_level(f, power, 6 * one, noise, 40 * one)) < 1e-4
    assert distortion_p_value(distortion_level(f, one, 6 * one, 0 * one, 40 * one)) == 0.0


def test_pooling_is_a_mean_over_the_nearest_lines() -> None:
    f, one = np.arange(1.0, 11.0), np.ones(10)
    level = pooled(distortion_level(f, f, 2 * one, 0.5 * one, 8 * one), np.array([1.5, 5.6, 30.0]), 4)
    np.testing.assert_allclose(level.power, [2.5, 5.5, 8.5])
    np.testing.assert_allclose(level.variance, [2.0, 5.0, 8.0])
    np.testing.assert_allclose(level.degrees, 8.0)
    np.testing.assert_allclose(level.noise_degrees, 32.0)


@pytest.mark.parametrize("count", [3, 6, 12])
def test_pooling_lines_that_share_data_makes_nothing_surer_than_it_is(count: int) -> None:
    """Moving means over nine lines of noise alone, against noise that neighbours do not share."""
    rng, lines, width, runs = np.random.default_rng(9), 120, 9, 300
    f, one = np.arange(1.0, lines + 1), np.ones(lines)
    covered, alarms = [], 0
    for _ in range(runs):
        power = np.convolve(rng.exponential(1.0, lines + width - 1), np.ones(width) / width, "valid")
        noise = rng.chisquare(16, lines) / 16
        level = distortion_level(f, power, 2 * width * one, noise, 16 * one, shared=width)
        mean = pooled(level, f[20:100], count)
        covered.append(np.mean((mean.low < 0) & (mean.high > 0)))
        alarms += distortion_p_value(mean) < 0.05
    assert np.mean(covered) > 0.94  # 0.85 to 0.69 where the lines count as independent
    assert alarms <= stats.binom.isf(0.001, runs, 0.05)


def test_a_gain_s_interval_has_half_of_its_variance_and_the_circle_all_of_it() -> None:
    """Quantiles from printed tables: t(0.975; 8) = 2.306 and F(0.95; 2, 8) = 4.459."""
    test, row = MultisineTest("u", "y", "V", "m", 1.0, 0.5, 2.0, 3, 4), np.ones(1)
    bla = BestLinearApproximation(row, 2j * row, 0.08 * row, 8 * row, None, test, "robust", "a", row, 0.0, 1.0)
    size, phase = gain_interval(bla)
    np.testing.assert_allclose([size[0], phase[0]], [2.306 * 0.2, 2.306 * 0.2 / 2], rtol=2e-4)
    np.testing.assert_allclose(gain_radius(bla), np.sqrt(4.459 * 0.08), rtol=2e-4)
