"""Long signals on a screen: no peak is lost, and nothing is left out once there is room."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pysim.app.decimate import decimated, window


@given(st.integers(2000, 20000), st.integers(4, 1600), st.integers(0, 2**31))
def test_every_peak_is_kept_among_few_points(count: int, most: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    time, values = np.arange(count) * 0.01, rng.standard_normal(count)
    x, y = decimated(time, values, most)
    assert x.size <= max(most, 4)
    assert (y.min(), y.max()) == (values.min(), values.max())
    assert (x[0], x[-1]) == (time[0], time[-1])
    assert np.all(np.diff(x) > 0)
    assert np.array_equal(values[np.searchsorted(time, x)], y)  # samples, nothing in between


def test_few_samples_come_back_as_they_are() -> None:
    time, values = np.arange(50.0), np.arange(50.0) ** 2
    x, y = decimated(time, values, 50)
    assert x is time
    assert y is values


def test_a_window_reaches_over_both_edges() -> None:
    time = np.arange(10.0)
    assert window(time, 2.5, 5.5) == slice(2, 8)
    assert window(time, -5.0, 50.0) == slice(0, 10)
