"""Write a data set as a test bench leaves it: text logs and the dataset.toml that says what they are."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath, PureWindowsPath

import numpy as np
from numpy.typing import NDArray

from pysim.io.columns import names_its_columns
from pysim.io.file_names import same_file, unusable_name
from pysim.io.files import write_file
from pysim.io.prepare import Step, values_of
from pysim.io.response_table import TABLE_COLUMNS
from pysim.io.toml_text import toml_key, toml_table
from pysim.io.units import Scale
from pysim.types import UNITS, BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, conversion
from pysim.types.record_kind import HOLDS, KINDS

Array = NDArray[np.float64]

_DIGITS = 7  # of the largest value, where neither noise nor resolution says how many mean anything
_FINER = 100.0  # how far rounding stays below noise and resolution
_TIME_SHARE = 1e-4  # of a sampling interval: how far a printed time may be from the true one


def write_dataset(
    folder: Path | str,
    dataset: Dataset,
    *,
    units: Mapping[str, str] | None = None,
    steps: Sequence[Step] = (),
    exact: bool = False,
) -> Path:
    """Write a data set that `read_dataset` reads back to the printed digits.

    Values are printed to a hundredth of the signal's noise or resolution, whichever is smaller, or to seven digits of
    its largest value where it has neither.

    Args:
        folder: made here; must be empty or not there. Records go to the files they name as their source.
        units: signal -> unit in the files; its own unit where not specified.
        steps: of the preparation, done again whenever the data set is read.
        exact: whether all digits are printed, whatever they mean.
    Returns:
        the path of dataset.toml.
    Raises:
        BadInput: a folder that holds something, a source outside of it, twice, that some system cannot hold, or that is
            no text by its suffix, a unit of another kind, a test that does not say what its kind needs, or a place that
            cannot be written.
    """
    folder, units = Path(folder), dict(units or {})
    scales = {signal.name: _scale(signal, units.setdefault(signal.name, signal.unit)) for signal in dataset.signals}
    _check_sources(dataset)
    _check_tests(dataset)
    digits = {s.name: None if exact else _digits(s, dataset, scales[s.name].gain) for s in dataset.signals}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            raise BadInput(
                f"{folder} holds files already; choose a new folder, so that no old log stays among new ones"
            )
        for record in dataset.records:
            path = folder / record.source
            path.parent.mkdir(parents=True, exist_ok=True)
            write_file(path, _content(record, units, scales, digits))
        write_file(
            folder / "dataset.toml", _description(dataset, dataset.name or folder.resolve().name, units, scales, steps)
        )
    except OSError as error:
        raise BadInput(f"{folder}: cannot write there ({error.strerror or error}); choose another folder") from error
    return folder / "dataset.toml"


def write_description(folder: Path, dataset: Dataset, units: Mapping[str, str]) -> Path:
    """Write the dataset.toml of logs that are still to be measured: `read_dataset` reads them once they are there.

    Args:
        folder: of the logs, which records name as their source; made here.
        dataset: of records whose data have the columns of the logs to come, and any rows.
        units: signal -> unit in the files.
    Raises:
        BadInput: there is a dataset.toml already, or the place cannot be written.
    """
    path = folder / "dataset.toml"
    if path.exists():
        raise BadInput(f"{path} is there already; choose a new folder, so that it goes on describing its own logs")
    scales = {signal.name: _scale(signal, units.get(signal.name, signal.unit)) for signal in dataset.signals}
    named = {signal.name: units.get(signal.name, signal.unit) for signal in dataset.signals}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_file(path, _description(dataset, dataset.name, named, scales, ()))
    except OSError as error:
        raise BadInput(f"{folder}: cannot write there ({error.strerror or error}); choose another folder") from error
    return path


def _scale(signal: MeasuredSignal, unit: str) -> Scale:
    """From the unit of the files to that of the signal."""
    known = conversion(unit, signal.unit)
    if known is None or unit not in UNITS:
        kin = ", ".join(name for name in UNITS if conversion(name, signal.unit))
        raise BadInput(f"signal {signal.name} is in {signal.unit} and cannot be written in {unit!r}; use one of {kin}")
    return Scale(signal.unit, *known)


def _check_tests(dataset: Dataset) -> None:
    """What `read_dataset` would miss."""
    for record in dataset.logs():
        missing = [key for key in KINDS[record.kind].needs if getattr(record, key) is None]
        if missing:
            needed = f"kind {record.kind!r} needs {' and '.join(missing)}"
            raise BadInput(f"record {record.source!r}: {needed}; tell what it was, or give another kind")


def _check_sources(dataset: Dataset) -> None:
    """Every record in a file of its own on any system: some tell no capital letters from small ones."""
    seen = {"dataset.toml"}
    for record in dataset.records:
        path = PurePosixPath(record.source)
        if path.is_absolute() or ".." in path.parts or PureWindowsPath(record.source).drive or not path.name:
            raise BadInput(f"record {record.source!r} would be written outside the data set; give it a relative name")
        if why := unusable_name(record.source):
            raise BadInput(f"record {record.source!r}: {why}; rename it")
        if names_its_columns(Path(record.source)):
            raise BadInput(
                f"record {record.source!r}: what is written is text, which {path.suffix} is not; give it a name that "
                "ends in .txt"
            )
        if same_file(record.source) in seen:
            raise BadInput(
                f"record {record.source!r} has the name of another file, but for capital letters at most; "
                "give each its own"
            )
        seen.add(same_file(record.source))


def _digits(signal: MeasuredSignal, dataset: Dataset, to_si: float) -> int:
    """Decimals worth printing, in a unit of which one is `to_si` of the signal's."""
    steps = [step for step in (signal.noise, signal.resolution) if step]
    if steps:
        return max(0, math.ceil(-math.log10(min(steps) / to_si / _FINER)))
    logs = [record.data for record in dataset.logs() if isinstance(record.data, Record)]
    largest = max((float(np.abs(log[signal.name]).max()) for log in logs if signal.name in log.names), default=0.0)
    return max(0, _DIGITS - 1 - math.floor(math.log10(largest / to_si))) if largest else _DIGITS


