import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pysim.simulate import Rodas, simulate
from pysim.simulate._job import Job
from pysim.simulate.kernel.elimination import elimination_arrays, elimination_order, fill
from pysim.simulate.kernel.library import kernel
from pysim.simulate.kernel.memory import work_arrays
from pysim.types import Experiment
from tests.pysim.simulate.fixture_fmus import STIFF


def solve(
    jacobian: np.ndarray, pattern: np.ndarray, shift: float, right: np.ndarray, nominal: np.ndarray | float = 1.0
):
    """Solution of (shift I - J) x = right, and whether the sparse factors served for it; None where refused."""
    n, job = len(jacobian), Job(Rodas())
    job.put("work", {**work_arrays(n, 0, 1, 1, True), **elimination_arrays(pattern)})
    job.array("work", "jacobian")[:] = jacobian.T
    job.array("work", "nominal")[:] = nominal
    x, many = right.copy(), np.stack([right, -2.0 * right, 0.0 * right, right], axis=1)
    if not kernel().factorise(job.record, shift):
        return None, False
    kernel().solve(job.record, x)
    kernel().solve(job.record, many)
    np.testing.assert_allclose(many, np.outer(x, [1.0, -2.0, 0.0, 1.0]), rtol=1e-14)
    return x, job.number("run", "is_sparse") == 1


def brush(rng, n: int) -> np.ndarray:
    """A chain of states of which the first one hangs on all: sparse, unless elimination begins there."""
    pattern = np.eye(n, dtype=bool) | np.eye(n, k=1, dtype=bool)
    pattern[:, 0] = pattern[0] = True
    order = rng.permutation(n)
    return pattern[np.ix_(order, order)]


@pytest.mark.parametrize("n", [4, 12, 40])
@pytest.mark.parametrize("scale", [1.0, 1e7])
def test_same_solution_as_lapack_in_any_units(n, scale):
    rng = np.random.default_rng(n)
    patterns = [brush(rng, n) for _ in range(3)]
    for pattern in patterns * 4:
        units = scale ** rng.uniform(-1, 1, n)  # every state in another unit
        jacobian = np.where(pattern, rng.normal(size=(n, n)) - 3 * n * np.eye(n), 0.0) * np.outer(units, 1 / units)
        right = rng.normal(size=n) * units
        solution, sparse = solve(jacobian, pattern, 2.0, right, units)
        assert sparse == (n > 4)
        expected = np.linalg.solve((2.0 * np.eye(n) - jacobian) * np.outer(1 / units, units), right / units)
        np.testing.assert_allclose(solution / units, expected, rtol=1e-10, atol=1e-12 * np.abs(expected).max())


def test_bad_pivots_leave_it_to_the_dense_elimination():
    pattern = brush(np.random.default_rng(0), 8)
    jacobian = np.where(pattern, np.random.default_rng(1).normal(size=(8, 8)), 0.0)
    np.fill_diagonal(jacobian, 1.0 - 1e-14)  # less than rounding is left of the diagonal of I - J
    right = np.arange(1.0, 9.0)
    solution, sparse = solve(jacobian, pattern, 1.0, right)
    assert not sparse
    np.testing.assert_allclose((np.eye(8) - jacobian) @ solution, right, rtol=1e-8)


@pytest.mark.parametrize("entry", [np.nan, np.inf])
def test_singular_and_undefined_matrices_are_refused(entry):
    pattern = brush(np.random.default_rng(0), 8)
    broken = np.where(pattern, 1.0, 0.0)
    broken[pattern.nonzero()[0][5], pattern.nonzero()[1][5]] = entry
    assert solve(broken, pattern, 1.0, np.ones(8))[0] is None
    assert solve(np.diag(np.arange(8.0)), pattern, 3.0, np.ones(8))[0] is None


@given(st.integers(1, 9).flatmap(lambda n: st.lists(st.booleans(), min_size=n * n, max_size=n * n)))
def test_fill_holds_every_entry_that_elimination_makes(flags):
    n = round(len(flags) ** 0.5)
    pattern = np.array(flags).reshape(n, n)
    order = elimination_order(pattern)
    assert sorted(order) == list(range(n))
    filled = fill(pattern, order)
    left = np.where(pattern, 1.0, 0.0) * np.random.default_rng(0).uniform(1, 2, (n, n)) + 10 * n * np.eye(n)
    left = left[np.ix_(order, order)]
    for c in range(n):
        assert not np.any(left[~filled])
        left[c + 1 :] -= np.outer(left[c + 1 :, c] / left[c, c], left[c])
        left[c + 1 :, c] = 0.0


def test_a_chain_is_eliminated_from_many_places_at_once_with_little_fill():
    band = np.abs(np.subtract.outer(np.arange(30), np.arange(30))) <= 1
    shuffle = np.random.default_rng(2).permutation(30)
    shuffled = band[np.ix_(shuffle, shuffle)]
    filled = fill(shuffled, elimination_order(shuffled))
    assert filled.sum() <= 1.5 * band.sum()
    waits = np.zeros(30, dtype=int)  # rows that must be done before this one, one after the other
    for row in range(30):
        waits[row] = max((waits[column] + 1 for column in np.flatnonzero(filled[row, :row])), default=0)
    assert waits.max() <= 10


def test_sparse_and_dense_elimination_give_the_same_run(fixture_model):
    model = fixture_model(STIFF)  # its two states have nothing to do with each other
    sparse = dataclasses.replace(
        model,
        abilities=dataclasses.replace(model.abilities, dependencies=(frozenset({"x"}), frozenset({"y"}))),
    )
    assert [elimination_arrays(p)["sparse"] for p in (np.ones((2, 2), bool), np.eye(2, dtype=bool))] == [0, 1]
    experiment = Experiment(np.linspace(0, 5, 20), ("x", "y"))
    one, other = (simulate(m, experiment, solver=Rodas()).values for m in (model, sparse))
    np.testing.assert_allclose(one, other, rtol=1e-12)
