"""Residuals judged against noise whose spectrum is known."""

import numpy as np
import pytest

from pysim.identify.frf.noise import COLOURED, DECLARED, RESIDUALS, residual_noise
from tests.pysim.identify.frf.systems import coloured, white


def test_white_residuals_are_taken_as_they_are() -> None:
    noise = residual_noise(white(2000, 0.3, 1), 3, 5.0, 0.004)
    assert noise.basis == RESIDUALS
    assert noise.at_frequency == noise.at_zero == noise.deviation == pytest.approx(0.3, rel=0.05)


def test_white_residuals_are_seldom_called_coloured() -> None:
    coloured_ones = sum(residual_noise(white(400, 1.0, seed), 3, 5.0, 0.004).basis == COLOURED for seed in range(500))
    assert coloured_ones <= 16  # 1 percent expected; P(more) of a binomial below 1e-4


@pytest.mark.parametrize("pole", [0.5, 0.9, -0.5])
def test_memory_is_seen_and_its_spectrum_found(pole: float) -> None:
    f, interval = 5.0, 0.004
    ratios = []
    for seed in range(20):
        noise = residual_noise(coloured(2000, 0.3, seed, pole), 3, f, interval)
        assert noise.basis == COLOURED
        ratios.append([noise.at_frequency, noise.at_zero])
    drive = 0.3 * np.sqrt(1 - pole**2)
    truth = np.array([drive / abs(1 - pole * np.exp(-2j * np.pi * f * interval)), drive / (1 - pole)])
    np.testing.assert_allclose(np.mean(ratios, axis=0), np.maximum(truth, 0.3), rtol=0.1)


def test_declared_noise_counts_where_the_residuals_agree() -> None:
    residual = white(500, 0.3, 2)
    assert residual_noise(residual, 3, 5.0, 0.004, declared=0.3).basis == DECLARED
    assert residual_noise(residual, 3, 5.0, 0.004, declared=0.3).at_frequency == 0.3
    assert residual_noise(residual, 3, 5.0, 0.004, declared=0.2).basis == RESIDUALS  # more is left than was declared
    memory = residual_noise(coloured(500, 0.3, 2, -0.5), 3, 1.0, 0.004, declared=0.4)
    assert memory.basis == COLOURED
    assert memory.at_frequency == pytest.approx(0.4)  # never below what was declared


def test_no_residual_is_no_noise() -> None:
    assert residual_noise(np.zeros(100), 3, 5.0, 0.004).at_frequency == 0.0
