"""Friction samples against the law the shaft was simulated with."""

import numpy as np
import pytest

from pysim.identify.friction import ShaftTest, filtered_samples, mean_friction, pulse_samples, pulse_speed
from pysim.types import BadInput
from tests.pysim.identify.friction.shafts import INERTIA, TRUTH, closed_form, measured, simulated


def test_pulse_samples_scatter_around_the_law_by_what_they_claim() -> None:
    samples = pulse_samples(measured(simulated(), 1), INERTIA)
    score = (samples.torque - mean_friction(TRUTH, samples.speed, samples.change)) / samples.sigma
    assert samples.speed.size > 800
    assert np.std(score) == pytest.approx(1.0, abs=0.1)
    for low, high in ((0, 6), (6, 15), (15, 60)):
        some = (np.abs(samples.speed) >= low) & (np.abs(samples.speed) < high)
        assert some.sum() > 8
        assert abs(np.mean(score[some] * np.sign(samples.speed[some]))) < 4 / np.sqrt(some.sum())


@pytest.mark.parametrize("cutoff_hz", [0.01, 1e-9])
def test_a_log_that_is_short_beside_the_filter_is_refused(cutoff_hz: float) -> None:
    time = np.arange(0, 20, 0.01)
    with pytest.raises(BadInput, match="raise the cutoff"):
        filtered_samples(ShaftTest("t", time, np.cos(time), np.sin(time)), INERTIA, cutoff_hz=cutoff_hz)


def test_inertia_counts() -> None:
    """Without it the samples miss by J dw/dt, 0.4 N.m at the swing's steepest."""
    swing = simulated()
    with_it, without = (pulse_samples(measured(swing, 1, torque_noise=0.0), j) for j in (INERTIA, 0.0))
    np.testing.assert_allclose(without.torque - with_it.torque, INERTIA * with_it.acceleration)
    assert np.abs(with_it.acceleration).max() > 4


def test_filtered_samples_of_the_true_speed_follow_the_law_where_it_is_straight() -> None:
    """With the true speed in place of the pulses; within 0.5 s of a standstill the filter rounds the corner off."""
    record = simulated().record
    samples = filtered_samples(ShaftTest("t", record.time, record["omega"], record["T_s"]), INERTIA)
    error = samples.torque - closed_form(samples.speed)
    assert np.abs(error[np.abs(samples.speed) > 10]).max() < 0.02
    assert samples.time[0] >= 0.3 - 1e-9


def test_filtered_pulses_are_wrong_near_standstill() -> None:
    """What the held speed costs: newton metres below 3 rad/s, where the samples by pulses are good to tenths."""
    test = measured(simulated(), 2)
    filtered, counted = filtered_samples(test, INERTIA), pulse_samples(test, INERTIA)
    slow = (np.abs(filtered.speed) > 1) & (np.abs(filtered.speed) < 3)
    assert np.sqrt(np.mean((filtered.torque - closed_form(filtered.speed))[slow] ** 2)) > 5
    error = counted.torque - mean_friction(TRUTH, counted.speed, counted.change)
    assert np.abs(error[np.abs(counted.speed) < 5]).max() < 0.5


def test_a_standstill_inside_an_interval_is_left_out() -> None:
    """Teeth pass at 5 rad/s, the shaft stands for 4 s, then goes on: the long interval's mean speed means nothing."""
    rng, gap = np.random.default_rng(6), 2 * np.pi / 10 / 5
    edges = np.arange(120) * gap + np.where(np.arange(120) < 60, 0.0, 4.0) + rng.normal(0, 1e-5, 120)
    time = np.arange(0, edges[-1], 0.004)
    speed = pulse_speed(edges, time, np.ones(time.size))
    assert speed[time < edges[61]].min() < 0.2  # the sensor has shown it
    samples = pulse_samples(ShaftTest("t", time, speed, np.full(time.size, 20.0)), INERTIA)
    assert np.abs(samples.speed).min() > 4.9
    assert samples.speed.size > 100
    assert dict(samples.dropped)["next to a standstill or reversal"] > 0


def test_refuses_logs_that_hold_nothing() -> None:
    time = np.arange(0, 10, 0.004)
    with pytest.raises(BadInput, match="changes 0 times"):
        pulse_samples(ShaftTest("t", time, np.zeros(time.size), time), INERTIA)
    with pytest.raises(BadInput, match="too short for a cutoff"):
        filtered_samples(ShaftTest("t", time[:100], time[:100], time[:100]), INERTIA)


def test_rounding_bounds_a_noise_that_nobody_told() -> None:
    """A torque that rounding holds still has no second differences; noise above the rounding shows in them."""
    time = np.arange(0, 20, 0.004)
    speed = pulse_speed(np.arange(160) * 2 * np.pi / 10 / 5, time, np.ones(time.size))

    def weight(torque: np.ndarray, rounding: float) -> float:
        test = ShaftTest("t", time, speed, torque, torque_rounding=rounding)
        return float(np.median(pulse_samples(test, 0.0).sigma))

    held, noisy = np.full(time.size, 20.0), 20 + np.random.default_rng(1).normal(0.0, 0.5, time.size)
    assert weight(held, 0.0) == 0.0
    assert weight(held, 0.3) == pytest.approx(0.3 / np.sqrt(2 * np.pi / 10 / 5 / 0.004), rel=1e-3)
    assert weight(noisy, 0.1) == weight(noisy, 0.0)
