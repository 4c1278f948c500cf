import numpy as np
import pytest

from pysim.simulate.native.compiled import entry
from pysim.simulate.native.vector import add_rows


@entry
def _add(base, rows, weights, count, scale, result):
    n = base.size
    add_rows(base.ctypes.data, rows.ctypes.data, weights.ctypes.data, count, scale, result.ctypes.data, n)


@pytest.mark.parametrize("n", [0, 1, 3, 4, 5, 8, 11, 12])
@pytest.mark.parametrize("count", [0, 1, 3])
def test_weighted_sum_of_rows(n, count):
    rng = np.random.default_rng(n)
    base, rows, weights = rng.normal(size=n), rng.normal(size=(4, n)), rng.normal(size=4)
    result = np.zeros(n)
    _add(base, rows, weights, count, 0.3, result)
    expected = base + 0.3 * weights[:count] @ rows[:count]
    np.testing.assert_allclose(result, expected, rtol=1e-14, atol=1e-14)
    _add(base, rows, weights, count, 0.3, base)  # onto itself
    np.testing.assert_array_equal(base, result)


def test_what_is_not_finite_stays_visible():
    result = np.zeros(5)
    _add(np.ones(5), np.array([[1.0, np.nan, np.inf, 1.0, np.nan]]), np.array([2.0]), 1, 1.0, result)
    np.testing.assert_array_equal(np.isfinite(result), [True, False, False, True, False])
