"""A first dataset.toml for plain logs: what headings, file names and the user say, and what is open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pysim.io.columns import names_its_columns
from pysim.io.headings import column_names, described_columns
from pysim.io.load.clock import TIME_NAMES, rises
from pysim.io.load.headings import name_and_unit
from pysim.io.load.moments import looks_like_moment
from pysim.io.thesis_folder import LOG_SUFFIXES, read_thesis_folder
from pysim.types import SECONDS, SYNONYMS, UNITS, BadInput, MeasuredRecord, MeasuredSignal

LEFT_OUT = "-"  # in place of the name of a column that nobody needs, or that holds no numbers
OPEN = "?"  # in place of a unit that nobody gave; refused until it is filled in
_TABLE = "frequency_hz"  # first column of a table of responses, which is no log
_NEEDED = "one input and one response are needed at least; name them, --input NAME:UNIT --response NAME:UNIT"


@dataclass(frozen=True)
class Column:
    """One of a log.

    Args:
        heading: as the log has it.
        name: without its unit.
        unit: as the heading tells it, known or not; "" where it tells none.
    """

    heading: str
    name: str
    unit: str


@dataclass(frozen=True)
class Draft:
    """What is known so far.

    Args:
        folder: of the logs.
        roles, units: of the signals, by name, in their order.
        columns: log, relative to the folder -> its columns as dataset.toml names them.
        called: log -> what it calls its time, where that is another name and counts.
        sines: log -> what it is as a stepped sine.
        clocks: units of time -> the first log that is in it.
        remarks: what the user should know.
    """

    folder: Path
    roles: dict[str, str] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    columns: dict[str, list[str]] = field(default_factory=dict)
    called: dict[str, str] = field(default_factory=dict)
    sines: dict[str, MeasuredRecord] = field(default_factory=dict)
    clocks: dict[str, str] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)

    @property
    def time_unit(self) -> str:
        """Of all logs; s where no heading tells one."""
        return next(iter(self.clocks), "s")

    @property
    def without_unit(self) -> list[str]:
        """Signals whose unit has to be filled in before the data set can be read."""
        return [name for name, unit in self.units.items() if unit == OPEN]


def draft_dataset(folder: Path, inputs: Mapping[str, str], responses: Mapping[str, str]) -> Draft:
    """Look at the logs of a folder, and at all below it.

    Args:
        inputs, responses: signal -> unit, as the user names them; where that is none, the first column that is not
            the time is taken for the command and all others for what answers.
    Raises:
        BadInput: no logs, one that cannot be read, columns that are not those that were named, or times in several
            units.
    """
    if bool(inputs) != bool(responses):
        raise BadInput(f"{folder}: {_NEEDED}")
    found = Draft(folder)
    for name, unit in {**inputs, **responses}.items():
        found.roles[name], found.units[name] = "input" if name in inputs else "output", unit
    logs = sorted(path for path in folder.rglob("*") if path.suffix.lower() in LOG_SUFFIXES and path.is_file())
    for path in logs:
        columns = [Column(heading, *name_and_unit(heading)) for heading in column_names(path)]
        if columns[0].heading == _TABLE:
            found.remarks.append(f"left out: {_source(found, path)} is a table; see docs/reference/data_set.md")
        else:
            _take(found, path, columns, named=bool(inputs or responses))
    if not found.columns:
        raise BadInput(f"{folder} holds no logs; they end in {', '.join(LOG_SUFFIXES)}")
    if not {"input", "output"} <= set(found.roles.values()):
        raise BadInput(f"{folder}: {_NEEDED}")
    _find_sines(found)
    return found


def _take_clock(found: Draft, path: Path, clock: Column) -> None:
    """The unit of a log's times; s where its heading tells none."""
    source, unit = _source(found, path), SYNONYMS.get(clock.unit, clock.unit) or "s"
    if unit not in SECONDS:
        found.remarks.append(f"time: taken for s, though {source} heads it {clock.heading!r}; say time_unit")
        return
    found.clocks.setdefault(unit, source if clock.unit else f"{source}, whose heading tells no unit")
    if len(found.clocks) > 1:
        units = ", ".join(f"{one} in {where}" for one, where in found.clocks.items())
        cure = "correct a heading, or give each unit a folder of its own"
        raise BadInput(f"{found.folder}: times are in {units}; {cure}")


def _take(found: Draft, path: Path, columns: Sequence[Column], *, named: bool) -> None:
    """One log: its columns, and the signals that nobody named before."""
    by_name = names_its_columns(path)
    names = _names(found, path, columns, by_name) if named else _guessed(found, path, columns, by_name)
    for name, column in zip(names, columns, strict=True):
        if name == "time":
            _take_clock(found, path, column)
            if by_name and column.heading != name:
                found.called[_source(found, path)] = column.heading
    found.columns[_source(found, path)] = [name for name in names if name != LEFT_OUT] if by_name else names


