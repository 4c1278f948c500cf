"""Read a measured data set: a folder with `dataset.toml` and the files it names. Nothing of it is ever written to."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pysim.io.response_table import TABLE_COLUMNS, read_response
from pysim.io.text_table import read_text
from pysim.io.units import SI
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, SineTest

TABLE = "frequency-response-table"
LOGS = ("frequency-response", "chirp", "stochastic", "step", "other")
_KEYS = ("dataset", "signals", "records")
_DATASET_KEYS = ("name", "description", "system")
_SIGNAL_KEYS = ("role", "unit", "quantity", "variable", "noise", "resolution")
_RECORD_KEYS = ("file", "columns", "kind", "use", "offset", "amplitude", "frequency", "input", "output", "origin")


@dataclass(frozen=True)
class _Section:
    """One table of dataset.toml with the place it stands at, for messages."""

    place: str
    values: dict[str, Any]

    def text(self, key: str, default: str | None = None, *, among: tuple[str, ...] = ()) -> str:
        """A string, one of `among` where that is not empty."""
        value = self.values.get(key, default)
        if not isinstance(value, str) or not value:
            raise BadInput(f'{self.place}: {key} is missing or no text; write {key} = "..."')
        if among and value not in among:
            raise BadInput(f"{self.place}: {key} = {value!r} is not known; use one of {', '.join(among)}")
        return value

    def number(self, key: str) -> float:
        """A finite number that must be there."""
        value = self.optional_number(key)
        if value is None:
            raise BadInput(f"{self.place}: {key} is missing; write {key} = and a number")
        return value

    def optional_number(self, key: str) -> float | None:
        """A finite number, or None where the key is absent."""
        value = self.values.get(key)
        if value is None:
            return None
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise BadInput(f"{self.place}: {key} = {value!r} is no finite number; write {key} = and a number")
        return float(value)

    def refuse_unknown(self, keys: tuple[str, ...]) -> None:
        """A misspelt key would be a silent default."""
        for key in self.values:
            if key not in keys:
                raise BadInput(f"{self.place}: the key {key!r} is not known; use {', '.join(keys)}")


def read_dataset(folder: Path | str) -> Dataset:
    """Read a data set. Tables of frequency responses are read; logs over time are skipped and named.

    Args:
        folder: holds dataset.toml; the files it names are relative to it.
    Returns:
        everything in SI units or %, gains from decibels, phases in rad and continuous.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    path = Path(folder) / "dataset.toml"
    text = read_text(path, "data set")
    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise BadInput(f"{path}: {error}; correct the TOML") from error
    head = _Section(f"{path}, [dataset]", _table(content, "dataset", path))
    _Section(str(path), content).refuse_unknown(_KEYS)
    head.refuse_unknown(_DATASET_KEYS)
    written = {
        name: _signal(name, _Section(_place(path, text, f"[signals.{name}]"), values))
        for name, values in _table(content, "signals", path).items()
    }
    rows = content.get("records")
    if not isinstance(rows, list) or not rows:
        raise BadInput(f"{path}: there are no records; add one [[records]] section per log or table")
    sections = [_Section(_place(path, text, "[[records]]", i), values) for i, values in enumerate(rows)]
    kinds = [_kind(section) for section in sections]
    pairs = list(zip(sections, kinds, strict=True))
    return Dataset(
        name=head.text("name"),
        description=head.text("description", "-"),
        system=head.text("system", "-"),
        signals=tuple(_in_si(signal) for signal in written.values()),
        records=tuple(_record(path.parent, section, written) for section, kind in pairs if kind == TABLE),
        skipped=tuple(f"{section.text('file')} ({kind})" for section, kind in pairs if kind != TABLE),
    )


def _table(content: dict[str, Any], key: str, path: Path) -> dict[str, Any]:
    table = content.get(key)
    if not isinstance(table, dict) or not table:
        raise BadInput(f"{path}: the section [{key}] is missing; add it")
    return table


def _place(path: Path, text: str, header: str, nth: int = 0) -> str:
    """The file and the line of the nth header of that name; the TOML parser does not tell."""
    lines = [i for i, line in enumerate(text.splitlines(), 1) if line.replace('"', "").strip().startswith(header)]
    return f"{path}, line {lines[nth]}" if nth < len(lines) else f"{path}, {header}"


def _signal(name: str, section: _Section) -> MeasuredSignal:
    if not isinstance(section.values, dict):
        raise BadInput(f"{section.place}: signals.{name} is no section; write [signals.{name}] with role and unit")
    section.refuse_unknown(_SIGNAL_KEYS)
    return MeasuredSignal(
        name=name,
        role=section.text("role", among=("input", "output")),
        unit=section.text("unit", among=tuple(SI)),
        quantity=section.text("quantity", name),
        variable=section.text("variable", name),
        noise=section.optional_number("noise"),
        resolution=section.optional_number("resolution"),
    )


def _in_si(signal: MeasuredSignal) -> MeasuredSignal:
    unit, factor = SI[signal.unit]
    noise, resolution = (None if v is None else factor * v for v in (signal.noise, signal.resolution))
    return replace(signal, unit=unit, noise=noise, resolution=resolution)


def _kind(section: _Section) -> str:
    """What a record holds, once its keys are known to be."""
    if not isinstance(section.values, dict):
        raise BadInput(f"{section.place}: a record is a section; write [[records]] with file, columns and kind")
    section.refuse_unknown(_RECORD_KEYS)
    return section.text("kind", among=(TABLE, *LOGS))


def _record(folder: Path, section: _Section, signals: dict[str, MeasuredSignal]) -> MeasuredRecord:
    """A table; the command's numbers are in the unit of its signal, the gain in those of both."""
    source = section.text("file")
    command, output = (_signal_of_role(section, role, tuple(signals.values())) for role in ("input", "output"))
    to_si, from_command = SI[signals[output].unit][1], SI[signals[command].unit][1]
    offset, amplitude = (from_command * section.number(key) for key in ("offset", "amplitude"))
    test = SineTest(offset, amplitude, input=command, output=output)
    use = section.text("use", "fit", among=("fit", "validate"))
    columns = section.values.get("columns")
    if not isinstance(columns, list) or any(name not in columns for name in TABLE_COLUMNS):
        raise BadInput(f"{section.place}: columns must name {', '.join(TABLE_COLUMNS)}, in the order of the file")
    names, origin = tuple(str(name) for name in columns), section.text("origin", f"measured, {source}")
    scale = to_si / from_command
    response = read_response(folder / source, names, test, section.place, scale=scale, origin=origin)
    return MeasuredRecord(source, TABLE, use, response)


def _signal_of_role(section: _Section, role: str, signals: tuple[MeasuredSignal, ...]) -> str:
    """The record's own choice, or the only signal of that role."""
    names = tuple(signal.name for signal in signals if signal.role == role)
    if role in section.values:
        return section.text(role, among=names)
    if len(names) != 1:
        raise BadInput(
            f'{section.place}: a response needs one {role}, and {len(names)} signals have role = "{role}"; '
            f"give one signal that role, or name it in the record: {role} = ..."
        )
    return names[0]
