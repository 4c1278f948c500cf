"""Dates and times of any form and zone, as moments of UTC."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta, timezone, tzinfo
from typing import Any
from zoneinfo import ZoneInfo

import numpy as np
from numpy.typing import NDArray

from pysim.io.load.table import Doubt, number_of
from pysim.types import BadInput

DATE_ORDERS = ("year/month/day", "day/month/year", "month/day/year")
_TIME = r"(?P<h>\d{1,2}):(?P<min>\d{2})(?::(?P<s>\d{2})(?:[.,](?P<f>\d{1,9})\d*)?)?\s*(?P<half>[AaPp]\.?[Mm]\.?)?"
_FORM = re.compile(
    r"(?P<a>\d{1,4})(?P<sep>[-./])(?P<b>\d{1,2})(?P=sep)(?P<c>\d{1,4})[T ,]+"
    rf"{_TIME}\s*(?P<zone>[A-Za-z][\w/+-]*|[+-]\d{{2}}:?\d{{2}})?"
)
_CLOCK = re.compile(_TIME)
_LOOKS = re.compile(r"\s*\d{1,4}[-./]\d{1,2}[-./]\d{1,4}\b|\s*\d{1,2}:\d{2}\b")
_PLAIN = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:\.\d{1,9})?")
_DAY = 86400.0


@dataclass(frozen=True)
class Moments:
    """Moments of a column.

    Args:
        values: (n_r,) of UTC, NaT where a cell is empty. Those without a zone count as UTC: only differences matter.
        remark: what was assumed of their dates.
        dated: whether the dates are known; times within a log are, in any case.
    """

    values: NDArray[np.datetime64]
    remark: str = ""
    dated: bool = True


def looks_like_moment(cell: object) -> bool:
    """Whether a cell holds a date, a time of day, or both."""
    return isinstance(cell, datetime | date | time) or (isinstance(cell, str) and _LOOKS.match(cell) is not None)


def moments_of(cells: NDArray[Any], where: str, form: str = "") -> Moments | None:
    """Moments of a column; None where it holds something else.

    Args:
        where: file and column, for messages.
        form: how they are written, as of `datetime.strptime` or one of DATE_ORDERS; any usual one where empty.
    Raises:
        BadInput: days and months that cannot be distinguished, or a zone that nobody knows.
    """
    if cells.dtype.kind == "M":
        return Moments(cells.astype("datetime64[ns]"))
    if cells.dtype.kind != "O":
        return None
    own = [None if _empty(cell) else cell for cell in cells.tolist()]
    there = [cell for cell in own if cell is not None]
    if not there:
        return None
    if all(isinstance(cell, datetime) for cell in there):
        return Moments(np.array([_utc(cell) for cell in own], dtype="datetime64[ns]"))
    if not all(isinstance(cell, str) for cell in there):
        return None
    if form and form not in DATE_ORDERS:
        return Moments(_by(own, lambda text: _utc(datetime.strptime(text, form)), where))
    if len(there) == len(own) and all(_PLAIN.fullmatch(text) for text in there):
        try:
            return Moments(np.array(there, dtype="datetime64[ns]"))
        except ValueError as error:
            raise BadInput(f"{where}: {error}; correct that cell") from error
    found = [_FORM.fullmatch(text.strip()) for text in there]
    if 2 * sum(match is not None for match in found) <= len(found):
        return None
    if not all(found):
        row = next(k for k, cell in enumerate(own, 1) if cell is not None and not _FORM.fullmatch(cell.strip()))
        raise BadInput(f"{where}, row {row}: {own[row - 1]!r} is no moment; correct it or remove the row")
    order, remark, dated = (form, "", True) if form else _order([match for match in found if match is not None], where)
    return Moments(_by(own, lambda text: _read(text, order, where), where), remark, dated)


def seconds_of_day(cells: NDArray[Any]) -> NDArray[np.float64] | None:
    """s (n_r,) of times without a date, going on beyond midnight; None where a column holds anything else."""
    if cells.dtype.kind != "O":
        return None
    found = [_of_day(cell) for cell in cells.tolist()]
    if any(value is None for value in found):
        return None
    values = np.array(found, dtype=np.float64)
    return values + _DAY * np.concatenate([[0.0], np.cumsum(np.diff(values) < -0.5 * _DAY)])


def _of_day(cell: object) -> float | None:
    if isinstance(cell, time):
        return cell.hour * 3600 + cell.minute * 60 + cell.second + 1e-6 * cell.microsecond
    found = _CLOCK.fullmatch(cell.strip()) if isinstance(cell, str) else None
    if found is None:
        return None
    return _hour(found) * 3600 + int(found["min"]) * 60 + float(f"{found['s'] or 0}.{found['f'] or 0}")


def _hour(match: re.Match[str]) -> int:
    """Of the day, also where it is one of its half."""
    hour, half = int(match["h"]), match["half"]
    return hour % 12 + 12 * (half[0] in "Pp") if half else hour


def _empty(cell: object) -> bool:
    value = None if isinstance(cell, datetime) and cell == cell else number_of(cell)
    return value is not None and bool(np.isnan(value))


def _utc(moment: datetime | None) -> np.datetime64:
    """Without its zone; NaT for None."""
    if moment is not None and moment.tzinfo is not None:
        moment = moment.astimezone(UTC).replace(tzinfo=None)
    return np.datetime64(moment)


def _by(cells: Sequence[str | None], read: Callable[[str], np.datetime64], where: str) -> NDArray[np.datetime64]:
    found = []
    for row, cell in enumerate(cells, 1):
        try:
            found.append(np.datetime64("NaT") if cell is None else read(cell))
        except ValueError as error:
            if isinstance(error, BadInput):
                raise
            raise BadInput(f"{where}, row {row}: {cell!r} is no moment ({error}); correct it") from error
    return np.array(found, dtype="datetime64[ns]")


def _order(found: Sequence[re.Match[str]], where: str) -> tuple[str, str, bool]:
    """Which of DATE_ORDERS a log has, what is to be said of that, and whether the log decides it.

    Within a single day it decides nothing but when the log began.
    """
    days = list(dict.fromkeys(match.group("a", "b", "c") for match in found))
    dots, text = found[0]["sep"] == ".", found[0].group()
    orders = DATE_ORDERS[1::-1] if dots else DATE_ORDERS
    misfits = [_misfit(days, order) for order in orders]
    best = [order for order, misfit in zip(orders, misfits, strict=True) if misfit == min(misfits)]
    if len(best) == 1 or dots:
        one_fits = sum(misfit[0] == min(misfits)[0] for misfit in misfits) == 1
        return best[0], "" if one_fits else Doubt(f"date: {text!r} is taken as {best[0]}"), True
    asked, cure = " or ".join(best), f'Say it in units: "{best[-1]}" as the unit of that column'
    if len(days) > 1:
        raise BadInput(f"{where}: is {text!r} {asked}? {cure}")
    remark = Doubt(f"date: is {text!r} {asked}? Until that is known, so is when the log began. {cure}")
    return best[0], remark, False


def _misfit(days: Sequence[tuple[str, ...]], order: str) -> tuple[int, bool, bool]:
    """How many dates no calendar has in that order, whether any is ahead of the one before, or not the day behind."""
    own = []
    for day in days:
        with suppress(ValueError):
            own.append(_date(day, order).toordinal())
    steps = np.diff(own)
    return len(days) - len(own), bool(np.any(steps < 0)), bool(np.any(steps != 1))


def _date(day: tuple[str, ...], order: str) -> date:
    parts = dict(zip(order.split("/"), map(int, day), strict=True))
    return date(parts["year"] + (2000 if parts["year"] < 100 else 0), parts["month"], parts["day"])


def _read(text: str, order: str, where: str) -> np.datetime64:
    match = _FORM.fullmatch(text.strip())
    assert match is not None
    nanoseconds = int((match["f"] or "").ljust(9, "0")) if match["f"] else 0
    zone = _zone(match["zone"], where) if match["zone"] else None
    clock = time(_hour(match), int(match["min"]), int(match["s"] or 0), tzinfo=zone)
    moment = datetime.combine(_date(match.group("a", "b", "c"), order), clock)
    return _utc(moment).astype("datetime64[ns]") + np.timedelta64(nanoseconds, "ns")


def _zone(name: str, where: str) -> tzinfo:
    if name.upper() in ("Z", "UTC", "GMT"):
        return UTC
    if name[0] in "+-":
        hours, minutes = int(name[1:3]), int(name[-2:])
        size = timedelta(hours=hours, minutes=minutes)
        return timezone(size if name[0] == "+" else -size)
    try:
        return ZoneInfo(name)
    except (KeyError, OSError, ValueError) as error:
        raise BadInput(f"{where}: nobody knows the zone {name!r}; write +01:00 or Z in its place") from error
