"""The sums over products of lines against the average over drawn phases."""

import numpy as np
import pytest

from validation.multisine.systems import (
    AMPLITUDE,
    LINES,
    SAMPLES,
    cube_power,
    cubic_gain,
    gain,
    linear,
    measured,
    square_power,
)


def test_powers_are_those_of_drawn_phases() -> None:
    u = measured(lambda u: u, realisations=4000, periods=1, noise=0.0, seed=0).values[:, 0, :, 0]
    square, cube = (np.fft.rfft(u**n, axis=1) * 2 / SAMPLES / AMPLITUDE for n in (2, 3))
    phase = np.fft.rfft(u, axis=1)[:, LINES] * 2 / SAMPLES / AMPLITUDE
    for k, expected in list(square_power().items())[::7]:
        assert np.mean(np.abs(square[:, k]) ** 2) == pytest.approx(expected, rel=0.12)
    kept = (cubic_gain(1.0) - 1) * phase
    power = cube_power()
    found = np.mean(np.abs(cube[:, LINES] - kept) ** 2, axis=0)
    np.testing.assert_allclose(found, [power[k] for k in LINES.tolist()], rtol=0.12)
    # a gain is the mean product with the phase turned back
    mean = np.mean(cube[:, LINES] * phase.conj(), axis=0)
    np.testing.assert_allclose(mean, cubic_gain(1.0) - 1, atol=5 * np.sqrt(found.max() / 4000))


def test_linear_is_its_gain() -> None:
    u = np.cos(2 * np.pi * 5 * np.arange(SAMPLES) / SAMPLES)
    expected = np.real(gain(np.array([5])) * np.exp(2j * np.pi * 5 * np.arange(SAMPLES) / SAMPLES))
    np.testing.assert_allclose(linear(u), expected, atol=1e-12)
