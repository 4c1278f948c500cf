"""Linear steps alone find exact systems, also of high order, and keep the asked-for degrees."""

import numpy as np
import pytest

from pysim.identify.blackbox import Structure
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.response import whitening
from pysim.identify.blackbox.sections import to_poles
from pysim.identify.blackbox.start import starts
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

CLUSTERS = from_roots(pairs(-0.3 + 5j, -1 + 8.2j, -30 + 305j), pairs(-0.5 + 3j, -0.2 + 8j, -0.3 + 8.5j, -3 + 300j), 1e3)


def problem(function, frequency, structure, weights="relative"):
    data = exact(function, frequency)
    return Problem.of(data, structure, whitening(data, weights))


def test_eighth_order_with_clusters_over_three_decades() -> None:
    tried = problem(CLUSTERS, np.geomspace(0.1, 100, 120), Structure(8, 6))
    best = starts(tried, 1)[0]
    assert tried.evaluate(best).cost < 1e-18 * 120
    found = np.sort_complex(to_poles(best) * tried.scale)
    np.testing.assert_allclose(found, np.sort_complex(CLUSTERS.poles), rtol=1e-6)


def test_an_unstable_pole_is_found_where_allowed_and_mirrored_where_not() -> None:
    function = from_roots([], [2.0, -10.0], 20.0)
    frequency = np.geomspace(0.05, 10, 30)
    free, held = (problem(function, frequency, Structure(2, stable=stable)) for stable in (False, True))
    np.testing.assert_allclose(np.sort(to_poles(starts(free, 1)[0]).real * free.scale), [-10, 2], rtol=1e-6)
    assert np.all(to_poles(starts(held, 1)[0]).real < 0)


def test_dead_times_are_tried_all_over_the_range() -> None:
    function = from_roots([], pairs(-3 + 20j), 400.0, dead_time=0.21)  # six turns of phase at 30 Hz
    tried = problem(function, np.linspace(0.5, 30, 60), Structure(2, dead_time_max=0.5))
    delays = [unknowns[-1] / tried.scale for unknowns in starts(tried, 3)]
    assert min(abs(delay - 0.21) for delay in delays) < 1 / (4 * 30)


def test_starts_differ_and_are_sorted() -> None:
    data = noisy(CLUSTERS, np.geomspace(0.1, 100, 60), 0.5, seed=5)
    tried = Problem.of(data, Structure(8, 6), whitening(data, "covariance"))
    found = starts(tried, 4)
    costs = [tried.evaluate(unknowns).cost for unknowns in found]
    assert len(found) == 4
    assert costs == sorted(costs)


def test_no_poles_leave_only_the_dead_time() -> None:
    function = from_roots([-5.0], [], 0.2, dead_time=0.03)
    tried = problem(function, np.linspace(1, 10, 20), Structure(0, 1, dead_time_max=0.1))
    assert all(unknowns.shape == (1,) for unknowns in starts(tried, 3))


@pytest.mark.parametrize("poles", [1, 3])
def test_odd_orders(poles: int) -> None:
    function = from_roots([], [-1.0, -4.0, -9.0][:poles], 3.0)
    tried = problem(function, np.geomspace(0.02, 5, 20), Structure(poles))
    assert tried.evaluate(starts(tried, 1)[0]).cost < 1e-20
