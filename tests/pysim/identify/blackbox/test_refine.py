"""The search ends in a minimum, and inside its box."""

import numpy as np

from pysim.identify.blackbox import Structure
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.refine import STABLE_MARGIN, refine
from pysim.identify.blackbox.response import whitening
from pysim.identify.blackbox.sections import from_poles, to_poles
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

F = np.geomspace(0.1, 20, 40)


def problem(data, structure, weights="uniform"):
    return Problem.of(data, structure, whitening(data, weights))


def test_from_a_start_far_off_to_the_exact_poles() -> None:
    function = from_roots([], [*pairs(-4 + 30j), -8.0], 7e3)
    tried = problem(exact(function, F), Structure(3))
    found = refine(tried, from_poles(np.array([-0.3 + 4j, -0.3 - 4j, -4.0])))
    assert found.converged
    np.testing.assert_allclose(np.sort_complex(to_poles(found.unknowns) * tried.scale), np.sort_complex(function.poles))
    assert not found.at_bound.any()


def test_a_minimum_has_no_slope_and_no_neighbour_below() -> None:
    tried = problem(noisy(from_roots([], pairs(-4 + 30j), 900.0), F, 0.02, seed=3), Structure(2, dead_time_max=0.05))
    found = refine(tried, np.array([1.0, 3.0, 0.1]))
    step = np.random.default_rng(0).standard_normal((50, 3)) * 1e-3
    assert all(tried.evaluate(np.abs(found.unknowns + s)).cost >= found.point.cost for s in step)


def test_stability_is_a_condition_of_the_search_not_a_flip_afterwards() -> None:
    function = from_roots([], [0.5, -60.0], 100.0)  # unstable truth
    tried = problem(exact(function, F), Structure(2, stable=True))
    found = refine(tried, from_poles(np.array([-0.5, -60.0], dtype=complex) / tried.scale))
    mirrored = tried.evaluate(from_poles(np.array([-0.5, -60.0], dtype=complex) / tried.scale))
    assert np.all(to_poles(found.unknowns).real <= 0)
    assert found.at_bound.any()
    assert found.unknowns[found.at_bound].max() == STABLE_MARGIN
    assert found.point.cost < 0.95 * mirrored.cost


def test_the_dead_time_stays_in_its_range() -> None:
    tried = problem(
        exact(from_roots([], [-5.0], 5.0, dead_time=0.1), F), Structure(1, dead_time=0.01, dead_time_max=0.05)
    )
    found = refine(tried, np.array([1.0, 0.02 * tried.scale]))
    assert found.unknowns[-1] == 0.05 * tried.scale
    assert found.at_bound.tolist() == [False, True]


def test_gives_up_after_so_many_evaluations() -> None:
    tried = problem(exact(from_roots([], pairs(-4 + 30j), 900.0), F), Structure(2))
    assert not refine(tried, np.array([9.0, 90.0]), most=2).converged
