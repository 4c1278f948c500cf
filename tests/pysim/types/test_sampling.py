"""The interval between samples, from times as loggers print them."""

import numpy as np
import pytest

from pysim.types import sampling


@pytest.mark.parametrize("rate", [70.0, 240.0, 333.0])
def test_printed_times_give_the_interval(rate: float) -> None:
    found = sampling(np.round(np.arange(2000) / rate, 4))
    assert found.step == pytest.approx(1 / rate, abs=1e-4 / 1999)
    assert found.digit == 1e-4
    assert found.gaps.size == 0


def test_gaps_do_not_count() -> None:
    time = np.delete(np.round(np.arange(1000) / 70, 3), [100, 101, 102, 700])
    found = sampling(time)
    assert found.step == pytest.approx(1 / 70, rel=2e-4)
    np.testing.assert_array_equal(found.gaps, [99, 696])


def test_a_digit_as_coarse_as_the_interval_is_none() -> None:
    assert sampling(np.arange(10.0)).digit == 0.0
    assert sampling(np.cumsum(np.random.default_rng(0).uniform(1, 1.1, 50))).digit == 0.0


@pytest.mark.parametrize("rate", [60.0, 70.0, 85.0, 95.0])
def test_a_digit_nearly_as_coarse_as_the_interval_makes_no_gaps(rate: float) -> None:
    found = sampling(np.round(0.3 + np.arange(1000) / rate, 2))
    assert found.step == pytest.approx(1 / rate, abs=0.02 / 999)
    assert found.gaps.size == 0
    lost = sampling(np.round(np.delete(np.arange(1000) / rate, slice(300, 310)), 2))
    assert lost.step == pytest.approx(1 / rate, rel=0.02)
    assert lost.gaps.tolist() == [299]


def test_samples_lost_now_and_then_are_gaps_however_coarse_the_digit() -> None:
    kept = np.random.default_rng(3).random(2000) > 0.05
    time = np.round(np.arange(2000)[kept] / 100, 2)
    found = sampling(time)
    assert found.step == pytest.approx(0.01)
    np.testing.assert_array_equal(found.gaps, np.flatnonzero(np.diff(time) > 0.015))