def _content(
    record: MeasuredRecord, units: Mapping[str, str], scales: Mapping[str, Scale], digits: Mapping[str, int | None]
) -> str:
    if isinstance(record.data, FrequencyResponse):
        return _table(record, record.data, scales)
    log = record.data
    columns = [log.time, *((log[name] - scales[name].zero) / scales[name].gain for name in log.names)]
    heads = ["time_s", *(name + _suffix(units[name]) for name in log.names)]
    decimals = [None if None in digits.values() else _time_digits(log.time), *(digits[name] for name in log.names)]
    between = _between(record, heads)
    form = between.join("%.17g" if count is None else f"%.{count}f" for count in decimals)
    rows = (form % row for row in zip(*(column.tolist() for column in columns), strict=True))
    return "\n".join([between.join(heads), *rows]) + "\n"


def _between(record: MeasuredRecord, heads: Sequence[str]) -> str:
    """What separates columns: commas in a .csv, unless a name has one; else tabs."""
    return "," if record.source.lower().endswith(".csv") and not any("," in head for head in heads) else "\t"


def _time_digits(time: Array) -> int:
    """Decimals, four or more, that tell every sampling interval."""
    allowed = _TIME_SHARE * float(np.diff(time).min()) if time.size > 1 else 1.0
    return next(d for d in range(4, 16) if d == 15 or np.abs(np.round(time, d) - time).max() <= allowed)


def _suffix(unit: str) -> str:
    """A unit as part of a column's name."""
    word = unit.replace("%", "pct").replace("/", "_per_").replace(".", "")
    return "" if unit == "1" else f"_{word}"


def _table(record: MeasuredRecord, response: FrequencyResponse, scales: Mapping[str, Scale]) -> str:
    scale = scales[response.test.output].gain / scales[response.test.input].gain
    columns = response.frequency, 20 * np.log10(response.gain / scale), np.degrees(response.phase)
    between = _between(record, TABLE_COLUMNS)
    rows = (between.join(map(repr, row)) for row in zip(*(column.tolist() for column in columns), strict=True))
    return "\n".join([between.join(TABLE_COLUMNS), *rows]) + "\n"


def _description(
    dataset: Dataset, name: str, units: Mapping[str, str], scales: Mapping[str, Scale], steps: Sequence[Step]
) -> str:
    """dataset.toml."""
    about: dict[str, object]
    about = {"name": name, "description": dataset.description or None, "system": dataset.system or None}
    about |= {"preparation": [values_of(step) for step in steps]} if steps else {}
    parts = [toml_table("[dataset]", about)]
    for signal in dataset.signals:
        to_si = scales[signal.name].gain
        about = {"role": signal.role, "unit": units[signal.name], "quantity": signal.quantity or signal.name}
        about |= {} if signal.variable in ("", signal.name) else {"variable": signal.variable}
        noise, resolution = (None if v is None else _tidy(v / to_si) for v in (signal.noise, signal.resolution))
        hold = next((word for word, command in HOLDS.items() if command is signal.hold), None)
        numbers = {"noise": noise, "resolution": resolution}
        parts.append(toml_table(f"[signals.{toml_key(signal.name)}]", about | numbers | {"hold": hold}))
    parts += [toml_table("[[records]]", _about(record, dataset, scales)) for record in dataset.records]
    return "\n".join(parts)


def _about(record: MeasuredRecord, dataset: Dataset, scales: Mapping[str, Scale]) -> dict[str, object]:
    """The keys of a record."""
    data = record.data
    columns = list(TABLE_COLUMNS) if isinstance(data, FrequencyResponse) else ["time", *data.names]
    about: dict[str, object] = {"file": record.source, "columns": columns, "kind": record.kind}
    inputs = dataset.columns(record, "input")
    command = record.command or next(iter(inputs), "")
    about |= {"input": command} if len(inputs) > 1 and record.command else {}
    numbers = {"offset": record.offset, "amplitude": record.amplitude}
    if isinstance(data, FrequencyResponse):
        about |= {"input": data.test.input, "output": data.test.output}
        command = data.test.input
        numbers = {"offset": data.test.offset, "amplitude": data.test.amplitude}
    scale = scales[command] if command else Scale("1", 1.0)
    moved = {"offset": scale.zero, "amplitude": 0.0}
    about |= {
        key: None if value is None else _tidy((value - moved[key]) / scale.gain) for key, value in numbers.items()
    }
    about |= {"frequency": record.frequency, "use": record.use}
    usual = f"measured, {record.source}"
    about |= {"initial": record.initial, "begin": record.begin}
    return about | {"origin": data.origin if data.origin not in ("", usual) else None}


def _tidy(value: float) -> float:
    """Without the last digits that a change of units leaves."""
    return float(f"{value:.12g}")
