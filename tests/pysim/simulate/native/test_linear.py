import numpy as np
import pytest

from pysim.simulate.native.compiled import entry
from pysim.simulate.native.linear import factorise, solve

rng = np.random.default_rng(1)


@entry
def _solve(matrix, pivots, right, n):
    done = factorise(matrix.ctypes.data, pivots.ctypes.data, n)
    if done:
        solve(matrix.ctypes.data, pivots.ctypes.data, right.ctypes.data, n)
    return done


@pytest.mark.parametrize("n", [1, 2, 3, 7, 12])
def test_same_solution_as_lapack(n):
    for _ in range(20):
        matrix, right = rng.normal(size=(n, n)), rng.normal(size=n)
        matrix[rng.integers(n), rng.integers(n)] = 0.0
        matrix += np.roll(np.eye(n), 1, axis=0) * 3  # large entries off the diagonal: pivoting has to find them
        solution = right.copy()
        assert _solve(matrix.T.copy(), np.zeros(n, np.int64), solution, n)
        np.testing.assert_allclose(matrix @ solution, right, atol=1e-10)
        np.testing.assert_allclose(solution, np.linalg.solve(matrix, right), rtol=1e-7)


def test_singular_and_undefined_matrices_are_refused():
    for matrix in (np.zeros((2, 2)), np.array([[1.0, 2], [2, 4]]), np.array([[np.nan, 1], [1, 1]])):
        assert not _solve(matrix, np.zeros(2, np.int64), np.ones(2), 2)
