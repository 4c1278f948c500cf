"""Noise that was made comes back, whatever the signal below it does."""

import numpy as np
import pytest

from pysim.diagnose.noise import Noise, estimated_noise, white
from tests.pysim.diagnose.logs import RATE, noise, sines, wave

TOLD = 0.05


def test_white_noise_as_told_stays_as_told() -> None:
    plain = 0
    for seed in range(12):
        rng = np.random.default_rng(seed)
        target = sines(lambda n: TOLD * rng.standard_normal(n), TOLD)  # noqa: B023 - used within its turn
        plain += estimated_noise([target])["data", "y"].plain
    assert plain >= 11


@pytest.mark.parametrize(("ratio", "memory"), [(0.5, 0.1), (1.0, 0.03), (1.8, 0.012)])
def test_noise_with_memory_is_found_between_the_harmonics(ratio: float, memory: float) -> None:
    rng = np.random.default_rng(5)
    true = TOLD / np.hypot(1, ratio)
    found = estimated_noise([sines(lambda n: noise(n, true, ratio * true, memory, rng), TOLD)])["data", "y"]
    assert found.deviation == pytest.approx(TOLD, rel=0.04)
    assert found.coloured / found.white == pytest.approx(ratio, rel=0.15)
    assert found.memory == pytest.approx(memory, rel=0.35)  # 50 s of it at hand
    at = np.array([0.5, 5.0, 50.0])
    wanted = Noise(true, ratio * true, memory, TOLD).spectrum(at, 1 / RATE)
    assert found.spectrum(at, 1 / RATE) == pytest.approx(wanted, rel=0.25)


def test_a_wrong_word_of_the_noise_is_corrected() -> None:
    rng = np.random.default_rng(3)
    found = estimated_noise([sines(lambda n: 2 * TOLD * rng.standard_normal(n), TOLD)])["data", "y"]
    assert found.coloured == 0
    assert found.white == pytest.approx(2 * TOLD, rel=0.02)
    assert not found.plain


def test_a_signal_that_never_repeats_takes_the_memory_of_the_one_beside_it() -> None:
    rng = np.random.default_rng(8)
    white_part, ratio, memory = TOLD / np.hypot(1, 1.2), 1.2, 0.05
    time = np.arange(round(30 * RATE)) / RATE
    slow = 20 * np.sin(2 * np.pi * 0.9 * time) + 5 * np.sin(2 * np.pi * 3.1 * time + 1)
    beside = sines(lambda n: noise(n, white_part, ratio * white_part, memory, rng), TOLD)
    log = wave(slow + noise(time.size, white_part, ratio * white_part, memory, rng), TOLD, name="u")
    found = estimated_noise([beside, log])
    assert found["data", "u"].memory == found["data", "y"].memory
    assert found["data", "u"].coloured / found["data", "u"].white == pytest.approx(ratio, rel=0.2)


def test_what_a_signal_does_itself_is_not_taken_for_noise() -> None:
    rng = np.random.default_rng(2)
    time = np.arange(round(30 * RATE)) / RATE
    busy = np.sum([np.sin(2 * np.pi * f * time + f) * 30 / f for f in np.arange(0.5, 30, 0.7)], axis=0)
    found = estimated_noise([wave(busy + TOLD * rng.standard_normal(time.size), TOLD)])["data", "y"]
    assert found == white(TOLD)


def test_untold_noise_has_the_size_that_is_seen() -> None:
    rng = np.random.default_rng(4)
    found = estimated_noise([sines(lambda n: TOLD * rng.standard_normal(n), 1.0)], told=False)["data", "y"]
    assert found.deviation == pytest.approx(TOLD, rel=0.03)


def test_short_logs_are_believed() -> None:
    assert estimated_noise([wave(np.zeros(50), TOLD)])["data", "y"] == white(TOLD)
