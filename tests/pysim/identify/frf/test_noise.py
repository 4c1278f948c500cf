"""Residuals judged against noise whose spectrum is known."""

import numpy as np
import pytest
from scipy.stats import chi2

from pysim.identify.frf.noise import COLOURED, DECLARED, RESIDUALS, ResidualNoise, residual_noise
from tests.pysim.identify.frf.systems import coloured, white
from tests.pysim.identify.seeds import at_most, seeds

INTERVAL = 0.004  # s


def waves(n: int, count: int, frequency: float = 5.0, interval: float = INTERVAL) -> np.ndarray:
    """A sine with its harmonics and a constant, as a stepped sine is fitted."""
    angle = 2 * np.pi * frequency * interval * np.arange(n)
    columns = [function(k * angle) for k in range(1, count + 1) for function in (np.sin, np.cos)]
    return np.column_stack([*columns, np.ones(n)])


def left_over(noise: np.ndarray, regressors: np.ndarray) -> np.ndarray:
    q, _ = np.linalg.qr(regressors)
    return np.asarray(noise - q @ (q.T @ noise))


def judged(
    noise: np.ndarray, *, count: int = 1, frequency: float = 5.0, declared: float | None = None
) -> ResidualNoise:
    """Of what a fit leaves of that noise."""
    regressors = waves(noise.size, count, frequency)
    return residual_noise(left_over(noise, regressors), regressors, frequency, INTERVAL, declared=declared)


def test_white_residuals_are_taken_as_they_are() -> None:
    noise = judged(white(2000, 0.3, 1))
    assert noise.basis == RESIDUALS
    assert noise.at_frequency == noise.at_zero == noise.deviation == pytest.approx(0.3, rel=0.05)


def test_what_a_fit_takes_out_is_missing_from_the_degrees_of_freedom() -> None:
    """Of 40 samples 11 waves and a mean leave 17 degrees of freedom: 17 squares of 0.3 are noise of 0.3."""
    regressors = waves(40, 11, 2.0, 1 / 70)
    residual = left_over(white(40, 1.0, 3), regressors)
    residual *= 0.3 * np.sqrt(17 / (residual @ residual))
    noise = residual_noise(residual, regressors, 2.0, 1 / 70)
    assert noise.basis == RESIDUALS
    assert (noise.deviation, noise.at_frequency) == (pytest.approx(0.3, rel=1e-12), pytest.approx(0.3, rel=1e-12))


@seeds(500)
@pytest.mark.parametrize(
    ("samples", "count", "frequency", "rate"), [(400, 1, 5, 250), (70, 11, 2, 70), (47, 11, 3, 70), (30, 9, 1, 30)]
)
def test_white_residuals_are_seldom_called_coloured(
    samples: int, count: int, frequency: float, rate: float, runs: int
) -> None:
    """Three in a hundred at most."""
    regressors, coloured_ones = waves(samples, count, frequency, 1 / rate), 0
    for seed in range(runs):
        residual = left_over(white(samples, 1.0, seed), regressors)
        coloured_ones += residual_noise(residual, regressors, frequency, 1 / rate).basis == COLOURED
    assert coloured_ones <= at_most(0.03, runs)


def test_whiteness_without_waves_is_that_of_ljung_and_box() -> None:
    noise = coloured(3000, 1.0, 4, 0.05)
    centred = noise - noise.mean()
    r = np.array([centred[k:] @ centred[:-k] for k in range(1, 21)]) / (centred @ centred)
    statistic = 3000 * 3002 * np.sum(r**2 / (3000 - np.arange(1, 21)))
    found = residual_noise(centred, np.ones((3000, 1)), 5.0, INTERVAL).whiteness
    assert 0.001 < found < 0.999
    assert found == pytest.approx(chi2.sf(statistic, 20), abs=0.02)


@pytest.mark.parametrize("pole", [0.5, 0.9, -0.5])
def test_memory_is_seen_and_its_spectrum_found(pole: float) -> None:
    f, interval = 5.0, INTERVAL
    ratios = []
    for seed in range(20):
        noise = judged(coloured(2000, 0.3, seed, pole), frequency=f)
        assert noise.basis == COLOURED
        ratios.append([noise.at_frequency, noise.at_zero])
    drive = 0.3 * np.sqrt(1 - pole**2)
    truth = np.array([drive / abs(1 - pole * np.exp(-2j * np.pi * f * interval)), drive / (1 - pole)])
    np.testing.assert_allclose(np.mean(ratios, axis=0), np.maximum(truth, 0.3), rtol=0.1)


def test_memory_is_seen_at_the_harmonics() -> None:
    """What a fit over eight periods takes out of the noise there is one line of eight; the others tell the whole."""
    pole, count, f, found = 0.9, 11, 1.0, []
    regressors = waves(2000, count, f)
    for seed in range(40):
        left = left_over(coloured(2000, 0.3, seed, pole), regressors)
        found.append(residual_noise(left, regressors, f, INTERVAL, harmonics=count - 1).at_harmonics)
    turns = f * INTERVAL * np.arange(2, count + 1)
    truth = 0.3 * np.sqrt(1 - pole**2) / np.abs(1 - pole * np.exp(-2j * np.pi * turns))
    np.testing.assert_allclose(np.sqrt(np.mean(np.square(found), axis=0)), truth, rtol=0.1)


@seeds(200)
@pytest.mark.parametrize("periods", [2, 3, 6])
def test_memory_is_seen_in_few_periods(periods: int, runs: int) -> None:
    """In two periods the fit takes half of the noise below its highest harmonic; the other half tells of both."""
    pole, f, found = 0.9, 1.0, []
    regressors = waves(250 * periods, 11, f)
    for seed in range(runs):
        left = left_over(coloured(250 * periods, 0.3, seed, pole), regressors)
        noise = residual_noise(left, regressors, f, INTERVAL)
        found.append([noise.at_frequency, noise.at_zero])
    turns = f * INTERVAL * np.array([1, 0])
    truth = 0.3 * np.sqrt(1 - pole**2) / np.abs(1 - pole * np.exp(-2j * np.pi * turns))
    np.testing.assert_allclose(np.sqrt(np.mean(np.square(found), axis=0)), truth, rtol=0.12)


def test_declared_noise_counts_where_the_residuals_agree() -> None:
    residual = white(500, 0.3, 2)
    assert judged(residual, declared=0.3).basis == DECLARED
    assert judged(residual, declared=0.3).at_frequency == 0.3
    one = waves(500, 1)
    assert residual_noise(residual, one, 5.0, INTERVAL, declared=0.3, harmonics=2).at_harmonics == (0.3, 0.3)
    assert judged(residual, declared=0.2).basis == RESIDUALS  # more is left than was declared
    memory = judged(coloured(500, 0.3, 2, -0.5), frequency=1.0, declared=0.4)
    assert memory.basis == COLOURED
    assert memory.at_frequency == pytest.approx(0.4)  # never below what was declared


def test_no_residual_is_no_noise() -> None:
    assert judged(np.zeros(100)).at_frequency == 0.0
