import math

import numpy as np
import pytest

from pysim.rig import HeaveTest, heave_figures
from pysim.types import BadInput, Record

NAMES = ("rig.omega", "rig.pL", "rig.pS", "crane.omegaS_ref", "crane.pL_ref")
UNITS = ("rad/s", "Pa", "Pa", "rad/s", "Pa")


def test_velocity_begins_at_rest_and_is_the_wave_s_rate() -> None:
    test = HeaveTest(length=4000.0, seed=3)
    signal = test.velocity()
    assert signal.value(np.array([0.0, 2.9])).tolist() == [0.0, 0.0]
    assert abs(signal.value(np.array([3.0 + 1e-9]))[0]) < 1e-6
    time = np.arange(3.0, 4003.0, 0.05)
    velocity = signal.value(time)
    heave = np.cumsum(velocity) * 0.05
    assert 4 * np.std(heave) == pytest.approx(2.0, rel=0.1)  # significant height, four standard deviations
    spectrum = np.abs(np.fft.rfft(velocity)) ** 2
    omega = 2 * np.pi * np.fft.rfftfreq(time.size, 0.05)
    mean = np.average(omega, weights=spectrum)
    assert 2 * np.pi / 10.0 < mean < 2.2 * 2 * np.pi / 10.0


def test_another_seed_is_another_wave() -> None:
    at = np.linspace(5, 50, 20)
    assert not np.allclose(HeaveTest(seed=1).velocity().value(at), HeaveTest(seed=2).velocity().value(at))
    assert HeaveTest(seed=1).velocity().value(at).tolist() == HeaveTest(seed=1).velocity().value(at).tolist()


def test_figures_of_known_errors() -> None:
    test = HeaveTest(rest=0.0, settle=5.0, length=100.0)
    time = np.arange(0.0, 100.0005, 0.002)
    reference = 20 * np.sin(2 * np.pi * 0.1 * time)
    speed = reference + 2 * np.sin(2 * np.pi * 8 * time)
    speed[(time > 39.0) & (time < 41.0)] = 0.0  # held at a reversal
    slow, fast = 3e5 * np.sin(2 * np.pi * 0.1 * time), 4e5 * np.sin(2 * np.pi * 8 * time)
    columns = [speed, 105e5 + slow + fast, 100e5 + 50e5 * np.sin(time), reference, np.full(time.size, 105e5)]
    found = heave_figures(Record(time, np.column_stack(columns), NAMES, UNITS), test)
    assert found.pressure_rms == pytest.approx(math.sqrt(3e5**2 / 2 + 4e5**2 / 2), rel=0.01)
    assert found.pressure_slow_rms == pytest.approx(3e5 / math.sqrt(2), rel=0.02)
    assert found.supply_low == pytest.approx(50e5, rel=1e-3)
    assert found.supply_high == pytest.approx(150e5, rel=1e-3)
    assert found.held_longest == pytest.approx(2.0, abs=0.05)
    assert found.held_reference == pytest.approx(2 * math.asin(0.025) / (0.2 * math.pi), abs=0.01)
    assert 1.4 < found.speed_rms < 2.5


def test_wrong_tests_are_refused() -> None:
    with pytest.raises(BadInput, match="peak period"):
        HeaveTest(peak_period=0.0)
    with pytest.raises(BadInput, match="seconds within the test"):
        HeaveTest(settle=100.0)
    short = Record(np.linspace(0, 1, 10), np.zeros((10, 5)), NAMES, UNITS)
    with pytest.raises(BadInput, match="run it to the end"):
        heave_figures(short, HeaveTest())
