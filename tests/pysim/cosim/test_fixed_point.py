"""Accelerated iteration on equations whose solution is known."""

import numpy as np
import pytest

from pysim.cosim._fixed_point import NotConverged, fixed_point


@pytest.mark.parametrize("n", [1, 2, 5])
def test_a_linear_map_takes_its_size_and_two(n: int) -> None:
    random = np.random.default_rng(n)
    matrix, shift = 3 * random.standard_normal((n, n)), random.standard_normal(n)  # plain iteration runs away
    x, count = fixed_point(lambda x: matrix @ x + shift, np.zeros(n), np.ones(n), rtol=1e-8, limit=n + 2)
    assert x == pytest.approx(np.linalg.solve(np.eye(n) - matrix, shift), rel=1e-6)
    assert count <= n + 2


def test_magnitudes_may_differ_by_far() -> None:
    matrix, shift = np.array([[0.3, 1e8], [2e-9, -0.4]]), np.array([1e7, 0.1])
    x, _ = fixed_point(lambda x: matrix @ x + shift, np.zeros(2), np.zeros(2), rtol=1e-12, limit=10)
    assert x == pytest.approx(np.linalg.solve(np.eye(2) - matrix, shift), rel=1e-10)


def test_a_nonlinear_one_and_none() -> None:
    x, _ = fixed_point(np.cos, np.ones(1), np.zeros(1), rtol=1e-13, limit=20)
    assert x[0] == pytest.approx(0.7390851332151607, rel=1e-12)
    with pytest.raises(NotConverged) as caught:
        fixed_point(lambda x: x + np.array([0.0, 1.0]), np.zeros(2), np.ones(2), rtol=1e-8, limit=20)
    assert caught.value.worst == 1
    assert fixed_point(np.cos, np.zeros(0), np.zeros(0), rtol=1e-8, limit=3)[1] == 1
