"""Correlated residuals: the length of a first-order process, and the scatter of a fit through one."""

import numpy as np
import pytest
from scipy.signal import lfilter

from pysim.identify.friction import correlation_length, score_covariance


def process(rng: np.random.Generator, rho: float, n: int) -> np.ndarray:
    """First-order autoregressive, stationary up to its start-up, which is cut off."""
    return lfilter([1.0], [1.0, -rho], rng.normal(size=n + 200))[200:]


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9])
def test_length_of_a_first_order_process(rho: float) -> None:
    """(1 + rho) / (1 - rho)."""
    residuals = process(np.random.default_rng(1), rho, 40000)
    assert correlation_length(residuals, (25000, 15000)) == pytest.approx((1 + rho) / (1 - rho), rel=0.15)


def test_anticorrelated_and_zero_residuals_count_one_each() -> None:
    assert correlation_length(process(np.random.default_rng(2), -0.6, 5000), (5000,)) == 1.0
    assert correlation_length(np.zeros(10), (10,)) == 1.0


def test_covariance_of_a_mean_and_a_slope_is_their_scatter() -> None:
    rng, n, rho = np.random.default_rng(3), 2000, 0.8
    slopes = np.column_stack([np.ones(n), np.linspace(-1, 1, n)])
    estimates, claimed = [], []
    for _ in range(400):
        errors = process(rng, rho, n)
        found = np.linalg.lstsq(slopes, errors, rcond=None)[0]
        left = errors - slopes @ found
        estimates.append(found)
        claimed.append(np.diag(score_covariance(slopes, left, (n,), correlation_length(left, (n,)))))
    seen = np.var(estimates, axis=0)
    # 400 draws know a variance to 7 percent; Bartlett's weights leave some 10 percent of it out
    np.testing.assert_allclose(np.mean(claimed, axis=0), seen, rtol=0.25)
    assert seen[0] == pytest.approx(25 / n, rel=0.2)  # 1 / (1 - rho)^2 / n
