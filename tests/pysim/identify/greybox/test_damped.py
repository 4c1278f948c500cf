from types import SimpleNamespace
from typing import Any

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


def test_where_the_active_set_loses_its_way_the_other_method_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    """As SciPy's did on a number that a rounding had put beyond its bound."""

    def lost(*args: Any, method: str, **words: Any) -> Any:
        if method == "bvls":
            return SimpleNamespace(x=np.full(2, np.nan))
        return lsq_linear(*args, method=method, **words)

    monkeypatch.setattr("scipy.optimize.lsq_linear", lost)
    triangle, right = np.array([[1.0, 0.5], [0.0, 1.0]]), np.array([3.0, 1.0])
    high = np.array([1.0, 100.0])
    found = damped_step(triangle, right, 0.0, -high, high)
    assert found == pytest.approx([1.0, (0.5 * (3 - 1) + 1) / 1.25], rel=1e-6)


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
