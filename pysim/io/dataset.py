"""Read a measured data set: a folder with `dataset.toml` and the files it names. Nothing of it is ever written to."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pysim.io.text_table import read_table, read_text
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, SineTest

_TIME_AND_ANGLE = ("1", "%", "s", "Hz", "rad", "deg", "rad/s", "deg/s")
_PHYSICAL = ("m", "mm", "Pa", "bar", "m3/s", "l/min", "N", "N.m", "V", "mA")
UNITS = _TIME_AND_ANGLE + _PHYSICAL
TABLE = "frequency-response-table"
TABLE_COLUMNS = ("frequency_hz", "magnitude_db", "phase_deg")
_SIGNAL_KEYS = ("role", "unit", "quantity", "variable", "noise", "resolution")
_RECORD_KEYS = ("file", "columns", "kind", "use", "offset", "amplitude", "frequency", "input", "output")


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
    """Read a data set whose records are tables of frequency responses.

    Args:
        folder: holds dataset.toml; the files it names are relative to it.
    Returns:
        signals in their own units; gains from decibels, phases in rad.
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
    signals = tuple(
        _signal(name, _Section(_place(path, text, f"[signals.{name}]"), values))
        for name, values in _table(content, "signals", path).items()
    )
    rows = content.get("records")
    if not isinstance(rows, list) or not rows:
        raise BadInput(f"{path}: there are no records; add one [[records]] section per log or table")
    sections = [_Section(_place(path, text, "[[records]]", i), values) for i, values in enumerate(rows)]
    return Dataset(
        name=head.text("name"),
        description=head.text("description", "-"),
        system=head.text("system", "-"),
        signals=signals,
        records=tuple(_record(path.parent, section, signals) for section in sections),
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
        unit=section.text("unit", among=UNITS),
        quantity=section.text("quantity", name),
        variable=section.text("variable", name),
        noise=section.optional_number("noise"),
        resolution=section.optional_number("resolution"),
    )


def _record(folder: Path, section: _Section, signals: tuple[MeasuredSignal, ...]) -> MeasuredRecord:
    if not isinstance(section.values, dict):
        raise BadInput(f"{section.place}: a record is a section; write [[records]] with file, columns and kind")
    section.refuse_unknown(_RECORD_KEYS)
    kind = section.text("kind")
    if kind != TABLE:
        raise BadInput(f'{section.place}: records of kind "{kind}" cannot be read; this version reads "{TABLE}" only')
    source = section.text("file")
    test = SineTest(
        section.number("offset"),
        section.number("amplitude"),
        input=_signal_of_role(section, "input", signals),
        output=_signal_of_role(section, "output", signals),
    )
    use = section.text("use", "fit", among=("fit", "validate"))
    return MeasuredRecord(source, kind, use, _response(folder / source, section, test))


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


def _response(path: Path, section: _Section, test: SineTest) -> FrequencyResponse:
    """One table of frequency, magnitude and phase."""
    columns = section.values.get("columns")
    if not isinstance(columns, list) or any(name not in columns for name in TABLE_COLUMNS):
        raise BadInput(f"{section.place}: columns must name {', '.join(TABLE_COLUMNS)}, in the order of the file")
    values, lines = read_table(path, tuple(str(name) for name in columns), section.place)
    frequency, magnitude, phase = (values[:, columns.index(name)] for name in TABLE_COLUMNS)
    steps = np.diff(frequency, prepend=0.0)
    if np.any(steps <= 0):
        where = f"{path}, line {lines[int(np.argmax(steps <= 0))]}"
        raise BadInput(f"{where}: frequencies must be positive and increase; sort the rows, drop repeated ones")
    unwrapped = np.unwrap(np.radians(phase))
    return FrequencyResponse(frequency, 10 ** (magnitude / 20), unwrapped, test, origin=f"measured, {path.name}")
