"""Frequency responses fitted to the steady output of a known linear system."""

import numpy as np
import pytest

from pysim.identify import TransferFunction, frequency_response, magnitude_db, stepped_sine
from pysim.types import BadInput, Record, SineTest

FREQUENCIES = [0.1, 0.5, 2.0, 5.0, 8.0, 13.0]
SYSTEM = TransferFunction((0.9e5,), (1.0, 60.0, 5e3, 1e5))
TEST = SineTest(50.0, 10.0, "a", "y")


def steady(frequency: float, noise: float = 0.0, seed: int = 0) -> Record:
    """The steady output of SYSTEM to 50 + 10 sin."""
    times = stepped_sine(TEST, frequency).times
    g = SYSTEM.at(np.array([frequency]))[0]
    y = 10 * abs(g) * np.sin(2 * np.pi * frequency * (times - 2.0) + np.angle(g)) + 0.9 * 50
    y = y + np.random.default_rng(seed).normal(0.0, noise, times.size) if noise else y
    return Record(times, y[:, None], ("y",), ("%",), origin="closed form")


def test_recovers_the_transfer_function() -> None:
    response = frequency_response([steady(f) for f in FREQUENCIES], FREQUENCIES, TEST, onset=2.0)
    exact = SYSTEM.response(np.array(FREQUENCIES), TEST)
    np.testing.assert_allclose(response.gain, exact.gain, rtol=1e-10)
    np.testing.assert_allclose(response.phase, exact.phase, atol=1e-10)
    assert response.phase[-1] < -np.pi  # beyond half a turn, so the unwrapping was needed
    np.testing.assert_allclose(response.mean, 45.0)
    assert response.origin == "closed form"


def test_noise_arrives_as_covariance() -> None:
    record = steady(2.0, noise=0.1, seed=3)
    response = frequency_response([record], [2.0], TEST, onset=2.0, noise=0.1)
    expected = np.sqrt(2 * 0.01 / record.time.size)
    assert response.covariance is not None
    assert np.sqrt(response.covariance[0, 0, 0]) == pytest.approx(expected, rel=1e-6)
    assert abs(response.gain[0] * 10 - 10 * abs(SYSTEM.at(np.array([2.0]))[0])) < 4 * expected


def test_magnitude_counts_from_the_reference() -> None:
    response = frequency_response([steady(f) for f in FREQUENCIES], FREQUENCIES, TEST, onset=2.0)
    relative, absolute = magnitude_db(response), magnitude_db(response, None)
    assert relative[0] == 0.0
    np.testing.assert_allclose(absolute - relative, 20 * np.log10(response.gain[0]))
    with pytest.raises(BadInput, match=r"relative to 0\.3 Hz need that frequency"):
        magnitude_db(response, 0.3)


def test_refuses_counts_that_do_not_match() -> None:
    with pytest.raises(BadInput, match="1 records for 2 frequencies"):
        frequency_response([steady(2.0)], [2.0, 3.0], TEST, onset=2.0)
