"""The system of a periodic orbit against NumPy: invertible, with directions that nothing holds, and with a mismatch."""

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.simulate import Esdirk
from pysim.simulate._job import Job
from pysim.simulate.kernel.library import kernel
from pysim.simulate.kernel.memory import work_arrays

Array = NDArray[np.float64]
LEAST = 1e-5


def solve(matrix: Array, right: Array) -> tuple[Array, float]:
    """Solution (n, m) and what is left of the first column."""
    n, m = right.shape
    job = Job(Esdirk())
    job.put("work", work_arrays(n, 0, 6, 4, True))
    job.put_shots(n, m - 1, 1, 1, 4, orbit=True)
    job.array("shooting", "matrix")[:] = matrix.T
    job.array("shooting", "right")[:] = right
    solved = np.zeros((n, m))
    return solved, kernel().solve_least(job.record, solved, LEAST)


@pytest.mark.parametrize("n", [1, 2, 5, 12])
def test_what_can_be_inverted_is(n: int) -> None:
    rng = np.random.default_rng(n)
    matrix, right = np.eye(n) - 0.3 * rng.normal(size=(n, n)), rng.normal(size=(n, 3))
    solved, left = solve(matrix, right)
    np.testing.assert_allclose(matrix @ solved, right, atol=1e-11)
    assert left == 0.0


@pytest.mark.parametrize("size", [0.0, 1e-9])
@pytest.mark.parametrize("neutral", [1, 2])
def test_neutral_directions_have_no_part_in_the_solution(neutral: int, size: float) -> None:
    rng, n = np.random.default_rng(neutral), 6
    u, v = (np.linalg.qr(rng.normal(size=(n, n)))[0] for _ in range(2))
    sigma = np.array([2.0, 1.0, 0.7, 0.5, 0.3, 0.1])
    sigma[n - neutral :] = size
    matrix = u * sigma @ v.T
    right = rng.normal(size=(n, 4))
    held = slice(0, n - neutral)
    expected = v[:, held] / sigma[held] @ u[:, held].T @ right
    solved, left = solve(matrix, right)
    np.testing.assert_allclose(solved, expected, rtol=1e-9, atol=1e-9)
    over = right[:, 0] - u[:, held] @ (u[:, held].T @ right[:, 0])
    assert left == pytest.approx(np.abs(over).max(), rel=1e-9)


def test_nothing_is_held_by_a_matrix_of_zeros() -> None:
    solved, left = solve(np.zeros((3, 3)), np.array([[1.0], [-2.0], [0.5]]))
    np.testing.assert_array_equal(solved, 0.0)
    assert left == 2.0
