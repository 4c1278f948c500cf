"""Cutting logs into periods, and refusing what cannot be cut."""

import numpy as np
import pytest

from pysim.identify.multisine import Periods, periods_of
from pysim.types import BadInput, Record


def log(time: np.ndarray, origin: str = "a.txt") -> Record:
    return Record(
        time,
        np.column_stack([np.sin(np.pi * time), time, -np.sin(np.pi * time)]),
        ("u", "y", "r"),
        ("%", "bar", "1"),
        origin=origin,
    )


def test_the_last_whole_periods_are_kept() -> None:
    periods = periods_of([log(np.arange(1030) * 0.01), log(np.arange(830) * 0.01)], 2.0, ("u", "y"))
    assert periods.values.shape == (2, 4, 200, 2)
    assert (periods.names, periods.units, periods.origin) == (("u", "y"), ("%", "bar"), "a.txt")
    np.testing.assert_allclose(periods.values[0, 0, :3, 1], [2.30, 2.31, 2.32])
    np.testing.assert_allclose(periods.values[1, -1, -1, 1], 8.29)


def test_a_start_and_a_reference() -> None:
    periods = periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u", "y", "r"), start=5.0)
    assert periods.values.shape == (1, 2, 200, 3)
    np.testing.assert_allclose(periods.values[0, 0, 0], [np.sin(5 * np.pi), 5.0, np.sin(5 * np.pi)], atol=1e-9)
    assert periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u", "y"), start=1.0, count=3).values.shape[1] == 3
    assert periods.without_first(1).values.shape == (1, 1, 200, 3)


def test_lead_in_and_way_back_are_left_out() -> None:
    """Rest, ramp, hold, three periods and a part, and a ramp to zero: the last three periods before that ramp."""
    rng = np.random.default_rng(0)
    wave = rng.standard_normal(200)
    u = np.concatenate([np.zeros(450), np.linspace(0, 50, 50), np.full(500, 50), 50 + np.tile(wave, 4)[120:]])
    u = np.concatenate([u, np.linspace(u[-1], 0, 60), np.zeros(100)])
    u = u + 0.01 * rng.standard_normal(u.size)
    time = 0.01 * np.arange(u.size)
    record = Record(time, np.column_stack([u, time]), ("u", "y"), ("%", "1"))
    periods = periods_of([record], 2.0, ("u", "y"))
    assert periods.values.shape[:3] == (1, 3, 200)
    np.testing.assert_allclose(periods.values[0, :, :, 0], np.tile(50 + wave, (3, 1)), atol=0.06)
    with pytest.raises(BadInput, match="does not repeat itself"):
        periods_of([record], 1.7, ("u", "y"))


def test_rounded_times_of_a_log_are_no_reason_to_refuse() -> None:
    time = np.round(np.arange(1000) / 300, 5)
    assert periods_of([log(time)], 1.0, ("u", "y"), start=0.0).values.shape == (1, 3, 300, 2)


def test_a_last_digit_may_round_but_not_hide_uneven_sampling() -> None:
    """70 Hz printed in ms is off by 3.5 percent of an interval; a jitter of 5 percent told in full is refused."""
    time = np.arange(700) / 70
    assert periods_of([log(np.round(time, 3))], 1.0, ("u", "y"), start=0.0).values.shape == (1, 10, 70, 2)
    with pytest.raises(BadInput, match="not sampled at equal intervals"):
        periods_of([log(np.round(time, 2))], 1.0, ("u", "y"), start=0.0)
    uneven = time + np.random.default_rng(0).uniform(-0.05, 0.05, 700) / 70
    with pytest.raises(BadInput, match="not sampled at equal intervals"):
        periods_of([log(uneven)], 1.0, ("u", "y"), start=0.0)


@pytest.mark.parametrize(
    ("time", "period", "words"),
    [
        (np.arange(1000) * 0.01 + np.where(np.arange(1000) > 500, 0.004, 0), 2.0, "not sampled at equal intervals"),
        (np.delete(np.arange(1000) * 0.01, 400), 2.0, "not sampled at equal intervals"),
        (np.arange(1000) * 0.01, 20.0, "less than one period"),
        (np.arange(1000) * 0.01, 2.001, "choose a period of whole samples, as 2 s"),
        (np.arange(1000) * 0.01, -1.0, "positive"),
        (np.arange(4) * 0.01, 0.02, "4 samples"),
    ],
)
def test_refusals(time: np.ndarray, period: float, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        periods_of([log(time)], period, ("u", "y"))


def test_refuses_records_that_do_not_fit_together() -> None:
    with pytest.raises(BadInput, match="same rate"):
        periods_of([log(np.arange(1000) * 0.01), log(np.arange(1000) * 0.02)], 2.0, ("u", "y"))
    with pytest.raises(BadInput, match="no record"):
        periods_of([], 2.0, ("u", "y"))
    with pytest.raises(BadInput, match="6 periods are asked for and 5"):
        periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u", "y"), count=6)
    with pytest.raises(BadInput, match="name the columns"):
        periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u",))
    with pytest.raises(BadInput, match="each once"):
        periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u", "u"))
    with pytest.raises(BadInput, match="holds 0 s from 50 s on"):
        periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u", "y"), start=50.0)
    with pytest.raises(BadInput, match="no signal 'z'"):
        periods_of([log(np.arange(1000) * 0.01)], 2.0, ("u", "z"))


def test_refuses_other_shapes_and_holes() -> None:
    with pytest.raises(BadInput, match="two or three signals"):
        Periods(np.zeros((1, 2, 8, 1)), ("u",), ("1",), 1.0)
    with pytest.raises(BadInput, match="finite"):
        Periods(np.full((1, 2, 8, 2), np.nan), ("u", "y"), ("1", "1"), 1.0)
    with pytest.raises(BadInput, match="cannot be left out"):
        Periods(np.zeros((1, 2, 8, 2)), ("u", "y"), ("1", "1"), 1.0).without_first(2)
