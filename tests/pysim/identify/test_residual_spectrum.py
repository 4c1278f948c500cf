"""White noise is flat at one; a sine's power stands at its frequency."""

import numpy as np
import pytest
from scipy import signal

from pysim.identify.residual_spectrum import residual_spectrum

TIME = np.arange(8192) / 200


def test_noise_of_size_one_has_power_one_and_the_spread_that_is_told() -> None:
    _, power, freedom = residual_spectrum(TIME, np.random.default_rng(1).standard_normal(TIME.size))
    assert np.mean(power) == pytest.approx(1.0, abs=0.03)
    assert np.var(power) == pytest.approx(2 / freedom, rel=0.2)  # of a chi-square over its degrees of freedom


@pytest.mark.parametrize("samples", [128, 129, 777, 4001])
def test_it_is_the_periodogram_of_welch_as_scipy_has_it(samples: int) -> None:
    values = np.random.default_rng(2).standard_normal(samples)
    frequency, power, _ = residual_spectrum(np.arange(samples) / 200, values)
    length = min(samples, max(64, samples // 8))
    wanted = signal.welch(values, 200, nperseg=length, detrend=False)
    lines = slice(1, (length + 1) // 2)
    np.testing.assert_allclose(frequency, wanted[0][lines], rtol=1e-12)
    np.testing.assert_allclose(power, wanted[1][lines] * 200 / 2, rtol=1e-12)


def test_the_power_of_a_sine_is_found_at_its_frequency() -> None:
    frequency, power, _ = residual_spectrum(TIME, 3 * np.sin(2 * np.pi * 24.0 * TIME))
    assert frequency[np.argmax(power)] == pytest.approx(24.0, abs=0.2)
    step = frequency[1] - frequency[0]
    assert np.sum(power) * step / 100 == pytest.approx(3**2 / 2, rel=0.01)  # power 1 up to 100 Hz is a variance of 1


@pytest.mark.parametrize("samples", [8 * 128, 8 * 129])  # segments of even and of odd length
def test_every_line_of_noise_has_power_one(samples: int) -> None:
    time, runs = np.arange(samples) / 200, 300
    powers = []
    for seed in range(runs):
        frequency, power, freedom = residual_spectrum(time, np.random.default_rng(seed).standard_normal(samples))
        powers.append(power)
    np.testing.assert_allclose(np.mean(powers, axis=0), 1.0, atol=5 * np.sqrt(2 / freedom / runs))
    np.testing.assert_allclose(np.var(powers, axis=0), 2 / freedom, rtol=0.5)
    assert frequency[0] > 0
    assert frequency[-1] < 100
