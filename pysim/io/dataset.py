"""Read a measured data set: a folder with `dataset.toml` and the files it names. Nothing of it is ever written to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from pysim.io.limits import LIMITS
from pysim.io.measured_log import TIME, read_log
from pysim.io.measured_table import read_measured_table
from pysim.io.prepare import Step, is_off, prepared, refuse_missing_samples, step_of
from pysim.io.text_fields import LEFT_OUT
from pysim.io.toml_section import Section, read_toml
from pysim.io.units import Scale, signal_in_si, unit_cure
from pysim.types import SECONDS, SI, UNITS, BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import HOLDS, KINDS, RESPONSE_TABLE

_KEYS = ("dataset", "signals", "records")
_DATASET_KEYS = ("name", "description", "system", "time_unit", "preparation")
SIGNAL_KEYS = ("role", "unit", "quantity", "variable", "noise", "resolution", "hold")
_SCALE_KEYS = ("factor", "offset")
_TEST_KEYS = ("offset", "amplitude", "frequency", "input", "output")
_RECORD_KEYS = ("file", "columns", TIME, "kind", "use", *_TEST_KEYS, "origin", "initial", "begin")
_TABLE_ONLY, _LOG_ONLY = (
    ("output",),
    ("frequency", TIME, "initial", "begin"),
)  # a log has all its outputs, and a table its frequencies


def read_dataset(folder: Path | str) -> Dataset:
    """Read a data set: logs over time and tables of frequency responses.

    Args:
        folder: holds dataset.toml, or that file itself; the files it names are relative to it.
    Returns:
        everything in SI units or %, gains from decibels, phases in rad and continuous. An output is not-a-number where
        its cell is empty.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    described = read_described(folder)
    dataset = prepared(described.raw, described.steps)
    refuse_missing_samples(dataset)
    return dataset


@dataclass(frozen=True)
class Described:
    """A data set as its folder has it.

    Args:
        raw: its logs as they were taken; an empty cell is not-a-number.
        steps: of the preparation that dataset.toml asks for.
        units: signal -> unit in the files.
        refused: per record that cannot be read its file and what is wrong.
    """

    raw: Dataset
    steps: tuple[Step, ...]
    units: Mapping[str, str]
    refused: tuple[tuple[str, str], ...] = ()


def read_described(folder: Path | str, *, partly: bool = False) -> Described:
    """Read a data set as `read_dataset` does, with the steps of its preparation still to be done.

    Args:
        partly: leave out records that cannot be read, and say which.
    Raises:
        BadInput: as of `read_dataset`, but for empty cells.
    """
    toml = read_toml(_description(Path(folder)), "data set")
    head = toml.table("dataset")
    toml.whole.refuse_unknown(_KEYS)
    head.refuse_unknown(_DATASET_KEYS)
    described = toml.tables("signals")
    for section in described.values():
        section.refuse_unknown((*SIGNAL_KEYS, *_SCALE_KEYS))
    written = {name: described_signal(name, section, UNITS) for name, section in described.items()}
    scales = {name: _scale(written[name].unit, section) for name, section in described.items()}
    sections = toml.rows("records", "log or table")
    kinds = [_kind(section) for section in sections]
    _refuse_repeated(sections)
    steps = tuple(step_of(section) for section in head.rows_of("preparation") if not is_off(section))
    second = SECONDS[head.text("time_unit", "s", among=tuple(SECONDS))]
    records: list[MeasuredRecord] = []
    refused, numbers = [], 0
    for section, kind in zip(sections, kinds, strict=True):
        try:
            if kind == RESPONSE_TABLE.name:
                records.append(read_measured_table(toml.path.parent, section, written))
            else:
                log = read_log(toml.path.parent, section, kind, written, scales, second)
                numbers = _counted(section, numbers, log)
                records.append(log)
        except BadInput as error:
            if not partly:
                raise
            refused.append((section.source(), str(error)))
    signals = tuple(signal_in_si(signal) for signal in written.values())
    name, about, system = head.text("name"), head.text("description", "-"), head.text("system", "-")
    raw = Dataset(name, about, system, signals, tuple(records))
    return Described(raw, steps, {signal.name: signal.unit for signal in written.values()}, tuple(refused))


