"""Dense elimination, where every entry of the matrix may differ from zero."""

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.simulate import Rodas
from pysim.simulate._job import Job
from pysim.simulate.kernel.library import kernel
from pysim.simulate.kernel.memory import work_arrays

Array = NDArray[np.float64]


def solve(matrix: Array, right: Array) -> Array | None:
    """Solution of the system, asked for as one of 1 I - J; None where it is refused."""
    n, job, solution = len(matrix), Job(Rodas()), right.copy()
    job.put("work", work_arrays(n, 0, 1, 1, True))
    job.array("work", "jacobian")[:] = (np.eye(n) - matrix).T
    if not kernel().factorise(job.record, 1.0):
        return None
    kernel().solve(job.record, solution)
    return solution


@pytest.mark.parametrize("n", [1, 2, 3, 7, 12])
@pytest.mark.parametrize("columns", [(), (4,), (20,)])
def test_same_solution_as_lapack(n: int, columns: tuple[int, ...]) -> None:
    rng = np.random.default_rng(n)
    for _ in range(20):
        matrix, right = rng.normal(size=(n, n)), rng.normal(size=(n, *columns))
        matrix[rng.integers(n), rng.integers(n)] = 0.0
        matrix += np.roll(np.eye(n), 1, axis=0) * 3  # large entries off the diagonal: pivoting has to find them
        solution = solve(matrix, right)
        assert solution is not None
        np.testing.assert_allclose(matrix @ solution, right, atol=1e-10)
        np.testing.assert_allclose(solution, np.linalg.solve(matrix, right), rtol=1e-7, atol=1e-10)


def test_singular_and_undefined_matrices_are_refused() -> None:
    for matrix in (np.zeros((2, 2)), np.array([[1.0, 2], [2, 4]]), np.array([[np.nan, 1], [1, 1]])):
        assert solve(matrix, np.ones(2)) is None
