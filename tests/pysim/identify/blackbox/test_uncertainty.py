"""Covariances against Monte Carlo and against finite differences."""

import numpy as np
import pytest

from pysim.identify.blackbox import ComplexResponse, Structure, fit_transfer_function
from pysim.identify.blackbox.uncertainty import zero_slopes
from tests.pysim.identify.blackbox.systems import from_roots, noisy, pairs

F = np.geomspace(0.3, 20, 20)
SYSTEM = from_roots([-40.0], pairs(-6 + 30j), 25.0, dead_time=0.01)
STRUCTURE = Structure(2, 1, dead_time_max=0.03)
RUNS = 150
SIZE = 3 / np.sqrt(2 * RUNS)  # three standard errors of a standard deviation, relative
SHARE = 3 * np.sqrt(0.95 * 0.05 / RUNS)  # of a share that should be 0.95


@pytest.fixture(scope="module")
def fits():
    return [fit_transfer_function(noisy(SYSTEM, F, 0.003, seed), STRUCTURE, tries=1) for seed in range(RUNS)]


def test_covariance_of_coefficients_is_that_of_repeated_fits(fits) -> None:
    found = np.cov([fit.values for fit in fits], rowvar=False)
    claimed = np.mean([fit.covariance for fit in fits], axis=0)
    sizes = np.sqrt(np.diag(found))
    np.testing.assert_allclose(np.sqrt(np.diag(claimed)), sizes, rtol=SIZE)
    np.testing.assert_allclose(claimed / np.outer(sizes, sizes), found / np.outer(sizes, sizes), atol=0.25)


def test_covariance_of_poles_zeros_and_gain_is_that_of_repeated_fits(fits) -> None:
    draws = {
        "pole Hz": [(fit.poles[1].frequency_hz, fit.poles[1].frequency_deviation_hz) for fit in fits],
        "damping": [(fit.poles[1].damping, fit.poles[1].damping_deviation) for fit in fits],
        "zero": [(fit.zeros[0].value.real, np.sqrt(fit.zeros[0].covariance[0, 0])) for fit in fits],
        "gain": [(fit.gain().value, fit.gain().std) for fit in fits],
    }
    for name, rows in draws.items():
        values, claims = np.array(rows).T
        assert np.mean(claims) == pytest.approx(np.std(values), rel=SIZE), name


def test_intervals_hold_what_they_say(fits) -> None:
    truth = np.array([*SYSTEM.numerator, *SYSTEM.denominator[1:], SYSTEM.dead_time])
    inside = [
        [e.interval[0] <= t <= e.interval[1] for e, t in zip(fit.estimates(), truth, strict=True)] for fit in fits
    ]
    np.testing.assert_allclose(np.mean(inside, axis=0), 0.95, atol=SHARE)


def test_band_holds_the_true_curve(fits) -> None:
    at, truth = np.array([0.5, 4.0, 15.0]), SYSTEM.at(np.array([0.5, 4.0, 15.0]))
    inside = []
    for fit in fits:
        gain, phase = fit.band(at)
        error = np.log(fit.function.at(at) / truth)
        inside.append([np.abs(error.real) <= gain, np.abs(error.imag) <= phase])
    np.testing.assert_allclose(np.mean(inside, axis=0), 0.95, atol=SHARE)


def test_variances_of_the_curve_add_up_to_the_number_of_unknowns() -> None:
    """The trace of a projection is its rank; it goes through coefficients over nine decades without losing a digit."""
    clusters = from_roots(
        pairs(-0.3 + 5j, -1 + 8.2j, -30 + 105j), pairs(-0.5 + 3j, -0.2 + 8j, -0.3 + 8.5j, -3 + 100j), 1e3
    )
    for system, structure in ((SYSTEM, STRUCTURE), (clusters, Structure(8, 6))):
        fit = fit_transfer_function(noisy(system, np.geomspace(0.1, 30, 60), 1e-3, seed=1), structure)
        gain, phase = fit.band(fit.data.frequency)
        variances = np.abs(fit.model) ** 2 * (gain**2 + phase**2) / fit.quantile(0.95) ** 2
        assert np.sum(variances) / 1e-6 == pytest.approx(structure.parameters, rel=1e-9)


def test_unknown_noise_is_taken_from_the_residuals() -> None:
    data = noisy(SYSTEM, F, 0.003, seed=7)
    plain = ComplexResponse(F, data.values)
    known, guessed = (fit_transfer_function(d, STRUCTURE) for d in (data, plain))
    ratio = np.sqrt(np.diag(guessed.covariance) / np.diag(known.covariance))
    np.testing.assert_allclose(ratio, np.sqrt(known.misfit / known.freedom), rtol=1e-6)
    assert guessed.quantile(0.95) == pytest.approx(2.030, abs=1e-3)  # Student's t of 35 degrees of freedom
    assert known.quantile(0.95) == pytest.approx(1.960, abs=1e-3)


def test_a_correlated_covariance_is_used_jointly() -> None:
    """One direction of the complex plane nearly free of noise: the fit follows it and its intervals shrink."""
    rng = np.random.default_rng(2)
    skewed = np.array([[1.0, 0.98], [0.98, 1.0]]) * 0.02**2
    draw = rng.multivariate_normal([0, 0], skewed, size=F.size)
    values = SYSTEM.at(F) + draw[:, 0] + 1j * draw[:, 1]
    joint = ComplexResponse(F, values, np.tile(skewed, (F.size, 1, 1)))
    apart = ComplexResponse(F, values, np.tile(np.diag(np.diag(skewed)), (F.size, 1, 1)))
    error = {}
    for name, data in (("joint", joint), ("apart", apart)):
        fit = fit_transfer_function(data, STRUCTURE)
        error[name] = np.linalg.norm(fit.function.at(F) - SYSTEM.at(F))
    assert error["joint"] < 0.6 * error["apart"]
    deviations = [fit_transfer_function(d, STRUCTURE).gain().std for d in (joint, apart)]
    assert deviations[0] < 0.6 * deviations[1]


def test_slopes_of_zeros() -> None:
    numerator, step = np.array([2.0, 3.0, 50.0]), 1e-6
    zeros = np.roots(numerator)
    slopes = zero_slopes(numerator, zeros)
    for k in range(3):
        moved = np.roots(numerator + step * np.eye(3)[k])
        np.testing.assert_allclose((moved - zeros) / step, slopes[:, k], rtol=1e-5)