def _counted(section: Section, before: int, log: MeasuredRecord) -> int:
    """Numbers of the logs so far, with this one; a small file may hold many, and several records may name it."""
    data = log.data
    numbers = before + (data.time.size + data.values.size if isinstance(data, Record) else 0)
    if numbers > LIMITS.dataset_numbers:
        raise section.error(
            f"with this log the data set holds {numbers} numbers, and {LIMITS.dataset_numbers} at "
            "most are read; write fewer samples a second, or leave logs out"
        )
    return numbers


def _description(place: Path) -> Path:
    """Where the dataset.toml is."""
    if place.suffix == ".toml":
        return place
    if place.is_file():
        raise BadInput(f"{place} is a single file; name the folder of the data set, or its dataset.toml")
    if not place.is_dir():
        raise BadInput(f"there is no folder {place}; correct the name of the data set")
    if not (place / "dataset.toml").exists():
        raise BadInput(
            f"{place} holds no dataset.toml; name the folder that does, or write one that says what the logs are"
        )
    return place / "dataset.toml"


def described_signal(name: str, section: Section, units: Sequence[str] = tuple(SI)) -> MeasuredSignal:
    """What a section says of a signal, in the unit of the files; its other keys are the caller's.

    Args:
        units: that are known; all of them have the zero of their SI unit where the caller does not say more.
    Raises:
        BadInput: a missing or wrong key, or the name of the clock.
    """
    if name == TIME:
        raise section.error(
            f"{TIME} is the clock of every log and no signal; remove the section, and where it is not "
            'in s write time_unit = "ms" or another below [dataset]'
        )
    unit = section.text("unit")
    if unit not in units:
        raise section.error(f"unit = {unit!r} is not known; {unit_cure(unit, units)}")
    role = section.text("role", among=("input", "output"))
    if "hold" in section.values and role == "output":
        raise section.error("hold is for inputs, and this is an output; remove it")
    return MeasuredSignal(
        name=name,
        role=role,
        unit=unit,
        quantity=section.text("quantity", name),
        variable=section.text("variable", name),
        noise=section.not_negative("noise"),
        resolution=section.not_negative("resolution"),
        hold=HOLDS[section.text("hold", among=tuple(HOLDS))] if "hold" in section.values else None,
    )


def _scale(unit: str, section: Section) -> Scale:
    """How a column of that signal becomes a signal in SI."""
    factor, offset = section.optional_number("factor"), section.optional_number("offset")
    if factor == 0:
        raise section.error(f"factor cannot be 0; write how many {unit} one in the column is")
    return Scale.of(unit, 1.0 if factor is None else factor, offset or 0.0)


def _kind(section: Section) -> str:
    """What a record holds, once its keys are known to be, and to mean something there."""
    section.refuse_unknown(_RECORD_KEYS)
    kind = section.text("kind", among=tuple(KINDS))
    for idle in _LOG_ONLY if kind == RESPONSE_TABLE.name else _TABLE_ONLY:
        if idle in section.values:
            cure = "remove it, or correct the kind"
            raise section.error(f'{idle} means nothing where kind = "{kind}"; {cure}')
    return kind


def _refuse_repeated(sections: tuple[Section, ...]) -> None:
    """A log that is named twice would count twice."""
    seen: dict[tuple[str, ...], str] = {}
    for section in sections:
        key = (PurePosixPath(section.source()).as_posix(), *section.texts("columns", repeatable=LEFT_OUT))
        if key in seen:
            raise section.error(f"{key[0]} is the record of {seen[key]} already; name each file once")
        seen[key] = section.place.rpartition(", ")[2]
