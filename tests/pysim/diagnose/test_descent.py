"""Descent on sums of squares whose least is known."""

import numpy as np
import pytest

from pysim.diagnose.descent import Bowl, descend, mean_square
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.residuals import Point

Array = np.ndarray
FREE = Bounds(np.full(2, -10.0), np.full(2, 10.0))


def at(residual: Array, slopes: Array, x: Array) -> Point:
    return Point(x, float(residual @ residual), residual, slopes)


def test_a_straight_problem_ends_at_its_least_squares_solution() -> None:
    rng = np.random.default_rng(3)
    slopes, measured = rng.standard_normal((50, 2)) * 100, rng.standard_normal(50) * 100
    best = np.linalg.lstsq(slopes, measured, rcond=None)[0]
    found = descend(lambda x: slopes @ x - measured, at(-measured, slopes, np.zeros(2)), FREE, steps=20, tolerance=1e-9)
    assert found.x == pytest.approx(best, abs=1e-4)


def test_a_step_keeps_to_bounds_and_radius() -> None:
    # among many residuals, so that their mean square is 1
    slopes, residual = np.zeros((50_000, 2)), np.zeros(50_000)
    slopes[:2], residual[:2] = np.diag([100.0, 100.0]), [-200.0, -100.0]
    point = at(residual, slopes, np.zeros(2))
    held = Bowl.around(point, Bounds(np.zeros(2), np.array([0.5, 10.0]))).step(10.0, spare=0.0)
    assert held == pytest.approx([0.5, 1.0], rel=1e-3)
    near = Bowl.around(point, FREE).step(0.3)
    assert 0.25 < np.linalg.norm(near) <= 0.3
    bowl = Bowl.around(point, FREE)
    spared = bowl.step(10.0)
    assert np.linalg.norm(spared) < np.linalg.norm([2.0, 1.0])
    assert bowl.gain(spared) == pytest.approx(0.97 * 50_000, rel=0.01)
    assert bowl.gain(np.array([2.0, 1.0])) == pytest.approx(50_000)


def test_directions_without_slope_stay() -> None:
    slopes = np.zeros((50_000, 2))
    slopes[:2] = [[100.0, 100.0], [200.0, 200.0]]
    residual = slopes @ np.array([0.1, 0.1])
    step = Bowl.around(at(residual, slopes, np.zeros(2)), FREE).step(1.0, spare=0.0)
    assert step[0] == pytest.approx(step[1])
    assert step.sum() == pytest.approx(-0.2, rel=0.03)


def test_slopes_of_a_neighbour_are_corrected_on_the_way() -> None:
    """Rosenbrock's valley with slopes of a point beside it, and none given again."""

    def residual(x: Array) -> Array:
        return np.array([100 * (x[1] - x[0] ** 2), 10 * (1 - x[0])])

    start, beside = np.array([0.7, 0.4]), np.array([0.75, 0.5])
    slopes = np.array([[-200 * beside[0], 100.0], [-10.0, 0.0]])
    found = descend(residual, at(residual(start), slopes, start), FREE, steps=60, tolerance=1e-9)
    assert found.x == pytest.approx([1.0, 1.0], abs=1e-3)


def test_never_ends_worse_and_survives_points_that_cannot_be_had() -> None:
    def residual(x: Array) -> Array | None:
        return None if x[0] > 0.2 else np.array([100 * (x[0] - 1), 1.0])

    start = np.zeros(1)
    first = at(np.array([-100.0, 1.0]), np.array([[100.0], [0.0]]), start)
    bounds = Bounds(np.full(1, -9.0), np.full(1, 9.0))
    found = descend(residual, first, bounds, steps=12)
    assert 0.05 < found.x[0] <= 0.2
    wrong = at(np.array([-100.0, 1.0]), np.array([[-100.0], [0.0]]), start)  # slopes of the wrong sign
    assert descend(residual, wrong, bounds, steps=1).cost == wrong.cost


def test_mean_square_is_never_below_one() -> None:
    assert mean_square(at(np.full(4, 0.1), np.zeros((4, 1)), np.zeros(1))) == 1.0
    assert mean_square(at(np.full(4, 3.0), np.zeros((4, 1)), np.zeros(1))) == pytest.approx(9.0)


def test_a_step_that_the_bounds_leave_nothing_of_ends_it() -> None:
    slopes = np.array([[1e4, 0.0], [0.0, 1e-12]])
    first = at(np.array([0.0, 1.0]), slopes, np.array([0.0, 1.0]))
    none = Bounds(np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    assert descend(lambda x: np.array([1e4 * x[0], 1.0]), first, none, steps=5, tolerance=-1.0) == first
