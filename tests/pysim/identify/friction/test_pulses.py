"""The pulse sensor: against closed forms, against the Modelica sensor's events, and read back from its log."""

import numpy as np
import pytest

from pysim.identify.friction import pulse_intervals, pulse_speed, pulse_times
from pysim.types import BadInput
from tests.pysim.identify.friction.shafts import simulated

PITCH = 2 * np.pi / 10


def test_even_acceleration() -> None:
    """From rest, edge k comes at sqrt(2 k pitch / a), the first one at once."""
    time = np.linspace(0, 3, 301)
    edges = pulse_times(time, 2 * time**2, 4 * time)
    np.testing.assert_allclose(edges, np.sqrt(2 * PITCH * np.arange(edges.size) / 4), atol=1e-9)
    assert edges.size == 1 + int(18 / PITCH)


def test_many_edges_between_two_samples() -> None:
    time = np.array([0.0, 1.0])
    edges = pulse_times(time, np.array([0.1, 20.1]), np.array([20.0, 20.0]))
    np.testing.assert_allclose(edges, (PITCH * np.arange(1, edges.size + 1) - 0.1) / 20, atol=1e-12)
    assert edges.size == int(20.1 / PITCH)


def test_backward_edges_come_at_the_other_end_of_a_tooth() -> None:
    """Up to 0.9 of a pitch and back to -0.9: metal is at 0 ... 1/2 and -1 ... -1/2 of a pitch."""
    time = np.linspace(0, 2 * np.pi, 2001)
    angle, speed = 0.9 * PITCH * np.sin(time), 0.9 * PITCH * np.cos(time)
    fall = np.arcsin(0.5 / 0.9)
    expected = [0.0, np.pi - fall, np.pi + fall, 2 * np.pi]
    np.testing.assert_allclose(pulse_times(time, angle, speed)[:3], expected[:3], atol=1e-6)


def test_agrees_with_the_events_of_the_modelica_sensor() -> None:
    swing = simulated()
    record = swing.record
    edges = pulse_times(record.time, record["theta"], record["omega"])
    speed = pulse_speed(edges, record.time, swing.command.value(record.time))
    assert edges.size > 2000
    # relative to 50 rad/s; the solver's tolerance is 1e-7, the record's cubic between samples is as good
    np.testing.assert_allclose(speed, record["omega_s"], atol=1e-4)


def test_intervals_are_read_back_from_the_log() -> None:
    """A steady acceleration, logged at 250 Hz: each interval's ends to half a sample, its speed exactly."""
    time = np.arange(0, 6, 0.004)
    edges = np.sqrt(2 * PITCH * np.arange(1, 60) / 4)
    found = pulse_intervals(time, pulse_speed(edges, time, np.ones(time.size)))
    np.testing.assert_allclose(found.speed[:40], PITCH / np.diff(edges)[:40], rtol=1e-12)
    assert np.abs(found.end[:40] - edges[1:41]).max() <= 0.002 + 1e-9
    assert np.abs(found.start[:40] - edges[:40]).max() <= 0.002 + 1e-9
    assert found.whole[2:].all()  # before the second edge the reading, and so its sign, is zero


def test_an_interval_with_a_reversal_is_not_whole() -> None:
    """Two edges forward, the command changes sign, then edges backward: the interval across tells nothing."""
    edges = np.array([0.1, 0.3, 0.52, 1.9, 2.3, 2.65, 3.05])
    time = np.arange(0, 3.5, 0.01)
    found = pulse_intervals(time, pulse_speed(edges, time, np.where(time < 1.0, 1.0, -1.0)))
    across = np.argmin(np.abs(found.end - 1.9))
    assert not found.whole[across]
    assert found.whole.sum() == found.whole.size - 2  # and the first, before which there is no reading
    assert set(np.sign(found.speed[found.whole])) == {1.0, -1.0}
    assert found.run[0] != found.run[-1]


def test_steps_below_the_noise_are_not_taken_for_pulses() -> None:
    edges = np.sqrt(2 * PITCH * np.arange(1, 40) / 4)
    time = np.arange(0, edges[-1], 0.004)
    clean = pulse_speed(edges, time, np.ones(time.size))
    noisy = clean + np.random.default_rng(5).normal(0, 0.005, time.size)
    found = pulse_intervals(time, noisy, noise=0.005)
    plain = pulse_intervals(time, clean)
    assert found.speed.size == plain.speed.size
    np.testing.assert_allclose(found.speed, plain.speed, atol=0.01)


def test_a_reading_that_stands_still_is_refused() -> None:
    with pytest.raises(BadInput, match="changes 0 times"):
        pulse_intervals(np.arange(100.0), np.ones(100))
