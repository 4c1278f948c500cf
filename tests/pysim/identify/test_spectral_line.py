"""Tones in noise of several colours; times and sizes from the arithmetic of a sine beside noise."""

import numpy as np
import pytest
from scipy.signal import lfilter

from pysim.identify.spectral_line import periodogram, spectral_line

RATE, COUNT = 250.0, 7500
TIMES = np.arange(COUNT) / RATE
COLOURS = {
    "white": ([1.0], [1.0]),
    "lag": ([1.0], [1.0, -0.95]),
    "high": ([1.0, -0.9], [1.0]),
    "resonance": ([1.0], [1.0, -2 * 0.98 * np.cos(2 * np.pi * 8 / RATE), 0.98**2]),  # 1.6 Hz wide at half its power
}


def noise(colour: str, seed: int) -> np.ndarray:
    rest = lfilter(*COLOURS[colour], np.random.default_rng(seed).standard_normal(COUNT + 1000))[1000:]
    return rest / rest.std()


@pytest.mark.parametrize("colour", COLOURS)
def test_noise_of_any_colour_holds_no_tone(colour: str) -> None:
    """Of 200 logs at one percent, more than eight have a chance of 1e-3."""
    found = [spectral_line(TIMES, noise(colour, seed)) for seed in range(200)]
    assert sum(one is not None and one[0] < 0.01 for one in found) <= 8


@pytest.mark.parametrize("colour", COLOURS)
@pytest.mark.parametrize("frequency", [3.03, 24.17])
def test_a_tone_is_heard(colour: str, frequency: float) -> None:
    """A sine of amplitude a has n a^2/4 times the power of a white line; Hann's window leaves two thirds."""
    rest = noise(colour, 1) + 1.0 * np.sin(2 * np.pi * frequency * TIMES)
    chance, heard = spectral_line(TIMES, rest) or (1.0, 0.0)
    assert chance < 1e-3
    assert heard == pytest.approx(frequency, abs=RATE / COUNT)


def test_short_and_uneven_logs_tell_nothing() -> None:
    rest = noise("white", 1)
    assert spectral_line(TIMES[:50], rest[:50]) is None
    jitter = TIMES + np.random.default_rng(1).uniform(0, 0.3 / RATE, COUNT)
    assert spectral_line(jitter, rest) is None


def test_the_periodogram_of_logs_a_day_apart_is_that_of_its_definition() -> None:
    """Its highest point is near the sine's rate; turns between the logs, 1/86400 Hz apart, fit nearly as well."""
    rng, rate = np.random.default_rng(3), 2 * np.pi * 24.17
    logs = [(t, np.cos(rate * t + 0.4) + rng.standard_normal(t.size)) for t in (TIMES, TIMES[:5000] + 86400.0)]
    coarse = rate + 2 * np.pi * np.arange(-0.05, 0.05, 1 / (8 * 30))
    fine = rate + 2 * np.pi * np.arange(-0.02, 0.02, 1 / (8 * 86420))
    found = periodogram(logs, coarse, fine)
    some = slice(None, None, 5000)
    direct = [abs(sum(np.exp(-1j * w * t) @ rest for t, rest in logs)) ** 2 for w in fine[some].tolist()]
    assert found[some] * sum(rest @ rest for _, rest in logs) == pytest.approx(direct, abs=0.03 * max(direct))
    assert abs(fine[np.argmax(found)] - rate) < 2 * np.pi / 30 / 20
