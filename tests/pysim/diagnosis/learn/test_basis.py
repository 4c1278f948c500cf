"""Knots and smoothness of a learned curve, against what a curve's definition and least squares demand."""

import numpy as np
import pytest

from pysim.diagnosis.learn.basis import Smoothness, bends, closer, knots, lines, missed, solve
from pysim.effects.learned import curve_basis


def test_knots_are_dense_around_zero_where_a_signal_crosses_it() -> None:
    k = knots(np.random.default_rng(1).uniform(-1.0, 1.0, 20_000), 9)
    steps = np.diff(k)
    assert np.all(steps > 0)
    assert k[4] == pytest.approx(0.0, abs=0.02)
    assert steps[1] > 4 * steps[3]
    assert -1.2 < k[0] < -1.0
    assert 1.0 < k[-1] < 1.2


@pytest.mark.parametrize("low", [-20.0, -1.0, -0.05, 1.0, 2.0])
def test_a_straight_line_is_a_curve_over_all_samples(low: float) -> None:
    """To a ten-thousandth of its range, next to the ends too, which few samples reach."""
    z = np.linspace(low, 20.0, 4001)
    z = z + 0.1 * (z > 19.9)
    basis = curve_basis(z, knots(z, 13))
    line = basis @ np.linalg.lstsq(basis, z, rcond=None)[0]
    assert np.abs(line - z).max() < 1e-4 * np.ptp(z)


@pytest.mark.parametrize(("low", "high"), [(2.0, 3.0), (1.0, 1000.0), (-5.0, -4.0), (7.0, 7.0)])
def test_knots_increase_over_any_range(low: float, high: float) -> None:
    assert np.all(np.diff(knots(np.linspace(low, high, 1000), 9)) > 0)


def test_more_knots_come_where_straight_lines_miss_most() -> None:
    k = np.linspace(-1.0, 1.0, 9)
    found = closer(k, np.tanh(k / 0.01))
    assert found.size == 17
    assert set(k.tolist()) <= set(found.tolist())
    assert np.all(np.diff(found) > 0)
    assert np.diff(found).min() <= 0.25 / 4
    assert np.sum(np.abs(found) < 0.5) == 11


def test_a_parabola_gets_one_knot_more_in_each_interval_and_a_quarter_of_the_error() -> None:
    k = np.linspace(0.0, 2.0, 5)
    assert closer(k, k**2) == pytest.approx(np.linspace(0.0, 2.0, 9))
    assert missed(k, k**2) == pytest.approx(np.full(4, 0.25 * 0.5**2))


def test_a_straight_line_has_no_bends() -> None:
    k = np.array([-1.0, -0.2, 0.1, 2.0, 5.0])
    assert bends(k) @ (3.0 - 2.0 * k) == pytest.approx(np.zeros(3), abs=1e-12)
    assert np.abs(bends(k) @ k**2).min() > 0.1


def _regression(truth: np.ndarray, sd: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    z = np.random.default_rng(2).uniform(-1.0, 1.0, truth.size)
    k = np.linspace(-1.0, 1.0, 17)
    noise = sd * np.random.default_rng(3).standard_normal(truth.size)
    return z, k, noise


def test_the_data_say_how_smooth_a_curve_is() -> None:
    z, k, noise = _regression(np.zeros(2000), 0.3)
    columns = curve_basis(z, k)
    found = {}
    for name, truth in (("line", 1.0 + 2.0 * z), ("wave", np.sin(4 * z))):
        residual = -(truth + noise) / 0.3
        found[name] = solve(
            (columns / 0.3).T @ (columns / 0.3), (columns / 0.3).T @ residual, float(residual @ residual), 2000.0, k
        )
        grid = np.linspace(-0.95, 0.95, 50)
        shape = 1.0 + 2.0 * grid if name == "line" else np.sin(4 * grid)
        assert np.sqrt(np.mean((curve_basis(grid, k) @ found[name].values - shape) ** 2)) < 0.05
    assert found["line"].edf < 3
    assert 5 < found["wave"].edf < 14


def test_a_step_of_the_smoothness_comes_to_rest_where_restricted_likelihood_is_largest() -> None:
    z, k, noise = _regression(np.zeros(2000), 0.3)
    columns = curve_basis(z, k) / 0.3
    residual = -(np.sin(4 * z) + noise) / 0.3
    gram, right = columns.T @ columns, columns.T @ residual
    best = solve(gram, right, float(residual @ residual), 2000.0, k)
    smooth = Smoothness(k, 100 * best.smoothness.bending, best.smoothness.level)
    for _ in range(100):
        values = -np.linalg.solve(gram + smooth.precision, right)
        smooth = smooth.moved(gram, values)
    assert smooth.edf(gram) == pytest.approx(best.edf, rel=0.05)


def test_neither_level_nor_slope_of_a_law_that_the_data_tell_is_held_back() -> None:
    """A penalty that costs more than its two numbers, a nat, would make the law too small."""
    z, k, _ = _regression(np.zeros(2000), 1.0)
    columns = curve_basis(z, k) / 1e-4
    truth = 3.0 - 5.0 * k
    gram, right = columns.T @ columns, -columns.T @ columns @ truth
    smooth = Smoothness(k, 1.0, 1e-4 * float(np.trace(gram)) / k.size)
    for _ in range(5):
        values = -np.linalg.solve(gram + smooth.precision, right)
        smooth = smooth.moved(gram, values)
    values = -np.linalg.solve(gram + smooth.precision, right)
    assert smooth.level * float(np.sum((lines(k).T @ values) ** 2)) < 2.1
    assert values == pytest.approx(truth, abs=1e-4)


def test_a_curve_that_the_parameters_imitate_keeps_its_penalty() -> None:
    """Its information is the difference of two equal matrices, of which rounding of either sign is left."""
    before = Smoothness(np.linspace(-1, 1, 5), 2.0, 1e-3)
    after = before.moved(-1e-16 * np.eye(5), np.ones(5))
    assert (after.bending, after.level) == (2.0, 1e-3)
    assert np.all(np.isfinite(after.rows))
