import zlib
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from pysim.identify.greybox.least_squares import GaussNewton
from pysim.identify.greybox.residuals import Carried, OwnStep, Point
from pysim.identify.greybox.search import search
from pysim.types import BadInput, FitOutcome
from tests.pysim.identify.greybox.functions import (
    beside_a_bent_state,
    evaluating,
    linear,
    rosenbrock,
    rosenbrock_slopes,
    space,
)


def test_a_linear_problem_is_solved_as_by_least_squares() -> None:
    a, b = linear(1, 30, 4)
    s = space([0.0] * 4)
    state = search(evaluating(lambda x: a @ x - b, lambda x: a), GaussNewton(tolerance=1e-18), s, s.start, squares=True)
    assert state.outcome is FitOutcome.CONVERGED
    assert state.best.x == pytest.approx(np.linalg.lstsq(a, b, rcond=None)[0], abs=1e-9)


def test_bounds_are_kept_and_met_exactly() -> None:
    a, b = linear(2, 30, 5)
    low, high = [-0.02] * 5, [0.1] * 5
    s = space([0.0] * 5, low, high)
    state = search(evaluating(lambda x: a @ x - b, lambda x: a), GaussNewton(tolerance=1e-18), s, s.start, squares=True)
    expected = lsq_linear(a, b, (low, high), tol=1e-14, method="bvls")
    assert np.count_nonzero(expected.active_mask) >= 2
    assert state.best.x == pytest.approx(expected.x, abs=1e-7)
    at_bound = expected.active_mask != 0
    assert np.all((state.best.x == low) | (state.best.x == high) | ~at_bound)


def test_a_bent_valley_is_followed_to_its_end() -> None:
    s = space([-1.2, 1.0])
    evaluate = evaluating(rosenbrock, rosenbrock_slopes)
    state = search(evaluate, GaussNewton(tolerance=1e-16), s, s.start, squares=True)
    assert state.outcome is FitOutcome.CONVERGED
    assert state.best.x == pytest.approx([1.0, 1.0], abs=1e-6)


def test_a_bad_point_is_a_step_that_is_not_taken() -> None:
    s = space([-1.2, 1.0])
    met = []

    def bad(x: np.ndarray) -> bool:
        met.append(bool(x[1] < -1))
        return met[-1]

    evaluate = evaluating(rosenbrock, rosenbrock_slopes, bad=bad)
    state = search(evaluate, GaussNewton(tolerance=1e-16, radius=8.0), s, s.start, squares=True)
    assert any(met)
    assert state.best.x == pytest.approx([1.0, 1.0], abs=1e-6)


def test_a_start_that_cannot_be_simulated_is_an_outcome() -> None:
    s = space([0.0, 0.0])
    evaluate = evaluating(rosenbrock, rosenbrock_slopes, bad=lambda x: True)
    state = search(evaluate, GaussNewton(), s, s.start, squares=True)
    assert state.outcome is FitOutcome.NO_START
    assert "does not run here" in state.message


def test_nothing_is_walked_along_a_direction_without_slope() -> None:
    """Only p0 + p1 matters: from (2, 0) the nearest point of p0 + p1 = 5 is (3.5, 1.5)."""
    s = space([2.0, 0.0])
    evaluate = evaluating(lambda x: np.array([x[0] + x[1] - 5.0]), lambda x: np.array([[1.0, 1.0]]))
    state = search(evaluate, GaussNewton(tolerance=1e-20, radius=10.0), s, s.start, squares=True)
    assert state.best.x == pytest.approx([3.5, 1.5], abs=1e-6)


def test_it_says_when_the_limit_of_points_is_reached() -> None:
    s = space([-1.2, 1.0])
    evaluate = evaluating(rosenbrock, rosenbrock_slopes)
    state = search(evaluate, GaussNewton(max_iterations=3, tolerance=1e-16), s, s.start, squares=True)
    assert (state.outcome, state.tried) == (FitOutcome.ITERATION_LIMIT, 3)


def test_a_valley_that_bends_has_an_end() -> None:
    """1000 (1 + 0.01 x^2)^2 is least at zero; along straight lines of the residuals the gain seems 500 everywhere."""
    noise = np.where(np.arange(1000) % 2, 1.0, -1.0)
    evaluate = evaluating(lambda x: noise * (1 + 0.01 * x[0] ** 2), lambda x: 0.02 * x[0] * noise[:, None])
    s = space([3.0])
    state = search(evaluate, GaussNewton(), s, s.start, squares=True)
    assert state.outcome is FitOutcome.CONVERGED, state.message
    assert state.best.x == pytest.approx([0.0], abs=0.1)


