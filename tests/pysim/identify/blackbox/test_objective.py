"""The misfit over poles and dead time: its numerator is optimal, its gradient exact."""

import numpy as np

from pysim.identify.blackbox import Structure
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.response import whiten, whitening
from tests.pysim.identify.blackbox.systems import from_roots, noisy, pairs

F = np.geomspace(0.1, 30, 25)
SYSTEM = from_roots([-20.0], [*pairs(-5 + 30j), -12.0], 50.0, 0.01)
PROBLEM = Problem.of(
    noisy(SYSTEM, F, 0.01, seed=1),
    Structure(3, 1, dead_time_max=0.1),
    whitening(noisy(SYSTEM, F, 0.01, seed=1), "covariance"),
)
AT = np.array([0.9, 0.7, 5.0, 0.3])


def test_numerator_is_the_best_for_these_poles() -> None:
    point = PROBLEM.evaluate(AT)
    left_over = PROBLEM.white - whiten(PROBLEM.roots, point.model[:, None])[:, 0]
    np.testing.assert_allclose(point.cost, left_over @ left_over)
    s, delay = PROBLEM.s, np.exp(-0.3 * PROBLEM.s)
    columns = np.column_stack([s, np.ones_like(s)]) * (delay / ((s + 0.9) * (s**2 + 0.7 * s + 5.0)))[:, None]
    _, left, *_ = np.linalg.lstsq(whiten(PROBLEM.roots, columns), PROBLEM.white, rcond=None)
    np.testing.assert_allclose(point.cost, left[0])


def test_gradient_and_slopes_agree_with_differences() -> None:
    point = PROBLEM.evaluate(AT)
    gradient = 2 * PROBLEM.jacobian(point).T @ point.residual
    for i, step in enumerate(1e-6 * np.eye(4)):
        costs = [PROBLEM.evaluate(AT + sign * step).cost for sign in (1, -1)]
        np.testing.assert_allclose((costs[0] - costs[1]) / 2e-6, gradient[i], rtol=1e-6)
    moved = point.model * np.exp(-1e-7 * PROBLEM.s)
    np.testing.assert_allclose((moved - point.model) / 1e-7, point.slopes[:, 3], rtol=1e-4, atol=1e-6)
