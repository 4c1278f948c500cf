import numpy as np
import pytest
from scipy.optimize import lsq_linear

from pysim.identify.greybox.least_squares import damped_step

WIDE = np.full(3, 100.0)


def test_inside_the_bounds_it_solves_the_damped_normal_equations() -> None:
    rng = np.random.default_rng(1)
    triangle, right = np.triu(rng.standard_normal((3, 3))), rng.standard_normal(3)
    wanted = np.linalg.solve(triangle.T @ triangle + 0.3 * np.eye(3), triangle.T @ right)
    assert damped_step(triangle, right, 0.3, -WIDE, WIDE) == pytest.approx(wanted)


def test_a_bound_holds_one_number_and_the_others_make_the_best_of_it() -> None:
    triangle, right = np.array([[1.0, 0.5], [0.0, 1.0]]), np.array([3.0, 1.0])
    high = np.array([1.0, 100.0])
    found = damped_step(triangle, right, 0.0, -high, high)
    assert found == pytest.approx([1.0, (0.5 * (3 - 1) + 1) / 1.25])


def test_where_exchanges_of_all_numbers_would_repeat_the_answer_is_that_of_another_method() -> None:
    """SciPy's, on numbers that do nearly the same: of these every seventh set of bounds comes back."""
    rng = np.random.default_rng(5)
    for _ in range(150):
        n = int(rng.integers(3, 12))
        alike = 10 ** rng.uniform(0, 3) * rng.standard_normal((2 * n, 1)) * rng.choice([-1, 1], n)
        triangle = np.linalg.qr(rng.standard_normal((2 * n, n)) + alike)[1]
        right, low, high = 10 * rng.standard_normal(n), -rng.random(n), rng.random(n)
        damping = 1e-10 * np.linalg.norm(triangle, 2) ** 2
        matrix, longer = np.vstack([triangle, np.sqrt(damping) * np.eye(n)]), np.concatenate([right, np.zeros(n)])
        other = lsq_linear(matrix, longer, (low, high), method="bvls", tol=1e-14, max_iter=1000 * n)
        found = damped_step(triangle, right, damping, low, high)
        assert np.all((found >= low) & (found <= high))
        assert 0.5 * np.sum((matrix @ found - longer) ** 2) == pytest.approx(other.cost, rel=1e-12)


def test_with_many_numbers_at_their_bounds_no_step_within_them_is_better() -> None:
    """The conditions of Karush, Kuhn and Tucker, where far more exchanges than numbers are needed."""
    n = 14
    for seed in range(60):
        rng = np.random.default_rng(seed)
        alike = rng.standard_normal((40, 4)) @ rng.standard_normal((4, n))
        triangle = np.linalg.qr(alike + 0.05 * rng.standard_normal((40, n)))[1]
        right, low = 5 * rng.standard_normal(n), -(10.0 ** rng.uniform(-2, 0.5, n))
        high = 10.0 ** rng.uniform(-2, 0.5, n)
        found = damped_step(triangle, right, 1e-6, low, high)
        assert np.all(found >= low - 1e-12)
        assert np.all(found <= high + 1e-12)
        uphill = triangle.T @ (triangle @ found - right) + 1e-6 * found
        still = 1e-6 * np.linalg.norm(triangle, axis=0) * np.linalg.norm(right)
        assert np.all(uphill[found < high - 1e-12] > -still[found < high - 1e-12])
        assert np.all(uphill[found > low + 1e-12] < still[found > low + 1e-12])
