"""A data set from logs as they come."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

import numpy as np

from pysim.io.counted import counted
from pysim.io.load.clock import read_clock
from pysim.io.load.foreign_units import known_unit, scale_of
from pysim.io.load.headings import heading_of, name_and_unit, unit_of
from pysim.io.load.sources import tables_of
from pysim.io.load.table import RawTable
from pysim.io.units import Scale
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import HOLDS, OTHER

Names = str | Sequence[str] | Mapping[str, str]


@dataclass(frozen=True)
class Loaded:
    """What was read.

    Args:
        dataset: in SI units or %; an empty cell is not-a-number.
        units: signal -> unit in which it was logged, as far as our table has that.
        remarks: log -> what was guessed, and why, and what was left out.
    """

    dataset: Dataset
    units: Mapping[str, str]
    remarks: Mapping[str, tuple[str, ...]]


def load_logs(
    source: Any,
    *,
    inputs: Names | None,
    outputs: Names | None,
    time: str | None = None,
    units: Mapping[str, str] | None = None,
    noise: Mapping[str, float] | None = None,
    variables: Mapping[str, str] | None = None,
    hold: Mapping[str, str] | None = None,
) -> Loaded:
    """Read logs and say what their columns are.

    Args:
        source: a path, a pattern, a folder, a table in memory, a list of any, or a dict of these by name.
        inputs, outputs: names of the signals as the headings have them, ahead of their units; a dict gives other names
            to them: signal -> heading.
        time: heading of the clock; without it, that is looked for.
        units: signal (or heading) -> unit, where no heading tells one; of a clock of dates also how they are written,
            "day/month/year" or as of `datetime.strptime`.
        noise: signal -> standard deviation of its noise, in its unit.
        variables: signal -> variable of the model, where that is called otherwise.
        hold: input -> how it runs between samples, "zero", "linear" or "spline".
    Raises:
        BadInput: what cannot be read, is not there, or must be asked for, with its place and the cure.
    """
    units, noise, variables, hold = units or {}, noise or {}, variables or {}, hold or {}
    logs = tables_of(source)
    given, answers = (_named(own, what, logs[0]) for own, what in ((inputs, "inputs"), (outputs, "outputs")))
    wanted = given | answers
    roles = dict.fromkeys(given, "input") | dict.fromkeys(answers, "output")
    if twice := [name for name in given if name in answers]:
        raise BadInput(f"{', '.join(twice)}: input or output? Name it once")
    for what, own in {"noise": noise, "variables": variables, "hold": hold}.items():
        _refuse_strangers(what, own, wanted)
    tables = _holding(logs, wanted)
    headings = [heading for table in tables for heading in table.headings]
    _refuse_strangers("units", units, [*wanted, *headings, *(name_and_unit(heading)[0] for heading in headings)])
    seen: dict[str, Scale] = {}
    called: dict[str, str] = {}
    records, remarks = [], {}
    for table in tables:
        record, remarks[table.name], scales, own = _record(table, wanted, time, units)
        records.append(record)
        for name, scale in scales.items():
            called.setdefault(name, own[name])
            if seen.setdefault(name, scale).unit != scale.unit:
                raise BadInput(
                    f"{table.place}: {name} is in {own[name]}, and in {called[name]} in another log; "
                    "these are different quantities, so give one of them another name"
                )
    signals = tuple(
        MeasuredSignal(
            name, role, seen[name].unit, name, variables.get(name, name),
            noise=_noise(noise, name, seen[name]), hold=_hold(hold, name, role),
        )
        for name, role in roles.items()
    )  # fmt: skip
    shown = {name: unit if known_unit(unit) else seen[name].unit for name, unit in called.items()}
    title = tables[0].name.rpartition(".")[0] if len(tables) == 1 else "logs"
    return Loaded(Dataset(title, "", "", signals, tuple(records)), shown, remarks)


def _named(names: Names | None, what: str, table: RawTable) -> dict[str, str]:
    """Signal -> what the user calls its column."""
    if not names:
        there = ", ".join(table.headings)
        raise BadInput(f"{table.place}: which columns are {what}? Name at least one of {there}", argument=what)
    if isinstance(names, Mapping):
        return dict(names)
    found: dict[str, str] = {}
    for name in [names] if isinstance(names, str) else names:
        short = name_and_unit(name)[0]
        if short in found:
            cure = f'name it once, or give another name to one of them: {what}={{"another": "{name}"}}'
            raise BadInput(f"{what} name {short} twice, as {found[short]!r} and {name!r}; {cure}")
        found[short] = name
    return found


def _refuse_strangers(what: str, given: Collection[str], known: Collection[str]) -> None:
    """A misspelt name would be a silent default."""
    for name in given:
        if name not in known:
            near = get_close_matches(name, known) or dict.fromkeys(known)
            raise BadInput(f"{what} names {name!r}, which is not there; use {' or '.join(map(repr, near))}")


def _holding(tables: Sequence[RawTable], wanted: Mapping[str, str]) -> list[RawTable]:
    """The tables that have all signals; where none has, the first says what it lacks."""
    found, missing = [], []
    for table in tables:
        try:
            for name in wanted.values():
                heading_of(table, name)
            found.append(table)
        except BadInput as error:
            missing.append((table, error))
    files = {table.place.partition(", ")[0] for table in found}
    for table, lacks in missing:  # another sheet of a file that has one may hold anything
        if table.place.partition(", ")[0] not in files:
            raise lacks
    return found


def _record(
    table: RawTable, wanted: Mapping[str, str], time: str | None, units: Mapping[str, str]
) -> tuple[MeasuredRecord, tuple[str, ...], dict[str, Scale], dict[str, str]]:
    """One log, remarks on it, and per signal its scale and unit."""
    headings = {name: heading_of(table, own) for name, own in wanted.items()}
    found = {name: unit_of(table, heading, name, units) for name, heading in headings.items()}
    own = {name: unit for name, (unit, _) in found.items()}
    remarks = [*table.remarks, *(remark for _, remark in found.values() if remark)]
    if without := [name for name, unit in own.items() if not unit]:
        shown = ", ".join(f'"{name}": "..."' for name in without)
        raise BadInput(
            f'{table.place}: in which unit is {" and ".join(without)}? Say it: units={{{shown}}}, "1" for none'
        )
    scales = {name: scale_of(unit, f"{table.place}, {name}") for name, unit in own.items()}
    clock = read_clock(table, time, units, tuple(headings.values()))
    columns = {name: table.numbers(heading)[clock.rows] for name, heading in headings.items()}
    values = np.column_stack([scales[name].gain * column + scales[name].zero for name, column in columns.items()])
    if values.shape[0] < 2:
        raise BadInput(f"{table.place} holds a single row; a log needs two or more")
    for name, column in zip(headings, values.T, strict=True):
        empty = int(np.count_nonzero(np.isnan(column)))
        if empty == column.size:
            raise BadInput(f"{table.place}: {name} is empty from the first row to the last; name another column")
        remarks += [f"{name}: {counted(empty, 'empty cell')}"] if empty else []
    units_in_si = tuple(scale.unit for scale in scales.values())
    data = Record(clock.time, values, tuple(headings), units_in_si, origin=f"measured, {table.place}")
    record = MeasuredRecord(table.name, OTHER.name, "fit", data, begin=clock.begin)
    return record, (*clock.remarks, *remarks), scales, own


def _noise(noise: Mapping[str, float], name: str, scale: Scale) -> float | None:
    value = noise.get(name)
    if value is not None and not value >= 0:
        raise BadInput(f"the noise of {name} is {value}; give a standard deviation of 0 or more")
    return None if value is None else abs(scale.gain) * value


def _hold(hold: Mapping[str, str], name: str, role: str) -> Any:
    if name not in hold:
        return None
    if role != "input":
        raise BadInput(f"hold is for inputs, and {name} is an output; remove it")
    if hold[name] not in HOLDS:
        raise BadInput(f"hold of {name} is {hold[name]!r}; use one of {', '.join(HOLDS)}")
    return HOLDS[hold[name]]
