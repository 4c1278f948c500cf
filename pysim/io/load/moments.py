"""Dates and times of any form and zone, as moments of UTC."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from datetime import UTC, date, datetime, time, timedelta, timezone, tzinfo
from typing import Any
from zoneinfo import ZoneInfo

import numpy as np
from numpy.typing import NDArray

from pysim.io.load.table import number_of
from pysim.types import BadInput

Moments = NDArray[np.datetime64]

_FORM = re.compile(
    r"(?P<a>\d{1,4})(?P<sep>[-./])(?P<b>\d{1,2})(?P=sep)(?P<c>\d{1,4})[T ,]+"
    r"(?P<h>\d{1,2}):(?P<min>\d{2})(?::(?P<s>\d{2})(?:[.,](?P<f>\d{1,9})\d*)?)?\s*(?P<half>[AaPp][Mm])?"
    r"\s*(?P<zone>[A-Za-z][\w/+-]*|[+-]\d{2}:?\d{2})?"
)
_CLOCK = re.compile(r"(\d{1,2}):(\d{2})(?::(\d{2}(?:[.,]\d+)?))?")
_LOOKS = re.compile(r"\s*\d{1,4}[-./]\d{1,2}[-./]\d{1,4}\b|\s*\d{1,2}:\d{2}\b")
_PLAIN = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:\.\d{1,9})?")
_DAY = 86400.0


def looks_like_moment(cell: object) -> bool:
    """Whether a cell holds a date, a time of day, or both."""
    return isinstance(cell, datetime | date | time) or (isinstance(cell, str) and _LOOKS.match(cell) is not None)


def moments_of(cells: NDArray[Any], where: str, form: str = "") -> Moments | None:
    """Moments (n_r,) of UTC, NaT where a cell is empty; None where the column holds something else.

    Moments without a zone count as UTC: only differences matter.

    Args:
        where: file and column, for messages.
        form: how they are written, as of `datetime.strptime`; any usual one where empty.
    Raises:
        BadInput: days and months that cannot be distinguished, or a zone that nobody knows.
    """
    if cells.dtype.kind == "M":
        return cells.astype("datetime64[ns]")
    if cells.dtype.kind != "O":
        return None
    own = [None if _empty(cell) else cell for cell in cells.tolist()]
    there = [cell for cell in own if cell is not None]
    if not there:
        return None
    if all(isinstance(cell, datetime) for cell in there):
        return np.array([_utc(cell) for cell in own], dtype="datetime64[ns]")
    if not all(isinstance(cell, str) for cell in there):
        return None
    if form:
        return _by(own, lambda text: _utc(datetime.strptime(text, form)), where)
    if len(there) == len(own) and all(_PLAIN.fullmatch(text) for text in there):
        try:
            return np.array(there, dtype="datetime64[ns]")
        except ValueError as error:
            raise BadInput(f"{where}: {error}; correct that cell") from error
    found = [_FORM.fullmatch(text.strip()) for text in there]
    if 2 * sum(match is not None for match in found) <= len(found):
        return None
    if not all(found):
        row = next(k for k, cell in enumerate(own, 1) if cell is not None and not _FORM.fullmatch(cell.strip()))
        raise BadInput(f"{where}, row {row}: {own[row - 1]!r} is no moment; correct it or remove the row")
    order = _order([match for match in found if match is not None], where)
    return _by(own, lambda text: _read(text, order, where), where)


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
    return int(found[1]) * 3600 + int(found[2]) * 60 + float((found[3] or "0").replace(",", "."))


def _empty(cell: object) -> bool:
    value = None if isinstance(cell, datetime) and cell == cell else number_of(cell)
    return value is not None and bool(np.isnan(value))


def _utc(moment: datetime | None) -> np.datetime64:
    """Without its zone."""
    if moment is None:
        return np.datetime64("NaT")
    if moment.tzinfo is not None:
        moment = moment.astimezone(UTC).replace(tzinfo=None)
    return np.datetime64(moment)


def _by(cells: Sequence[str | None], read: Callable[[str], np.datetime64], where: str) -> Moments:
    found = []
    for row, cell in enumerate(cells, 1):
        try:
            found.append(np.datetime64("NaT") if cell is None else read(cell))
        except ValueError as error:
            if isinstance(error, BadInput):
                raise
            raise BadInput(f"{where}, row {row}: {cell!r} is no moment ({error}); correct it") from error
    return np.array(found, dtype="datetime64[ns]")


def _order(found: Sequence[re.Match[str]], where: str) -> str:
    """Which of year, month and day stands where: "ymd", "dmy" or "mdy"."""
    if all(len(match["a"]) == 4 for match in found):
        return "ymd"
    if found[0]["sep"] == ".":
        return "dmy"
    if any(int(match["a"]) > 12 for match in found):
        return "dmy"
    if any(int(match["b"]) > 12 for match in found):
        return "mdy"
    text = found[0].group()
    raise BadInput(
        f"{where}: is {text!r} day/month or month/day? "
        'Say it in units: "%d/%m/%Y %H:%M:%S" or "%m/%d/%Y %H:%M:%S" as the unit of that column'
    )


def _read(text: str, order: str, where: str) -> np.datetime64:
    match = _FORM.fullmatch(text.strip())
    assert match is not None
    parts = dict(zip(order, (int(match[key]) for key in "abc"), strict=True))
    year = parts["y"] + (2000 if parts["y"] < 100 else 0)
    hour = int(match["h"])
    if match["half"]:
        hour = hour % 12 + (12 if match["half"].lower() == "pm" else 0)
    nanoseconds = int((match["f"] or "").ljust(9, "0")) if match["f"] else 0
    moment = datetime(year, parts["m"], parts["d"], hour, int(match["min"]), int(match["s"] or 0))
    if match["zone"]:
        moment = moment.replace(tzinfo=_zone(match["zone"], where))
    return _utc(moment).astype("datetime64[ns]") + np.timedelta64(nanoseconds, "ns")


def _zone(name: str, where: str) -> tzinfo:
    if name in ("Z", "z"):
        return UTC
    if name[0] in "+-":
        hours, minutes = int(name[1:3]), int(name[-2:])
        size = timedelta(hours=hours, minutes=minutes)
        return timezone(size if name[0] == "+" else -size)
    try:
        return ZoneInfo(name)
    except (KeyError, OSError, ValueError) as error:
        raise BadInput(f"{where}: nobody knows the zone {name!r}; write +01:00 or Z in its place") from error