@pytest.mark.parametrize("seed", range(5))
def test_costs_that_jump_from_point_to_point_end_the_search_near_the_optimum(seed: int) -> None:
    """Linear residuals of unit noise, on 30 of them a jump of 0.01 that no slope tells, as step control leaves it."""
    a, b = linear(seed, 10_000, 4)
    optimum = np.linalg.lstsq(a, b, rcond=None)[0]

    def jumping(x: np.ndarray) -> np.ndarray:
        rng = np.random.default_rng(zlib.crc32(x.tobytes()))
        return np.asarray(a @ x - b + np.append(rng.normal(0.0, 0.01, 30), np.zeros(len(b) - 30)))

    s = space((optimum + 0.3).tolist())
    state = search(evaluating(jumping, lambda x: a), GaussNewton(tolerance=5e-3), s, s.start, squares=True)
    assert state.outcome is FitOutcome.CONVERGED, state.message
    assert np.linalg.norm(a @ (state.best.x - optimum)) < 0.1  # standard deviations of the estimates
    assert state.tried <= 6


def test_a_start_whose_cost_is_low_by_luck_ends_the_search() -> None:
    """What it promises is 0.2 nats, which a cost that is too low by 1 hides: shorter steps would find it no sooner."""
    a, b = linear(1, 10_000, 4)
    optimum = np.linalg.lstsq(a, b, rcond=None)[0]
    away = np.array([1.0, 0.0, 0.0, 0.0])
    s = space((optimum + away * np.sqrt(0.4) / np.linalg.norm(a @ away)).tolist())
    exact = evaluating(lambda x: a @ x - b, lambda x: a)

    def lucky(x: np.ndarray, carried: Carried) -> Point:
        point = exact(x, carried)
        return replace(point, cost=point.cost - 1.0) if np.array_equal(x, s.start) else point

    state = search(lucky, GaussNewton(), s, s.start, squares=True)
    assert (state.outcome, state.tried) == (FitOutcome.CONVERGED, 1)


def test_a_slope_that_lies_ends_in_a_stall() -> None:
    s = space([1.0])
    evaluate = evaluating(lambda x: 10 * x * np.ones(1000), lambda x: -10 * np.ones((1000, 1)))
    state = search(evaluate, GaussNewton(), s, s.start, squares=True)
    assert state.outcome is FitOutcome.STALLED
    assert state.best.x == pytest.approx([1.0], abs=1e-3)


@pytest.mark.parametrize("setting", ["max_iterations", "tolerance", "radius"])
def test_settings_must_be_positive(setting: str) -> None:
    with pytest.raises(BadInput, match=setting):
        GaussNewton(**{setting: 0})


def test_a_state_whose_own_steps_fail_does_not_hold_the_parameters_up() -> None:
    s = space([-5.0])
    points = [
        search(beside_a_bent_state, GaussNewton(max_iterations=n, radius=10.0), s, s.start, squares=True)
        for n in (3, 30)
    ]
    assert points[0].best.x == pytest.approx([2.0], abs=0.5)  # the second point: the parameter alone, and on
    assert points[1].outcome is FitOutcome.CONVERGED
    assert points[1].best.carried.states[0] == pytest.approx([0.5 * np.log(2)], abs=0.1)


def test_damped_steps_beside_the_parameters_are_those_of_levenberg_and_marquardt() -> None:
    rng = np.random.default_rng(4)
    slopes, residual = rng.normal(size=(20, 3)), rng.normal(size=20)
    size = np.linalg.norm(slopes, axis=0)
    u, sizes, vt = np.linalg.svd(slopes / size, full_matrices=False)
    own = OwnStep(np.zeros((3, 0)), vt.T / size[:, None], sizes, u.T @ residual, np.zeros((3, 0)))
    point = Point(np.zeros(0), 1.0, residual, np.zeros((20, 0)), steps=(own,))
    for damping in (0.0, 0.3, 1e3):
        step = -np.linalg.solve(slopes.T @ slopes + damping * np.diag(size**2), slopes.T @ residual)
        assert own.at(damping) == pytest.approx(step)
        after = residual + slopes @ step
        assert point.own_gain(damping) == pytest.approx(0.5 * float(residual @ residual - after @ after))
        assert point.own_length(damping) == pytest.approx(float(np.linalg.norm(size * step)))
        assert point.own_damping(point.own_length(damping)) == pytest.approx(damping, rel=0.1, abs=1e-9)
    assert not own.at(np.inf).any()
