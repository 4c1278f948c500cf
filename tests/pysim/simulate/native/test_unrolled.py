"""Straight-line elimination does what the loops do, bit by bit, and leaves large patterns to them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.simulate import Rodas
from pysim.simulate._job import Job
from pysim.simulate.native.compiled import entry
from pysim.simulate.native.elimination import elimination_arrays, factorise_shifted, solve_shifted
from pysim.simulate.native.state import work_arrays

Array = NDArray[np.float64]
LOOPS = {"eliminate": 0, "substitute": 0}


@entry
def _factorise(jobs, shift):  # type: ignore[no-untyped-def]
    return factorise_shifted(jobs[0], shift)


@entry
def _solve(jobs, right):  # type: ignore[no-untyped-def]
    solve_shifted(jobs[0], right.ctypes.data)


def outcome(jacobian: Array, pattern: NDArray[np.bool_], x: Array, *, loops: bool) -> tuple[bool, int, Array, Array]:
    """Whether it was factorised, by the sparse factors or not, those factors, and a solution."""
    n, job, right = len(x), Job(Rodas()), np.cos(np.arange(len(x)))
    arrays = elimination_arrays(pattern)
    assert arrays["eliminate"] != 0
    job.put("work", {**work_arrays(n, 0, 1, 1, True), **arrays, **(LOOPS if loops else {})})
    job.array("work", "jacobian")[:] = jacobian.T
    job.array("work", "x")[:] = x
    good = _factorise(job.record, 3.0)
    if good:
        _solve(job.record, right)
    return good, int(job.number("run", "is_sparse")), job.array("work", "factors").copy(), right


def chained(rng: np.random.Generator, n: int) -> NDArray[np.bool_]:
    """A chain with a few entries beside it, in any order."""
    pattern = np.eye(n, dtype=bool) | np.eye(n, k=1, dtype=bool) | np.eye(n, k=-1, dtype=bool)
    pattern |= rng.uniform(size=(n, n)) < 0.5 / n
    order = rng.permutation(n)
    return pattern[np.ix_(order, order)]


@pytest.mark.parametrize("entry", [None, 0.0, np.nan, np.inf])
def test_the_same_bits(entry: float | None) -> None:
    rng, sparse = np.random.default_rng(4), 0
    for n in (8, 12, 19, 30):
        pattern = chained(rng, n)
        jacobian = np.where(pattern, rng.normal(size=(n, n)) * 10 ** rng.uniform(-6, 6, (n, n)), 0.0)
        if entry is not None:
            jacobian[tuple(np.argwhere(pattern)[3])] = entry
        one, other = (outcome(jacobian, pattern, np.ones(n), loops=loops) for loops in (False, True))
        assert one[:2] == other[:2]
        for mine, theirs in zip(one[2:], other[2:], strict=True):
            np.testing.assert_array_equal(mine, theirs)
        sparse += one[1]
    assert sparse > 0 or entry in (np.nan, np.inf)


def test_factors_that_lose_the_matrix_are_told() -> None:
    pattern = np.eye(8, dtype=bool)
    pattern[0] = pattern[:, 0] = True
    jacobian = np.where(pattern, np.random.default_rng(1).normal(size=(8, 8)), 0.0)
    np.fill_diagonal(jacobian, 3.0 - 1e-14)  # less than rounding is left of the diagonal of 3 I - J
    for loops in (False, True):
        good, sparse, _, solution = outcome(jacobian, pattern, np.ones(8), loops=loops)
        assert (good, sparse) == (True, 0)
        np.testing.assert_allclose((3.0 * np.eye(8) - jacobian) @ solution, np.cos(np.arange(8)), rtol=1e-8)


def test_large_patterns_are_left_to_the_loops() -> None:
    band = np.abs(np.subtract.outer(np.arange(900), np.arange(900))) <= 1
    arrays = elimination_arrays(band)
    assert (arrays["sparse"], arrays["eliminate"], arrays["substitute"]) == (1, 0, 0)
    assert elimination_arrays(band[:30, :30])["eliminate"] != 0
