"""A best linear approximation in place of a stepped-sine response."""

import numpy as np
import pytest

from pysim.identify.multisine import DropPeriods, as_frequency_response, robust_approximation
from tests.pysim.identify.multisine.systems import AMPLITUDE, ODD, gain, measure


def test_gain_phase_and_their_covariance() -> None:
    data = measure(ODD, realisations=4, periods=3, noise=0.05, seed=0)
    bla = robust_approximation(data, transient=DropPeriods(0))
    response = as_frequency_response(bla)
    np.testing.assert_allclose(response.frequency, ODD / 2.0)
    np.testing.assert_allclose(response.gain * np.exp(1j * response.phase), bla.gain)
    assert np.all(np.diff(response.phase) < np.pi)
    assert response.test.amplitude == pytest.approx(AMPLITUDE * np.sqrt(ODD.size))
    assert response.covariance is not None
    np.testing.assert_allclose(response.covariance[:, 0, 0], response.test.amplitude**2 * bla.variance / 2)
    np.testing.assert_allclose(response.covariance[:, 1, 1], bla.variance / 2 / np.abs(bla.gain) ** 2)
    np.testing.assert_allclose(response.covariance[:, 2, 2], bla.mean_variance)


def test_the_phase_s_variance_is_that_of_many_draws() -> None:
    responses, claimed = [], []
    for seed in range(80):
        data = measure(ODD, realisations=6, periods=2, noise=0.05, seed=seed)
        response = as_frequency_response(robust_approximation(data, transient=DropPeriods(0)))
        responses.append(np.angle(np.exp(1j * response.phase) / gain(ODD)))
        assert response.covariance is not None
        claimed.append(response.covariance[:, 1, 1])
    assert np.mean(np.square(responses)) == pytest.approx(np.mean(claimed), rel=0.1)


def test_one_period_does_not_tell_how_sure_the_mean_is() -> None:
    data = measure(ODD, realisations=2, periods=1, noise=0.05, seed=0)
    assert as_frequency_response(robust_approximation(data)).covariance is not None  # over realisations
