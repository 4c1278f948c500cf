"""The interval between samples, from times as loggers print them."""

import numpy as np
import pytest

from pysim.identify.sampling import sampling


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
