"""What a fit tells about itself."""

import numpy as np
import pytest

from pysim.identify.blackbox import Root, Structure, fit_percent, fit_transfer_function
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

F = np.geomspace(0.2, 20, 25)


def test_fit_percent_by_hand() -> None:
    measured = np.array([1 + 1j, 1 - 1j, -2.0])  # mean 0, norm sqrt(2 + 2 + 4)
    assert fit_percent(measured, measured + np.array([0.0, 0.0, np.sqrt(2) * 1j])) == pytest.approx(50.0)
    assert fit_percent(measured, np.zeros(3, dtype=complex)) == pytest.approx(0.0)
    assert fit_percent(measured, measured) == 100.0
    assert fit_percent(np.ones(2, dtype=complex), np.array([1.0, 2.0 + 0j])) == -np.inf


def test_a_root_in_hertz_and_damping() -> None:
    root = Root(-3 + 4j, np.diag([0.01, 0.04]))
    assert (root.frequency_hz, root.damping) == pytest.approx((5 / (2 * np.pi), 0.6))
    draws = np.random.default_rng(1).multivariate_normal([-3, 4], root.covariance, size=100_000)
    sizes = np.linalg.norm(draws, axis=1)
    assert root.frequency_deviation_hz == pytest.approx(np.std(sizes) / (2 * np.pi), rel=0.02)
    assert root.damping_deviation == pytest.approx(np.std(-draws[:, 0] / sizes), rel=0.02)
    real = Root(-3 + 0j, np.array([[0.25, 0.0], [0.0, 0.0]]))
    assert (real.damping, real.damping_deviation, real.frequency_deviation_hz) == pytest.approx((1, 0, 0.5 / 2 / np.pi))
    assert Root(-3 + 0j, np.full((2, 2), np.inf)).frequency_deviation_hz == np.inf


def test_names_values_and_units_belong_together() -> None:
    function = from_roots([-8.0], [-3.0, -30.0], 20.0, dead_time=0.02)
    fit = fit_transfer_function(exact(function, F), Structure(2, 1, dead_time_max=0.1))
    found = {e.name: (e.value, e.unit) for e in fit.estimates()}
    assert list(found) == ["b1", "b0", "a1", "a0", "dead_time"]
    assert found["b0"][0] == pytest.approx(160.0)
    assert found["a1"][0] == pytest.approx(33.0)
    assert found["dead_time"] == (pytest.approx(0.02), "s")
    assert fit.gain().value == pytest.approx(160 / 90)


@pytest.mark.parametrize("stable", [False, True])
def test_a_gain_at_rest_is_claimed_only_where_no_integrator_fits_as_well(stable: bool) -> None:
    """Of an integrator it is infinite: an interval with an end does not hold it. Of a slow pole it is well known."""
    unbounded, bounded = 0, 0
    for seed in range(12):
        cylinder = noisy(from_roots([], [0.0, -25.0], 50.0), F, 0.001, seed)
        unbounded += fit_transfer_function(cylinder, Structure(2, stable=stable)).gain().interval == (-np.inf, np.inf)
        slow = noisy(from_roots([], [-0.2, -25.0], 50.0), F, 0.001, seed)
        gain = fit_transfer_function(slow, Structure(2, stable=stable)).gain()
        bounded += gain.interval[0] < 10.0 < gain.interval[1] < 11.0
    assert unbounded >= 10  # 95 percent of them, and more where the search is held at the edge
    assert bounded >= 10


def test_residuals_are_in_standard_deviations() -> None:
    fit = fit_transfer_function(noisy(from_roots([], pairs(-5 + 30j), 900.0), F, 0.01, seed=4), Structure(2))
    assert fit.standardised.shape == (25, 2)
    np.testing.assert_allclose(fit.standardised[:, 0], (fit.data.values - fit.model).real / 0.01)
    assert fit.misfit == pytest.approx(np.sum(fit.standardised**2))
    assert 0.001 < fit.explains < 0.999
    assert fit.freedom == 47
