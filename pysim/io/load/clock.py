"""Which column is the clock, what it says, and why."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.columns import standing
from pysim.io.counted import counted
from pysim.io.load.headings import heading_of, name_and_unit, unit_of
from pysim.io.load.moments import DATE_ORDERS, moments_of, seconds_of_day
from pysim.io.load.table import Doubt, RawTable, number_of
from pysim.io.units import unit_cure
from pysim.types import SECONDS, UNITS, BadInput, sampling

Array = NDArray[np.float64]

_TIMES = "time t elapsed timestamp date_time datetime date/time x_value zeit zeitstempel"
TIME_NAMES = frozenset(_TIMES.split())  # how a clock is headed, in small letters
_UNEVEN = 0.05  # of the interval
_FALLS = 0.05  # of the rows: a clock that was set back now and then is refused where it does, and not mistaken
_EPOCHS = {1e9: "s", 1e12: "ms", 1e15: "us", 1e18: "ns"}  # counts since 1970 begin there, and are below four times that
_UNTIL = 4.0
_NS = np.timedelta64(1, "ns")


@dataclass(frozen=True)
class LoadedClock:
    """The times of a log.

    Args:
        heading: of the column.
        time: (n_r,) s, increasing.
        begin: s since 1970 of its first row; None where the log does not say.
        remarks: why this column, and what is uneven.
        rows: (n_r,) rows of the table that were taken: all but repeated ones.
    """

    heading: str
    time: Array
    begin: float | None
    remarks: tuple[str, ...]
    rows: NDArray[np.intp]


def read_clock(table: RawTable, name: str | None, units: Mapping[str, str], signals: Collection[str]) -> LoadedClock:
    """The clock of a log.

    Args:
        name: what the user calls it; it is looked for where None.
        units: of columns, as the user says.
        signals: headings that are signals, so that none of these is the clock.
    Raises:
        BadInput: no column or several may be the clock, one that is named does not rise, or its unit is none of time.
    """
    heading, why = (heading_of(table, name), "") if name is not None else _found(table, units, signals)
    time, begin, how = _seconds(table, heading, units)
    missing = np.flatnonzero(~np.isfinite(time))
    if missing.size:
        where = table.row(int(missing[0]))
        raise BadInput(f"{table.place}, {where}: the time {heading!r} is empty; complete it or remove the row")
    rows, repeated = _without_copies(table, time)
    found = standing(time[rows])
    if found is not None:
        where = table.row(int(rows[found[0]]))
        raise BadInput(f"{table.place}, {where}: {found[1]}")
    remarks = [why, how, repeated, *_evenness(time[rows])]
    return LoadedClock(heading, time[rows], begin, tuple(one for one in remarks if one), rows)


def _found(table: RawTable, units: Mapping[str, str], signals: Collection[str]) -> tuple[str, str]:
    """The column that its values and its heading say is the clock."""
    certain, perhaps = [], []
    for heading in dict.fromkeys(table.headings):
        if heading in signals or table.headings.count(heading) > 1:
            continue
        name = name_and_unit(heading)[0]
        unit = unit_of(table, heading, name, units)[0]
        cells = table.column(heading)
        try:
            moments = moments_of(cells, f"{table.place}, {heading}") is not None or seconds_of_day(cells) is not None
        except BadInput:
            moments = True  # what is wrong with them is said once they are chosen
        if moments:
            certain.append((heading, "it holds dates or times of day"))
            continue
        named = name.strip().lower() in TIME_NAMES or heading.strip().lower() in TIME_NAMES
        if (unit in SECONDS and (named or SECONDS[unit] <= 1)) or (named and not unit):
            if _is_word_among_numbers(cells):
                table.numbers(heading)  # is refused, with its place
            how = rises(table, heading)
            if how:
                certain.append((heading, f"it is headed {heading!r}, {how}"))
        elif (unit in SECONDS or unit not in UNITS) and rises(table, heading):
            perhaps.append(heading)
    if len(certain) == 1:
        return certain[0][0], f"time: column {certain[0][0]!r}, since {certain[0][1]}"
    shown = ", ".join(dict.fromkeys(table.headings))
    if certain:
        asked = " or ".join(repr(heading) for heading, _ in certain)
        raise BadInput(f'{table.place}: which column is the time, {asked}? Name it: time="{certain[0][0]}"')
    if perhaps:
        asked = " or ".join(map(repr, perhaps))
        raise BadInput(f'{table.place}: is {asked} the time? It rises evenly; if so name it: time="{perhaps[0]}"')
    raise BadInput(f'{table.place}: no column is a clock that never falls; name it, time="...", one of {shown}')


def _is_word_among_numbers(cells: NDArray[Any]) -> bool:
    """Whether a few cells of a column of numbers hold something else."""
    if cells.dtype.kind != "O":
        return False
    wrong = sum(number_of(cell) is None for cell in cells.tolist())
    return 0 < 2 * wrong < cells.size


def rises(table: RawTable, heading: str) -> str:
    """How a column rises whose rows nearly all rise evenly, or stand for a copy of a row; empty for all others."""
    if table.column(heading).dtype.kind == "M":
        return "it holds moments"
    try:
        values = table.numbers(heading)
    except BadInput:
        return ""
    steps = np.diff(values[np.isfinite(values)])
    up = steps[steps > 0]
    if up.size < max(0.5 * (steps.size - 1), 1) or np.mean(steps < 0) > _FALLS:
        return ""
    usual = float(np.median(up))
    even = np.mean(np.abs(up - usual) <= 0.5 * usual) > 0.5
    return (
        f"{'never falls' if steps.min() >= 0 else 'hardly ever falls'} and rises by {usual:.4g} a row" if even else ""
    )


def _seconds(table: RawTable, heading: str, units: Mapping[str, str]) -> tuple[Array, float | None, str]:
    """Times in s, the moment of the first, and a remark."""
    cells, name = table.column(heading), name_and_unit(heading)[0]
    unit, remark = unit_of(table, heading, name, units)
    form = unit if ("%" in unit and len(unit) > 1) or unit in DATE_ORDERS else ""
    moments = moments_of(cells, f"{table.place}, {heading}", form)
    if moments is not None:
        first = moments.values[0]
        begin = float((first - np.datetime64(0, "ns")) / _NS) * 1e-9 if moments.dated else None
        return 1e-9 * ((moments.values - first) / _NS), begin, moments.remark or remark
    day = seconds_of_day(cells)
    if day is not None:
        return day - day[0], None, remark
    values = table.numbers(heading)
    if cells.dtype.kind == "m":
        return values, None, remark
    since = next((size for size in _EPOCHS if values.size and size <= values[0] < _UNTIL * size), None)
    if since is not None and (not unit or SECONDS.get(unit) == SECONDS[_EPOCHS[since]]):
        second = SECONDS[_EPOCHS[since]]
        counts = f"time: {heading!r} counts {_EPOCHS[since]} since 1970, since it begins with {values[0]:.0f}"
        return second * (values - values[0]), second * float(values[0]), remark or counts
    if unit and unit not in SECONDS:
        raise BadInput(
            f"{table.place}: the time {heading!r} is in {unit!r}, which is no unit of time; "
            f'{unit_cure(unit, tuple(SECONDS))}, or name another column: time="..."'
        )
    return SECONDS[unit or "s"] * values, None, remark or ("" if unit else f"time: {heading!r} is taken in s")


def _without_copies(table: RawTable, time: Array) -> tuple[NDArray[np.intp], str]:
    """All rows but those that repeat the one ahead in every cell, and a remark on these."""
    same = np.flatnonzero(np.diff(time) == 0) + 1
    copies = [k for k in same.tolist() if all(_equal(cells[k], cells[k - 1]) for cells in table.cells)]
    if not copies:
        return np.arange(time.size), ""
    rows = np.delete(np.arange(time.size), copies)
    return rows, f"{counted(len(copies), 'repeated row')} left out, the first at {table.row(copies[0])}"


def _equal(one: object, other: object) -> bool:
    return bool(one == other) or (one != one and other != other)


def _evenness(time: Array) -> list[str]:
    """What is to be said of the intervals."""
    if time.size < 3:
        return []
    found = sampling(time)
    spread = float(np.std(np.delete(np.diff(time), found.gaps))) / found.step
    return [Doubt(f"uneven clock: its intervals vary by {100 * spread:.0f} percent")] if spread > _UNEVEN else []
