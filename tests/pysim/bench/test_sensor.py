"""A sensor: noise of the right size, limits, steps, and samples that are held."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pysim.bench import Sensor
from pysim.types import BadInput, MeasuredSignal


def sensor(
    noise: float | None = None, step: float | None = None, low: float | None = None, high: float | None = None
) -> Sensor:
    return Sensor(MeasuredSignal("x", "output", "%", "", "x", noise, step), low, high)


def random(seed: int = 7) -> np.random.Generator:
    return np.random.default_rng(seed)


def test_without_faults_it_shows_the_truth() -> None:
    values = np.linspace(-3, 3, 100)
    np.testing.assert_array_equal(sensor().measure(values, random()), values)
    np.testing.assert_array_equal(sensor(noise=0.0).measure(values, random()), values)


def test_noise_is_gaussian_and_of_that_size() -> None:
    errors = sensor(noise=0.3).measure(np.full(100_000, 5.0), random()) - 5.0
    assert abs(errors.mean()) < 4 * 0.3 / np.sqrt(1e5)
    assert errors.std() == pytest.approx(0.3, rel=4 / np.sqrt(2e5))  # four standard deviations of such an estimate
    assert np.mean(np.abs(errors) < 0.3) == pytest.approx(0.6827, abs=4 * np.sqrt(0.6827 * 0.3173 / 1e5))


def test_a_reading_is_the_nearest_step() -> None:
    values = np.array([0.2, 0.3, 0.7, 0.8, -0.2, -0.3])
    np.testing.assert_array_equal(sensor(step=0.5).measure(values, random()), [0.0, 0.5, 0.5, 1.0, 0.0, -0.5])


def test_steps_add_their_twelfth_to_the_variance() -> None:
    values = np.linspace(0, 50, 100_001)
    errors = sensor(noise=0.1, step=0.5).measure(values, random()) - values
    assert errors.var() == pytest.approx(0.1**2 + 0.5**2 / 12, rel=0.02)


@given(
    st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=20),
    st.floats(1e-3, 10),
    st.floats(-900, -1),
    st.floats(1, 900),
    st.floats(0, 5),
)
def test_readings_are_whole_steps_within_the_limits(
    values: list[float], step: float, low: float, high: float, noise: float
) -> None:
    readings = sensor(noise, step, low, high).measure(np.array(values), random())
    counts = readings / step
    np.testing.assert_allclose(counts, np.round(counts), atol=1e-6)
    assert readings.min() >= low - 1e-6 * step or step > high - low
    assert readings.max() <= high + 1e-6 * step or step > high - low
    if noise == 0 and low <= min(values) and max(values) <= high and step < 1:
        assert np.abs(readings - values).max() <= step


def test_one_limit_alone() -> None:
    values = np.array([-5.0, 0.0, 5.0])
    np.testing.assert_array_equal(sensor(high=1.0).measure(values, random()), [-5, 0, 1])
    np.testing.assert_array_equal(sensor(low=-1.0).measure(values, random()), [-1, 0, 5])


def test_a_slow_sensor_is_held() -> None:
    slow = Sensor(MeasuredSignal("x", "output", "%", "", "x"), rate=100.0)
    time = 2.0 + np.arange(8) / 250
    np.testing.assert_allclose(slow.sampled_at(time) - 2.0, [0, 0, 0, 0.01, 0.01, 0.02, 0.02, 0.02], atol=1e-12)
    np.testing.assert_array_equal(sensor().sampled_at(time), time)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"noise": -1.0}, "sensor x: noise is -1"),
        ({"step": np.inf}, "sensor x: resolution is inf"),
        ({"low": 1.0, "high": 1.0}, "its limits 1.0 and 1.0 leave nothing between"),
    ],
)
def test_refuses_settings_that_make_no_sense(settings: dict[str, float], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        sensor(**settings)
    with pytest.raises(BadInput, match="rate is 0 Hz"):
        Sensor(MeasuredSignal("x", "output", "%", "", "x"), rate=0.0)
