"""Sine fits against the sines they were made from, and their covariance against repeated noise."""

import numpy as np
import pytest

from pysim.identify import sine_fit
from pysim.types import BadInput


@pytest.mark.parametrize("phase", [-3.0, -1.8, -0.3, 0.0, 1.2, 2.9])
def test_recovers_a_clean_sine_in_every_quadrant(phase: float) -> None:
    time = np.sort(np.random.default_rng(1).uniform(2.0, 3.7, 57))
    fit = sine_fit(time, 3.0 * np.sin(2 * np.pi * 1.7 * (time - 2.0) + phase) - 40.0, 1.7, origin=2.0)
    np.testing.assert_allclose([fit.amplitude, fit.phase, fit.offset], [3.0, phase, -40.0], rtol=1e-12, atol=1e-12)
    assert fit.residual < 1e-12


def test_whole_periods_keep_mean_and_harmonics_out() -> None:
    time = np.arange(24) / (24 * 5.0)
    angle = 2 * np.pi * 5.0 * time
    harmonics = sum(0.3 * np.sin(n * angle + n) for n in range(2, 12))
    fit = sine_fit(time, 2.0 * np.sin(angle - 0.7) + 9.0 + harmonics, 5.0)
    np.testing.assert_allclose([fit.amplitude, fit.phase, fit.offset], [2.0, -0.7, 9.0], rtol=1e-12)


def test_covariance_agrees_with_repeated_noise() -> None:
    rng = np.random.default_rng(7)
    time = np.arange(130) * 0.004  # a part of a period beyond whole ones: amplitude, phase and offset are correlated
    clean = 10.0 * np.sin(2 * np.pi * 3.0 * time - 0.9) + 50.0
    fits = [sine_fit(time, clean + rng.normal(0.0, 0.5, time.size), 3.0) for _ in range(4000)]
    seen = np.cov([[f.amplitude, f.phase, f.offset] for f in fits], rowvar=False)
    claimed = sine_fit(time, clean, 3.0, noise=0.5).covariance
    scale = np.sqrt(np.outer(np.diag(claimed), np.diag(claimed)))
    # 4000 draws know a variance to 1/sqrt(2000) = 2.2 percent (one sigma)
    np.testing.assert_allclose(seen / scale, claimed / scale, atol=0.09)
    assert np.mean([f.residual**2 for f in fits]) == pytest.approx(0.25, rel=0.02)


def test_three_fitted_numbers_are_three_degrees_of_freedom_less() -> None:
    time = np.arange(6) / 6.0
    signs = np.array([1.0, -1.0] * 3)  # at right angles to sine, cosine and constant: six squares of one are left over
    fit = sine_fit(time, 2.0 * np.sin(2 * np.pi * time) + signs, 1.0)
    assert fit.residual == pytest.approx(np.sqrt(6 / (6 - 3)), rel=1e-12)
    assert fit.covariance[0, 0] == pytest.approx(2 / 6 * (6 / 3), rel=1e-12)  # 2 sigma^2 / n


def test_textbook_variance_over_whole_periods() -> None:
    time = np.arange(400) / 100.0
    fit = sine_fit(time, 4.0 * np.sin(2 * np.pi * time), 1.0, noise=0.2)
    expected = np.diag([2 * 0.04 / 400, 2 * 0.04 / 400 / 16.0, 0.04 / 400])
    np.testing.assert_allclose(fit.covariance, expected, rtol=1e-9, atol=1e-16)


def test_a_signal_that_does_not_swing_has_any_phase() -> None:
    fit = sine_fit(np.linspace(0.0, 1.0, 20), np.zeros(20), 1.0, noise=0.1)
    assert fit.amplitude == 0.0
    assert fit.covariance[1, 1] == np.inf
    assert np.isfinite(fit.covariance[0, 0])


@pytest.mark.parametrize(
    ("time", "values", "words"),
    [
        (np.arange(3.0), np.arange(3.0), "at least four samples"),
        (np.arange(5.0), np.arange(4.0), "at least four samples"),
        (np.arange(5.0), np.array([0.0, np.nan, 0.0, 0.0, 0.0]), "finite"),
        (np.arange(9.0), np.arange(9.0), "do not determine"),  # 1 Hz sampled at 1 Hz
    ],
)
def test_refuses_what_determines_no_sine(time: np.ndarray, values: np.ndarray, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        sine_fit(time, values, 1.0)
