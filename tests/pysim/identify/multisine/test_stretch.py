"""The periodic part of a command is found among rest, ramp, hold and way back."""

import numpy as np
import pytest

from pysim.identify.multisine.stretch import periodic_stretch
from pysim.types import BadInput

WAVE = np.random.default_rng(0).standard_normal(100)


@pytest.mark.parametrize("noise", [0.0, 0.02])
@pytest.mark.parametrize("hold", [0, 50, 400])
def test_found(noise: float, hold: int) -> None:
    parts = [np.linspace(0, 20, 30), np.full(hold, 20.0), 20 + np.tile(WAVE, 4)[60:], np.linspace(20, 0, 30)]
    command = np.concatenate(parts) + noise * np.random.default_rng(1).standard_normal(30 + hold + 340 + 30)
    found = periodic_stretch(command, 100)
    assert abs(found.start - (30 + hold)) <= 2
    assert abs(found.stop - (30 + hold + 340)) <= 2


@pytest.mark.parametrize("quantum", [0.0, 0.0244])
def test_a_small_wave_on_a_large_offset(quantum: float) -> None:
    """0.3 around 50, also in the steps of a 12-bit converter of 0 to 100."""
    wave = 0.1 * WAVE + 1e-5 * np.random.default_rng(3).standard_normal((4, 100))
    command = np.concatenate([np.linspace(0, 50, 60), np.full(250, 50.0), 50 + wave.ravel(), np.linspace(50, 0, 40)])
    if quantum:
        command = quantum * np.round(command / quantum)
    found = periodic_stretch(command, 100)
    assert abs(found.start - 310) <= 3
    assert abs(found.stop - 710) <= 3


def test_refuses_another_period_and_no_period() -> None:
    with pytest.raises(BadInput, match="does not repeat itself"):
        periodic_stretch(np.tile(WAVE, 4), 130)
    with pytest.raises(BadInput, match="does not repeat itself"):
        periodic_stretch(np.random.default_rng(2).standard_normal(1000), 100)
