"""Dates, times and clocks of any form, as seconds."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Any

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


def test_days_and_months_are_told_apart_by_their_values_or_asked_for() -> None:
    late = np.array([f"{m:%m/%d/%Y %I:%M:%S.%f %p}".replace("03/01", "03/14") for m in MOMENTS], dtype=object)
    assert loaded(late)[1] == pytest.approx(datetime(2026, 3, 14, 13, 5, tzinfo=UTC).timestamp())
    unsure = texts("%d/%m/%Y %H:%M:%S")
    with pytest.raises(BadInput, match="is '01/03/2026 13:05:00' day/month or month/day"):
        loaded(unsure)
    first = np.array([f"{m:%d/%m/%Y %H:%M:%S.%f}" for m in MOMENTS], dtype=object)
    _, begin, _ = loaded(first, units={"stamp": "%d/%m/%Y %H:%M:%S.%f"})
    assert begin == pytest.approx(BEGIN.timestamp())


def test_times_of_day_go_on_beyond_midnight() -> None:
    start = datetime(2026, 3, 1, 23, 59, 59, tzinfo=UTC)
    cells = [f"{start + timedelta(seconds=STEP * k * 5):%H:%M:%S.%f}" for k in range(COUNT)]
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


def test_two_clocks_are_asked_for() -> None:
    frame = {"t": STEP * np.arange(COUNT), "time": np.arange(COUNT), **SIGNALS}
    with pytest.raises(BadInput, match="which column is the time, 't' or 'time'\\? Name it: time=\"t\""):
        load(frame, inputs="F", outputs="x")
