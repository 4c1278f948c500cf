"""Second-order sections against polynomials of the same roots and finite differences."""

import numpy as np
import pytest

from pysim.identify.blackbox import sections

POLES = [
    np.array([-2.0]),
    np.array([-1 + 2j, -1 - 2j, -5.0, -0.1, 3.0]),
    np.array([-1e-6 + 40j, -1e-6 - 40j, -7.0, -8.0]),
    np.empty(0),
]


@pytest.mark.parametrize("poles", POLES)
def test_poles_come_back_and_make_the_same_polynomial(poles: np.ndarray) -> None:
    numbers = sections.from_poles(poles.astype(complex))
    np.testing.assert_allclose(sections.polynomial(numbers), np.atleast_1d(np.poly(poles)).real, rtol=1e-12, atol=1e-12)
    found = sections.to_poles(numbers)
    np.testing.assert_allclose(np.sort_complex(found), np.sort_complex(poles.astype(complex)), rtol=1e-9)


@pytest.mark.parametrize("poles", POLES[:3])
def test_slopes_agree_with_differences(poles: np.ndarray) -> None:
    numbers, s = sections.from_poles(poles.astype(complex)), 1j * np.array([0.3, 2.0, 11.0])
    value, logarithm = sections.values_and_slopes(numbers, s)
    np.testing.assert_allclose(value, np.polyval(sections.polynomial(numbers), s))
    polynomial, roots = sections.polynomial_slopes(numbers), sections.pole_slopes(numbers)
    for i in range(numbers.size):
        step = np.zeros(numbers.size)
        step[i] = 1e-6 * max(abs(numbers[i]), 1.0)
        up, down = numbers + step, numbers - step
        h = 2 * step[i]
        np.testing.assert_allclose(
            (sections.polynomial(up) - sections.polynomial(down)) / h, polynomial[:, i], rtol=1e-6, atol=1e-6
        )
        difference = (np.log(sections.values_and_slopes(up, s)[0]) - np.log(sections.values_and_slopes(down, s)[0])) / h
        np.testing.assert_allclose(difference, logarithm[:, i], rtol=1e-5)
        moved = (sections.to_poles(up) - sections.to_poles(down)) / h
        np.testing.assert_allclose(moved, roots[:, i], rtol=1e-4, atol=1e-6)


def test_stable_exactly_where_all_numbers_are_positive() -> None:
    for seed in range(200):
        numbers = np.random.default_rng(seed).standard_normal(5)
        assert np.all(numbers > 0) == np.all(sections.to_poles(numbers).real < 0)


def test_a_double_pole_has_no_slope() -> None:
    assert np.isinf(sections.pole_slopes(np.array([2.0, 1.0]))).all()
