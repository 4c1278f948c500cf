"""Commands: closed forms at their knots, slopes that belong to them, leads that end at rest."""

import numpy as np
import pytest

from validation.blind.plant.command import Command, Lead, chirp, stepped_sine, wave
from validation.blind.plant.quantities import STEP


def knots(command: Command) -> np.ndarray:
    return np.arange(command.level.size) * command.every * STEP


@pytest.mark.parametrize(
    "command",
    [
        stepped_sine(Lead(50.0), 50.0, 20.0, 4.0, 1.25),
        chirp(Lead(50.0), 50.0, 10.0, 0.1, 30.0, 30.0),
        wave(Lead(0.0), (1, 2), 0.5, 30.0, 10.0),
    ],
)
def test_slopes_belong_to_levels(command: Command) -> None:
    test = knots(command) > command.start + 1e-9
    level, slope = command.level[test], command.slope[test]
    pitch = command.every * STEP
    differences = (level[2:] - level[:-2]) / (2 * pitch)
    assert np.abs(differences - slope[1:-1]).max() < 2e-3 * np.abs(slope).max()


def test_a_sine_starts_at_its_offset_after_rest_ramp_and_hold() -> None:
    command = stepped_sine(Lead(-50.0, hold=0.3), -50.0, 10.0, 2.0, 1.5)
    t = knots(command)
    assert command.start == pytest.approx(1.3)
    assert np.all(command.level[t < 0.5 - 1e-9] == 0.0)
    assert command.level[t > 1.0] == pytest.approx(
        -50 + np.where(t[t > 1.0] > 1.3, 10 * np.sin(4 * np.pi * (t[t > 1.0] - 1.3)), 0.0), abs=1e-9
    )
    assert command.slope[(t > 0.6) & (t < 0.9)] == pytest.approx(-100.0)


def test_a_chirp_ends_at_its_last_frequency() -> None:
    command = chirp(Lead(50.0), 50.0, 10.0, 0.1, 30.0, 30.0)
    t = knots(command)
    last = command.slope[(t > 31.5) & (t <= 32.0)]
    assert last.max() == pytest.approx(10 * 2 * np.pi * 29.9, rel=1e-2)


def test_a_wave_has_its_size_peak_and_no_jump() -> None:
    command = wave(Lead(0.0, before=15.0), (3, 0), 1.0, 30.0, 60.0)
    test = knots(command) >= command.start - 1e-9
    swing = command.level[test]
    assert command.level[0] == 15.0
    assert swing[0] == 0.0
    assert np.abs(swing).max() <= 95.1
    assert 20.0 < swing.std() < 33.0
    spectrum = np.abs(np.fft.rfft(swing[2000:]))
    f = np.fft.rfftfreq(swing[2000:].size, command.every * STEP)
    assert f[spectrum.argmax()] == pytest.approx(1.0, abs=0.25)
    assert not np.array_equal(swing, wave(Lead(0.0), (4, 0), 1.0, 30.0, 60.0).level[test])
