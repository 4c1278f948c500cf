"""Sine and harmonics with and without lost samples, against least squares in one piece."""

import numpy as np
import pytest

from pysim.identify.frf.harmonic_fit import HarmonicFit, harmonic_fit, told_apart, waves

WHOLE = 2 * np.pi * np.arange(500) / 250


def test_whole_periods_are_the_same_either_way() -> None:
    y = 3 + np.sin(WHOLE + 0.2) + 0.1 * np.cos(3 * WHOLE)
    even, careful = (harmonic_fit(WHOLE, y, 4, lost=lost) for lost in (False, True))
    np.testing.assert_allclose(even.coefficients, careful.coefficients, atol=1e-12)
    np.testing.assert_allclose(even.inverse, careful.inverse, atol=1e-12)


@pytest.mark.parametrize("drifting", [False, True])
def test_the_inverse_is_that_of_the_normal_matrix_where_samples_are_lost(drifting: bool) -> None:
    angle = np.delete(WHOLE, slice(100, 240))
    fit = harmonic_fit(angle, np.sin(angle), 3, lost=True, drifting=drifting)
    assert fit.columns.shape == (360, 9 if drifting else 7)
    np.testing.assert_allclose(fit.inverse, np.linalg.inv(fit.columns.T @ fit.columns), rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(fit.coefficients, np.eye(1, fit.columns.shape[1])[0], atol=1e-12)


def test_fewer_harmonics_are_told_apart_the_larger_the_hole() -> None:
    period = WHOLE[:250]
    found = [told_apart(np.delete(period, slice(50, 50 + lost)), 11) for lost in (0, 5, 25, 50, 75, 100, 125)]
    assert found == [11, 11, 5, 2, 1, 1, 0]
    assert np.linalg.cond(waves(np.delete(period, slice(50, 75)), 5)) < 4.0


def test_the_level_of_the_harmonics_is_that_of_noise_whose_median_square_they_have() -> None:
    """A squared amplitude over its mean is exponential with the median ln 2; Student's t, 5 degrees of freedom."""
    sizes = np.sqrt(2 / 500 * 2 * np.log(2) * np.array([0.1, 0.7, 1.0, 3.0, 9.0])) * 0.3  # over noise of 0.3
    sine = np.zeros(13)
    sine[2:-1:2] = sizes
    fit = HarmonicFit(waves(WHOLE, 6), sine, np.diag([2 / 500] * 12 + [1 / 500]), np.zeros(500))
    assert fit.level_of_harmonics() == pytest.approx(0.3 * 2.570581836 / 1.959963985, rel=1e-9)
