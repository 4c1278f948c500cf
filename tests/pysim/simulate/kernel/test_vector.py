"""Sums of rows: as NumPy has them, and with the same bits on every kind of processor."""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.simulate.kernel.library import address, kernel

Array = NDArray[np.float64]

_P, _N, _D = ctypes.c_void_p, ctypes.c_int64, ctypes.c_double
_SIGNATURES = {
    "add_rows": ctypes.CFUNCTYPE(None, _P, _P, _P, _N, _D, _P, _N),
    "add_rows_and_scale": ctypes.CFUNCTYPE(None, _P, _P, _P, _N, _D, _P, _D, _P, _N),
    "scale_difference": ctypes.CFUNCTYPE(None, _P, _P, _D, _P, _N),
    "weighted_square": ctypes.CFUNCTYPE(_D, _P, _P, _P, _P, _D, _D, _N),
    "add_row": ctypes.CFUNCTYPE(None, _P, _P, _D, _N),
    "reduce_row": ctypes.CFUNCTYPE(None, _P, _D, _P, _P, _N, _P, _N),
}


def functions(table: int) -> dict[str, Callable[..., Any]]:
    """The functions of a RowSums at that address."""
    places = (ctypes.c_void_p * len(_SIGNATURES)).from_address(table)
    return {name: kind(place) for (name, kind), place in zip(_SIGNATURES.items(), places, strict=True)}


BEST, PLAIN = functions(kernel().row_sums), functions(kernel().plain_row_sums)


def add_rows(base: Array, rows: Array, weights: Array, count: int, scale: float, result: Array) -> None:
    arguments = (address(base), address(rows), address(weights), count, scale, address(result), base.size)
    BEST["add_rows"](*arguments)


@pytest.mark.parametrize("n", [0, 1, 3, 4, 5, 8, 11, 12, 16, 23])
@pytest.mark.parametrize("count", [0, 1, 3])
def test_weighted_sum_of_rows(n: int, count: int) -> None:
    rng = np.random.default_rng(n)
    base, rows, weights = rng.normal(size=n), rng.normal(size=(4, n)), rng.normal(size=4)
    result = np.zeros(n)
    add_rows(base, rows, weights, count, 0.3, result)
    expected = base + 0.3 * weights[:count] @ rows[:count]
    np.testing.assert_allclose(result, expected, rtol=1e-14, atol=1e-14)
    add_rows(base, rows, weights, count, 0.3, base)  # onto itself
    np.testing.assert_array_equal(base, result)


def test_what_is_not_finite_stays_visible() -> None:
    result = np.zeros(5)
    add_rows(np.ones(5), np.array([[1.0, np.nan, np.inf, 1.0, np.nan]]), np.array([2.0]), 1, 1.0, result)
    np.testing.assert_array_equal(np.isfinite(result), [True, False, False, True, False])


@pytest.mark.parametrize("width", [4, 12, 16, 28])
def test_row_less_others_and_the_same_bits_without_avx2(width: int) -> None:
    rng = np.random.default_rng(width)
    rows, weights, numbers = rng.normal(size=(6, width)), rng.normal(size=4), np.array([0, 2, 3, 5])
    expected, own = 0.7 * rows[1] - weights @ rows[numbers], rows.copy()
    plain, best = rows.copy(), rows.copy()
    for table, target in ((PLAIN, plain), (BEST, best)):
        table["reduce_row"](address(target[1]), 0.7, address(weights), address(numbers), 4, address(target), width)
        table["add_row"](address(target[4]), address(target[0]), 1.5, width)
        table["add_rows"](address(target[5]), address(target), address(weights), 3, 0.1, address(target[5]), width)
    np.testing.assert_allclose(best[1], expected, rtol=1e-13, atol=1e-14)
    np.testing.assert_allclose(best[4], own[4] + 1.5 * own[0], rtol=1e-14)
    np.testing.assert_array_equal(plain, best)


@pytest.mark.parametrize("n", [0, 1, 4, 7, 16, 37])
def test_sums_of_rows_with_multiples_and_the_same_bits_without_avx2(n: int) -> None:
    rng = np.random.default_rng(n)
    base, rows, weights = rng.normal(size=n), rng.normal(size=(3, n)), rng.normal(size=3)
    expected = base + 0.3 * weights @ rows
    both = []
    for table in (BEST, PLAIN):
        total, scaled, apart = np.zeros(n), np.zeros(n), np.zeros(n)
        table["add_rows_and_scale"](
            address(base), address(rows), address(weights), 3, 0.3, address(total), -2.0, address(scaled), n
        )
        table["scale_difference"](address(scaled), address(base), 0.5, address(apart), n)
        both.append((total, scaled, apart))
    for found, wanted in zip(both[0], (expected, -2.0 * expected, -expected - 0.5 * base), strict=True):
        np.testing.assert_allclose(found, wanted, rtol=1e-13, atol=1e-13)
    np.testing.assert_array_equal(*both)


@pytest.mark.parametrize("n", [0, 1, 4, 6, 13])
def test_weighted_square_and_the_same_bits_without_avx2(n: int) -> None:
    values, nominal, x, y = np.random.default_rng(n).normal(size=(4, n))
    nominal = np.abs(nominal) + 0.1
    expected = np.sum((values / (1e-3 * nominal + 1e-2 * np.maximum(np.abs(x), np.abs(y)))) ** 2)
    arguments = *(address(array) for array in (values, nominal, x, y)), 1e-3, 1e-2, n
    found = [table["weighted_square"](*arguments) for table in (BEST, PLAIN)]
    assert found[0] == pytest.approx(expected, rel=1e-13)
    assert found[0] == found[1]
    if n:
        values[-1] = np.nan
        assert np.isnan(BEST["weighted_square"](*arguments))
