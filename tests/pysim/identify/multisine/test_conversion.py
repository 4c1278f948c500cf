"""A best linear approximation in place of a stepped-sine response."""

from collections.abc import Callable

import numpy as np
import pytest

from pysim.identify.blackbox import Structure, fit_transfer_function
from pysim.identify.multisine import (
    DropPeriods,
    as_frequency_response,
    local_polynomial_approximation,
    robust_approximation,
    smooth_approximation,
)
from pysim.types import BestLinearApproximation, Record
from tests.pysim.identify.multisine.systems import AMPLITUDE, FULL, ODD, gain, measure
from tests.pysim.identify.seeds import FEW, seeds


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
    for seed in range(FEW):
        data = measure(ODD, realisations=6, periods=2, noise=0.05, seed=seed)
        response = as_frequency_response(robust_approximation(data, transient=DropPeriods(0)))
        responses.append(np.angle(np.exp(1j * response.phase) / gain(ODD)))
        assert response.covariance is not None
        claimed.append(response.covariance[:, 1, 1])
    assert np.mean(np.square(responses)) == pytest.approx(np.mean(claimed), rel=0.1)  # 2000 of them: 3 percent


def smooth(seed: int) -> BestLinearApproximation:
    data = measure(FULL, realisations=1, periods=4, noise=0.1, seed=seed, respond=lambda u: 2 * u)
    return smooth_approximation(data, transient=DropPeriods(0))


def arbitrary(seed: int) -> BestLinearApproximation:
    rng = np.random.default_rng(seed)
    u, noise = rng.standard_normal((2, 600))
    record = Record(0.01 * np.arange(600), np.column_stack([u, 2 * u + 0.1 * noise]), ("u", "y"), ("V", "m"))
    return local_polynomial_approximation(record, ("u", "y"))


@seeds(200)
@pytest.mark.parametrize(("method", "width", "points"), [(smooth, 9, 6), (arbitrary, 13, 23)])
def test_a_fit_to_gains_that_neighbours_share_is_as_sure_as_it_says(
    method: Callable[[int], BestLinearApproximation], width: int, points: int, runs: int
) -> None:
    """A static gain of 2 in white noise; with every line as a point of its own the claim was half of what is true."""
    off, step = [], np.min(np.diff(method(0).frequency))
    for seed in range(runs):
        response = as_frequency_response(method(seed))
        assert response.frequency.size == points
        assert np.min(np.diff(response.frequency)) > 0.99 * width * step
        fit = fit_transfer_function(response, Structure(0, 0))
        off.append((fit.values[0] - 2.0) / np.sqrt(fit.covariance[0, 0]))
    # draws know a standard deviation to 1 / sqrt(2 n); variances from 6 and 7 degrees of freedom add some of their own
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(1.0, abs=4 / np.sqrt(2 * runs))


def test_one_period_does_not_tell_how_sure_the_mean_is() -> None:
    data = measure(ODD, realisations=2, periods=1, noise=0.05, seed=0)
    assert as_frequency_response(robust_approximation(data)).covariance is not None  # over realisations
