"""Where a model's error is: stepped sines over offset, amplitude and frequency, other logs over their time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any, NamedTuple, TypeVar

from pysim.io import shown_unit, shown_value
from pysim.present.notes import USES
from pysim.types import Dataset

_Row = dict[str, tuple[float, int]]  # column -> error and number of the log
_Key = TypeVar("_Key")


class _Point(NamedTuple):
    """What the cells of a row have in common, in the order of the rows."""

    command: str
    offset: float
    amplitude: float
    signal: str


@dataclass(frozen=True)
class ErrorMap:
    """A table of errors over noise.

    Args:
        title: of the columns.
        rows, columns: names.
        values: per row and column, None where no such test was run.
        logs: their numbers in the data set, None where there is none.
    """

    title: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    values: tuple[tuple[float | None, ...], ...]
    logs: tuple[tuple[int | None, ...], ...]


def error_maps(stage: Mapping[str, Any], dataset: Dataset) -> list[ErrorMap]:
    """The maps of a stage that have something to show: stepped sines, then other logs by signal.

    A test that was repeated has a row of its own.
    """
    tests = dataset.logs()
    sines: dict[tuple[_Point, int], _Row] = {}
    logs: dict[tuple[str, int], _Row] = {}
    for record in stage["records"]:
        number = record["index"]
        test = tests[number]
        for signal, value in zip(record["names"], record["rms"], strict=True):
            if value is None:
                continue
            cell = (value, number)
            if record["frequency"] is not None and test.offset is not None:
                point = _Point(test.command, test.offset, float(test.amplitude or 0.0), signal)
                _put(sines, point, f"{record['frequency']:g}", cell)
            else:
                _put(logs, f"{record['source']} ({USES[record['use']]})", signal, cell)
    words = _words([point for point, _ in sines], dataset)
    named = {_repeated(words[point], repeat): sines[point, repeat] for point, repeat in sorted(sines)}
    others = {_repeated(name, repeat): row for (name, repeat), row in logs.items()}
    frequencies = sorted({column for row in named.values() for column in row}, key=float)
    signals = list(dict.fromkeys(column for row in others.values() for column in row))
    maps = [_map("Frequency (Hz)", named, frequencies), _map("", others, signals)]
    return [one for one in maps if one.rows]


def _put(table: dict[tuple[_Key, int], _Row], row: _Key, column: str, cell: tuple[float, int]) -> None:
    """In the first row of that key where the column is free: no repeat hides another."""
    repeat = next(k for k in count(1) if column not in table.get((row, k), {}))
    table.setdefault((row, repeat), {})[column] = cell


def _repeated(name: str, repeat: int) -> str:
    return name if repeat == 1 else f"{name}, repeat {repeat}"


def _words(points: Sequence[_Point], dataset: Dataset) -> dict[_Point, str]:
    """What the rows are called; inputs and signals are named where there are several."""
    inputs, signals = len({p.command for p in points}) > 1, len({p.signal for p in points}) > 1
    return {
        p: (f"{p.command}: " if inputs else "")
        + working_point(p.offset, p.amplitude, command_unit(dataset, p.command))
        + (f", {p.signal}" if signals else "")
        for p in points
    }


def _map(title: str, rows: Mapping[str, _Row], columns: list[str]) -> ErrorMap:
    values = tuple(tuple(row[c][0] if c in row else None for c in columns) for row in rows.values())
    logs = tuple(tuple(row[c][1] if c in row else None for c in columns) for row in rows.values())
    return ErrorMap(title, tuple(rows), tuple(columns), values, logs)


def working_point(offset: float, amplitude: float, unit: str) -> str:
    """As in "100 ± 20 bar".

    Args:
        offset, amplitude: in an SI unit, "1" or "%".
        unit: that one; "" where nobody stated it.
    """
    return f"{shown_unit(unit)[1] * offset:g} ± {shown_value(amplitude, unit)}"


def command_unit(dataset: Dataset, command: str) -> str:
    """Unit of the input that offset and amplitude of a test speak of; "" where none is stated."""
    return next((signal.unit for signal in dataset.signals if signal.name == command), "")


def response_unit(dataset: Dataset, response: Mapping[str, Any]) -> str:
    """Unit of the command of a frequency response in a file of stages, which names the input for tables alone."""
    point = (response["offset"], response["amplitude"])
    same = (record.command for record in dataset.records if (record.offset, record.amplitude) == point)
    return command_unit(dataset, response["input"]) or command_unit(dataset, next(same, ""))
