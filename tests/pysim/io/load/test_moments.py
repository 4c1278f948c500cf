"""Dates, times and clocks of any form, as seconds."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from typing import Any
from zoneinfo import ZoneInfoNotFoundError

import numpy as np
import pytest

from pysim.nouns.data import load
from pysim.types import BadInput, Record

COUNT = 60
STEP = 0.02
BEGIN = datetime(2026, 3, 1, 13, 5, 0, tzinfo=UTC)
MOMENTS = [BEGIN + timedelta(seconds=STEP * k) for k in range(COUNT)]
SIGNALS = {"F [N]": np.sin(np.arange(COUNT)), "x [mm]": np.cos(np.arange(COUNT))}


def loaded(cells: Any, heading: str = "stamp", **said: Any) -> tuple[Record, float | None, tuple[str, ...]]:
    data = load({heading: cells, **SIGNALS}, inputs="F", outputs="x", **said)
    record = data.now.records[0]
    assert isinstance(record.data, Record)
    return record.data, record.begin, data.remarks["log.txt"]


def texts(form: str, hours: int = 0, end: str = "") -> np.ndarray:
    own = [f"{moment + timedelta(hours=hours):{form}}"[: None if "%f" not in form else -3] + end for moment in MOMENTS]
    return np.array(own, dtype=object)


@pytest.mark.parametrize(
    "cells",
    [
        texts("%Y-%m-%d %H:%M:%S.%f"),
        texts("%Y-%m-%dT%H:%M:%S.%f", end="Z"),
        texts("%Y-%m-%dT%H:%M:%S.%f", 1, "+01:00"),
        texts("%Y-%m-%d %H:%M:%S.%f", -5, "-0500"),
        texts("%Y-%m-%d %H:%M:%S.%f", 1, " Europe/Berlin"),
        texts("%Y-%m-%d %H:%M:%S.%f", end=" UTC"),
        texts("%d.%m.%Y %H:%M:%S.%f"),
        texts("%Y/%m/%d %H:%M:%S.%f"),
        np.array(MOMENTS, dtype=object),
        np.array([np.datetime64(m.replace(tzinfo=None)) for m in MOMENTS]),
    ],
)
def test_moments_of_any_form_and_zone(cells: np.ndarray) -> None:
    log, begin, remarks = loaded(cells)
    np.testing.assert_allclose(log.time, STEP * np.arange(COUNT), atol=1e-9)
    assert begin == pytest.approx(BEGIN.timestamp(), abs=1e-6)
    assert remarks[0] == "time: column 'stamp', since it holds dates or times of day"


def test_pandas_zones_and_summer_time() -> None:
    pandas = pytest.importorskip("pandas")
    index = pandas.date_range("2026-10-25 00:59:59.5", periods=COUNT, freq="20ms", tz="UTC")
    index = index.tz_convert("Europe/Berlin")  # where clocks go back in that second
    data = load(pandas.DataFrame(SIGNALS, index=index), inputs="F", outputs="x")
    record = data.dataset.records[0]
    assert isinstance(record.data, Record)
    np.testing.assert_allclose(record.data.time, STEP * np.arange(COUNT), atol=1e-9)


@pytest.mark.parametrize("zone", ["Z", "UTC", "GMT", "utc"])
def test_universal_time_needs_no_zone_data(zone: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> None:
        raise ZoneInfoNotFoundError(name)

    monkeypatch.setattr("pysim.io.load.moments.ZoneInfo", absent)
    assert loaded(texts("%Y-%m-%d %H:%M:%S.%f", end=f" {zone}"))[1] == pytest.approx(BEGIN.timestamp(), abs=1e-6)
    with pytest.raises(BadInput, match="zone 'Europe/Berlin'"):
        loaded(texts("%Y-%m-%d %H:%M:%S.%f", end=" Europe/Berlin"))


def dated(form: str, begin: datetime, step: timedelta) -> np.ndarray:
    return np.array([f"{begin + k * step:{form}}" for k in range(COUNT)], dtype=object)


@pytest.mark.parametrize(
    ("form", "begin", "step"),
    [
        ("%m/%d/%Y %I:%M:%S.%f %p", datetime(2026, 3, 14, 13, 5), timedelta(seconds=STEP)),  # no month 14
        ("%y/%m/%d %H:%M:%S", datetime(2032, 5, 17, 8), timedelta(seconds=1)),  # no day 32
        ("%y/%m/%d %H:%M:%S", datetime(2024, 5, 17, 23, 59, 30), timedelta(seconds=1)),  # a second later, and no year
        ("%d/%m/%y %H:%M:%S", datetime(2024, 5, 17, 23, 59, 30), timedelta(seconds=1)),
        ("%y-%m-%d %H:%M:%S", datetime(2011, 1, 10), timedelta(hours=1)),  # in any other order it would fall
        ("%m/%d/%y %H:%M:%S", datetime(2011, 1, 10), timedelta(hours=1)),
        ("%d.%m.%y %H:%M:%S", datetime(2011, 1, 10), timedelta(seconds=1)),  # with dots the day is first
    ],
)
def test_the_dates_of_a_log_decide_their_order(form: str, begin: datetime, step: timedelta) -> None:
    log, found, _ = loaded(dated(form, begin, step))
    np.testing.assert_allclose(log.time, step.total_seconds() * np.arange(COUNT), atol=1e-6)
    assert found == pytest.approx(begin.replace(tzinfo=UTC).timestamp(), abs=1e-5)


@pytest.mark.parametrize(
    ("order", "began", "apart"),
    [
        ("year/month/day", datetime(2024, 5, 17, 12, tzinfo=UTC), 730),
        ("day/month/year", datetime(2017, 5, 24, 12, tzinfo=UTC), 2),
        ("%d/%m/%y %H:%M:%S", datetime(2017, 5, 24, 12, tzinfo=UTC), 2),
    ],
)
def test_an_order_that_the_dates_leave_open_is_asked_for(order: str, began: datetime, apart: int) -> None:
    one_day = dated("%d/%m/%y %H:%M:%S", datetime(2017, 5, 24, 12), timedelta(seconds=1))
    log, begin, remarks = loaded(one_day)  # its times are known, and no more
    np.testing.assert_allclose(log.time, np.arange(COUNT), atol=1e-9)
    assert begin is None
    assert any("year/month/day or day/month/year" in remark for remark in remarks)
    assert loaded(one_day, units={"stamp": order})[1] == began.timestamp()
    days = dated("%d/%m/%y %H:%M:%S", datetime(2017, 5, 24, 12), timedelta(hours=1))[[0, 48]]
    frame = {"stamp": days, "F [N]": np.zeros(2), "x [mm]": np.zeros(2)}
    with pytest.raises(BadInput, match="is '24/05/17 12:00:00' year/month/day or day/month/year"):
        load(frame, inputs="F", outputs="x")
    record = load(frame, inputs="F", outputs="x", units={"stamp": order}).now.records[0]
    assert isinstance(record.data, Record)
    assert record.data.time[1] == pytest.approx(86400 * apart)


@pytest.mark.parametrize("form", ["%H:%M:%S.%f", "%I:%M:%S.%f %p", "%I:%M:%S,%f%p"])
def test_times_of_day_go_on_beyond_midnight(form: str) -> None:
    start = datetime(2026, 3, 1, 23, 59, 59, tzinfo=UTC)
    cells = [f"{start + timedelta(seconds=STEP * k * 5):{form}}" for k in range(COUNT)]
    log, begin, _ = loaded(np.array(cells, dtype=object))
    np.testing.assert_allclose(log.time, 5 * STEP * np.arange(COUNT), atol=1e-6)
    assert begin is None


@pytest.mark.parametrize(
    ("heading", "cells", "unit", "begin"),
    [
        ("t", STEP * np.arange(COUNT), {}, None),
        ("t [ms]", 1e3 * STEP * np.arange(COUNT), {}, None),
        ("Zeit / s", STEP * np.arange(COUNT), {}, None),
        ("time", STEP / 60 * np.arange(COUNT), {"time": "min"}, None),
        ("timestamp", BEGIN.timestamp() + STEP * np.arange(COUNT), {}, BEGIN.timestamp()),
        ("timestamp", 1e3 * (BEGIN.timestamp() + STEP * np.arange(COUNT)), {}, BEGIN.timestamp()),
        ("timestamp", 1e6 * (BEGIN.timestamp() + STEP * np.arange(COUNT)), {}, BEGIN.timestamp()),
        ("timestamp", 1e9 * (BEGIN.timestamp() + STEP * np.arange(COUNT)), {}, BEGIN.timestamp()),
        ("Zeit [seconds]", BEGIN.timestamp() + STEP * np.arange(COUNT), {}, BEGIN.timestamp()),
        ("clock [ns]", 1e9 * STEP * np.arange(COUNT), {}, None),
        ("t [secs]", STEP * np.arange(COUNT), {}, None),
        ("n", STEP * np.arange(COUNT), {"n": "sec"}, None),
        ("t", np.array(20 * np.arange(COUNT), dtype="timedelta64[ms]"), {}, None),
    ],
)
def test_numbers_as_times(heading: str, cells: np.ndarray, unit: dict[str, str], begin: float | None) -> None:
    log, found, _ = loaded(cells, heading, units=unit)
    np.testing.assert_allclose(log.time, STEP * np.arange(COUNT), atol=1e-6)
    assert found == (None if begin is None else pytest.approx(begin, abs=1e-5))


def test_an_uneven_clock_is_kept_and_said() -> None:
    time = np.cumsum(np.random.default_rng(4).uniform(0.5, 1.5, COUNT)) * STEP
    log, _, remarks = loaded(time, "t [s]")
    np.testing.assert_array_equal(log.time, time)
    assert any(text.startswith("uneven clock: its intervals vary by") for text in remarks)


def test_a_force_is_never_the_clock() -> None:
    ramp = np.linspace(0, 5, COUNT)
    frame = {"Fx [N]": ramp, **SIGNALS}
    with pytest.raises(BadInput, match="no column is a clock"):
        load(frame, inputs="F", outputs="x")
    with pytest.raises(BadInput, match="the time 'Fx \\[N\\]' is in 'N', which is no unit of time"):
        load(frame, inputs="F", outputs="x", time="Fx")
    data = load({**frame, "t": STEP * np.arange(COUNT)}, inputs="F", outputs="x")
    record = data.dataset.records[0]
    assert isinstance(record.data, Record)
    assert record.data.time[-1] == pytest.approx(STEP * (COUNT - 1))


@pytest.mark.parametrize("heading", ["t [Sek]", "ramp [min]"])
def test_what_may_be_a_clock_is_asked_for(heading: str) -> None:
    with pytest.raises(BadInput, match=f"is '{re.escape(heading)}' the time"):
        loaded(STEP * np.arange(COUNT), heading)


def test_two_clocks_are_asked_for() -> None:
    frame = {"t": STEP * np.arange(COUNT), "time": np.arange(COUNT), **SIGNALS}
    with pytest.raises(BadInput, match="which column is the time, 't' or 'time'\\? Name it: time=\"t\""):
        load(frame, inputs="F", outputs="x")
