"""The least level that a signal's residual is divided by."""

import numpy as np
import pytest

from pysim.identify.greybox.noise import noise_floor
from pysim.identify.greybox.settings import NoiseSettings
from pysim.types import MeasuredSignal


def test_a_short_piece_of_a_ramp_is_no_sign_of_a_coarse_sensor() -> None:
    signal = MeasuredSignal("x", "output", "m", "x", "x", noise=1e-3)
    long = np.random.default_rng(1).normal(size=5000)
    assert noise_floor(signal, [long, 0.05 * np.arange(10.0)], NoiseSettings()).sd == 1e-3


def test_a_coarse_sensor_is_seen_in_the_longest_log() -> None:
    signal = MeasuredSignal("x", "output", "m", "x", "x", noise=1e-3)
    log = 0.05 * np.round(np.random.default_rng(1).normal(size=5000) / 0.05)
    assert noise_floor(signal, [log], NoiseSettings()).sd == pytest.approx(0.05 / np.sqrt(12))
