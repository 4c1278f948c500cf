"""Where a model's error is: stepped sines over offset, amplitude and frequency, other logs over their time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pysim.types import Dataset


@dataclass(frozen=True)
class ErrorMap:
    """A table of errors over noise.

    Args:
        title: of the columns.
        rows, columns: names.
        values: per row and column, None where no such test was run.
        sources: of the records, "" where there is none.
    """

    title: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    values: tuple[tuple[float | None, ...], ...]
    sources: tuple[tuple[str, ...], ...]


def error_maps(stage: Mapping[str, Any], dataset: Dataset) -> list[ErrorMap]:
    """The maps of a stage that have something to show: stepped sines, then other logs by signal.

    Args:
        stage: as a file of stages has it.
    """
    tests = {record.source: record for record in dataset.records}
    sines: dict[tuple[float, float, str], dict[str, tuple[float, str]]] = {}
    logs: dict[str, dict[str, tuple[float, str]]] = {}
    for record in stage["records"]:
        for signal, value in zip(record["names"], record["rms"], strict=True):
            if value is None:
                continue
            test = tests.get(record["source"])
            if record["frequency"] is not None and test is not None and test.offset is not None:
                row = (test.offset, float(test.amplitude or 0.0), signal)
                sines.setdefault(row, {})[f"{record['frequency']:g}"] = (value, record["source"])
            else:
                use = "held out" if record["use"] == "validate" else "fitted"
                logs.setdefault(f"{record['source']} ({use})", {})[signal] = (value, record["source"])
    several = len({signal for *_, signal in sines}) > 1
    named = {f"{o:g} ± {a:g}{f', {s}' if several else ''}": sines[o, a, s] for o, a, s in sorted(sines)}
    frequencies = sorted({column for row in named.values() for column in row}, key=float)
    signals = list(dict.fromkeys(column for row in logs.values() for column in row))
    maps = [_map("Frequency (Hz)", named, frequencies), _map("", logs, signals)]
    return [one for one in maps if one.rows]


def _map(title: str, rows: Mapping[str, Mapping[str, tuple[float, str]]], columns: list[str]) -> ErrorMap:
    values = tuple(tuple(row[c][0] if c in row else None for c in columns) for row in rows.values())
    sources = tuple(tuple(row[c][1] if c in row else "" for c in columns) for row in rows.values())
    return ErrorMap(title, tuple(rows), tuple(columns), values, sources)
