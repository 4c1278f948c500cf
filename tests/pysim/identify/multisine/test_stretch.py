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


def test_refuses_another_period_and_no_period() -> None:
    with pytest.raises(BadInput, match="does not repeat itself"):
        periodic_stretch(np.tile(WAVE, 4), 130)
    with pytest.raises(BadInput, match="does not repeat itself"):
        periodic_stretch(np.random.default_rng(2).standard_normal(1000), 100)