def _names(found: Draft, path: Path, columns: Sequence[Column], by_name: bool) -> list[str]:
    """Of a log whose signals were named: found in its heading, else counted beside the time."""
    own = [column.heading if by_name else column.name for column in columns]
    time, kept = _time(found, path, columns, own), sum(name != LEFT_OUT for name in own)
    if all(name in own for name in found.roles):
        return ["time" if k == time else name if name in found.roles else LEFT_OUT for k, name in enumerate(own)]
    if kept != 1 + len(found.roles) or by_name:
        raise BadInput(
            f"{path}: its columns are {', '.join(own)}; name signals as they are called there, or as many as there are "
            "columns beside the time"
        )
    names = iter(found.roles)
    return [name if name == LEFT_OUT else "time" if k == time else next(names) for k, name in enumerate(own)]


def _guessed(found: Draft, path: Path, columns: Sequence[Column], by_name: bool) -> list[str]:
    """Of a log of which nothing was said: time, then the command, then what answers."""
    short = [column.name for column in columns]
    kept = [name for name in short if name != LEFT_OUT]
    own = [column.heading for column in columns] if by_name or len(set(kept)) < len(kept) else short
    time = _time(found, path, columns, own)
    names = ["time" if k == time else name for k, name in enumerate(own)]
    for name, column in zip(names, columns, strict=True):
        if name not in ("time", LEFT_OUT, *found.roles):
            found.roles[name] = "output" if found.roles else "input"
            found.units[name] = column.unit if column.unit in UNITS else OPEN
    return names


def _time(found: Draft, path: Path, columns: Sequence[Column], names: Sequence[str]) -> int:
    """Which column is the clock: of those that are no signals the one whose values rise as a clock does.

    Raises:
        BadInput: none does, or several that no heading tells apart.
    """
    number, remark = clock_column(path, [c.heading for c in columns], [n in (LEFT_OUT, *found.roles) for n in names])
    if remark:
        found.remarks.append(f"{_source(found, path)}: {remark}")
    return number


def clock_column(path: Path, headings: Sequence[str], taken: Sequence[bool]) -> tuple[int, str]:
    """The column of a log that is its clock, by its values, and why where no heading says so.

    Args:
        headings: of all columns, LEFT_OUT for those without numbers.
        taken: columns that are something else.
    Raises:
        BadInput: none rises as a clock does, or several do that no heading tells apart.
    """
    table, _ = described_columns(path)
    by_name = names_its_columns(path)
    own = list(headings) if by_name else list(table.headings)
    rising, named = [], []
    for k, heading in enumerate(own[: len(headings)]):
        if taken[k] or heading not in table.headings or not rises(table, heading):
            continue
        name, unit = name_and_unit(heading)
        rising.append(k)
        if unit in SECONDS or name.strip().lower() in TIME_NAMES:
            named.append(k)
    if len(named) == 1:
        return named[0], ""
    if len(rising) == 1:
        return rising[0], f"time is column {rising[0] + 1}, {own[rising[0]]!r}: it alone {rises(table, own[rising[0]])}"
    if not rising and any(map(looks_like_moment, (cells[0] for cells in table.cells if cells.size))):
        cure = "pysim.load reads dates in Python, and .save(folder) writes a data set"
        raise BadInput(f"{path}: its times are dates, and a dataset.toml needs a number of seconds; {cure}")
    if not rising:
        raise BadInput(f"{path}: no column is a clock that never falls; log the time too, among {', '.join(own)}")
    asked = " or ".join(repr(own[k]) for k in named or rising)
    raise BadInput(f"{path}: which column is the time, {asked}? Head it time, or name the others as signals")


def _find_sines(found: Draft) -> None:
    """Offset, amplitude and frequency of stepped sines, from names of logs and folders, or read off the command."""
    sines = [source for source in found.columns if "hz" in Path(source).stem.lower()]
    order = ["time", *found.roles]
    if not sines:
        return
    if found.time_unit != "s" or any(found.columns[s] != order or s in found.called for s in sines):
        found.remarks.append("stepped sines: write kind, offset, amplitude and frequency into each of their records")
        return
    signals = [MeasuredSignal(name, role, "1", name, name) for name, role in found.roles.items()]  # in the files' units
    try:
        records = read_thesis_folder(found.folder, signals).records
    except BadInput as error:
        found.remarks.append(f"no stepped sines, though a frequency is in a name: {error}")
        return
    found.sines.update({record.source: record for record in records})


def _source(found: Draft, path: Path) -> str:
    return path.relative_to(found.folder).as_posix()
