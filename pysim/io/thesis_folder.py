"""Stepped-sine logs without a dataset.toml: the names of folders and files say what they are."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.columns import Columns, read_columns, refuse_standing_time
from pysim.io.measured_log import TIME, in_si, refuse_fast_sine
from pysim.io.units import Scale, signal_in_si, unit_cure
from pysim.types import UNITS, BadInput, Dataset, MeasuredRecord, MeasuredSignal
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]

LOG_SUFFIXES = (".txt", ".csv", ".dat", ".log", ".asc", ".lvm", ".parquet", ".tdms")
_FREQUENCY = re.compile(r"(?<![\d.,])(\d+(?:[.,]\d+)?) ?_?Hz", re.IGNORECASE)
_BARE = re.compile(r"\d+(?:[.,]\d+)?")
_POINT = re.compile(r"O([+-]?\d+(?:[.,]\d+)?)_A(\d+(?:[.,]\d+)?)", re.IGNORECASE)
_IMPURE = 0.2  # of the amplitude: what a command may differ from a sine for its offset and amplitude to be read off


@dataclass(frozen=True)
class _Named:
    """A log and what its name says: Hz, and offset and amplitude in the command's unit where they are stated."""

    path: Path
    frequency: float
    offset: float | None
    amplitude: float | None


def read_thesis_folder(folder: Path | str, signals: Sequence[MeasuredSignal]) -> Dataset:
    """Read a folder of stepped-sine logs, one per frequency, the frequency in the file's name: `0.5Hz.txt`.

    Offset and amplitude stand in the name of a folder or of the file, as `O+25_A10`. Where they do not, they are read
    off the logged command by least squares, and rounded to a hundredth of the amplitude's power of ten, so that the
    frequencies of one test agree. The columns of a text log are time in s and then the signals; those of a .parquet or
    .tdms file are found by name.

    Args:
        folder: searched with all below it. Files without a frequency in their name are left out and named in the
            description.
        signals: in the order of the columns, in the units of the files; the command has the role "input".
    Returns:
        records in order of folder and frequency, for "fit".
    Raises:
        BadInput: no such folder or no log in it, roles or units that do not fit, or a log that `read_dataset` would
            refuse; with file, line and remedy.
    Source: thesis Section 2.3.
    """
    folder = Path(folder)
    by_name = _checked(signals)
    if not folder.is_dir():
        raise BadInput(f"{folder} is no folder that can be read; name the folder of the logs")
    paths = sorted(path for path in folder.rglob("*") if path.suffix.lower() in LOG_SUFFIXES and path.is_file())
    named = [_named(folder, path) for path in paths]
    logs = sorted((log for log in named if log), key=lambda log: (log.path.parent, log.frequency))
    if not logs:
        raise BadInput(f"{folder} holds no log with a frequency in its name; name the logs like 0.5Hz.txt")
    _refuse_repeated(logs)
    left_out = [path.relative_to(folder).as_posix() for path, log in zip(paths, named, strict=True) if not log]
    note = f"; without a frequency in its name and left out: {', '.join(left_out)}" if left_out else ""
    return Dataset(
        name=folder.resolve().name,
        description=f"stepped sines, from the names of folders and files{note}",
        system="-",
        signals=tuple(signal_in_si(signal) for signal in signals),
        records=tuple(_record(folder, log, by_name) for log in logs),
    )


def _checked(signals: Sequence[MeasuredSignal]) -> dict[str, MeasuredSignal]:
    by_name = {signal.name: signal for signal in signals}
    if len(by_name) != len(signals) or TIME in by_name:
        raise BadInput(f'signals: {", ".join(s.name for s in signals)}; give each another name, and none "{TIME}"')
    roles = [signal.role for signal in signals]
    if roles.count("input") != 1 or roles.count("output") != len(roles) - 1 or len(roles) < 2:
        raise BadInput('signals: needs one with the role "input", the command, and one or more with "output"')
    for signal in signals:
        if signal.unit not in UNITS:
            raise BadInput(f"signal {signal.name}: unit = {signal.unit!r} is not known; {unit_cure(signal.unit)}")
    return by_name


def _named(folder: Path, path: Path) -> _Named | None:
    """What the name of a log says, or None where it holds no frequency."""
    found = _FREQUENCY.findall(path.stem) or _BARE.findall(path.stem if _BARE.fullmatch(path.stem) else "")
    if not found:
        return None
    points = _POINT.findall(f"{folder.resolve().name}/{path.relative_to(folder).as_posix()}")
    offset, amplitude = map(_number, points[-1]) if points else (None, None)
    return _Named(path, _number(found[-1]), offset, amplitude)


def _refuse_repeated(logs: list[_Named]) -> None:
    """Two logs of one frequency in one folder: a copy, or two tests that nothing tells apart."""
    seen: dict[tuple[Path, float, float | None, float | None], Path] = {}
    for log in logs:
        one = seen.setdefault((log.path.parent, log.frequency, log.offset, log.amplitude), log.path)
        if one != log.path:
            raise BadInput(
                f"{log.path}: {one.name} beside it is of {log.frequency:g} Hz too; remove one of them, or give each "
                "test a folder of its own"
            )


def _number(text: str) -> float:
    return float(text.replace(",", "."))


def _record(folder: Path, log: _Named, signals: dict[str, MeasuredSignal]) -> MeasuredRecord:
    source = log.path.relative_to(folder).as_posix()
    if log.frequency <= 0 or log.amplitude == 0:
        raise BadInput(f"{log.path}: frequency and amplitude in its name must be positive; correct the name")
    command = next(signal for signal in signals.values() if signal.role == "input")
    columns = read_columns(log.path, (TIME, *signals), str(folder))
    refuse_standing_time(columns)
    refuse_fast_sine(f"the name of {log.path.name}", columns, log.frequency)
    scales = {name: Scale.of(signal.unit) for name, signal in signals.items()}
    data = in_si(columns, scales, f"measured, {source}")
    offset, amplitude = log.offset, log.amplitude
    if offset is None or amplitude is None:
        offset, amplitude = _swing(log, columns, command.name)
    driven = scales[command.name]
    test = driven.number(offset), driven.gain * amplitude, log.frequency
    return MeasuredRecord(source, STEPPED_SINE.name, "fit", data, *test, command=command.name)


def _swing(log: _Named, columns: Columns, command: str) -> tuple[float, float]:
    """Offset and amplitude of the logged command, in its unit, by least squares at the frequency of the name."""
    angle = 2 * math.pi * log.frequency * (columns[TIME] - columns[TIME][0])
    regressors = np.column_stack([np.sin(angle), np.cos(angle), np.ones_like(angle)])
    solution = np.linalg.lstsq(regressors, columns[command], rcond=None)[0]
    rest = columns[command] - regressors @ solution
    offset, amplitude = float(solution[2]), math.hypot(*solution[:2])
    if not float(np.sqrt(2 * np.mean(rest**2))) < _IMPURE * amplitude:
        raise BadInput(
            f"{log.path}: {command} is no sine of {log.frequency:g} Hz, so offset and amplitude cannot be read off it; "
            "correct the frequency in the name, or name the folder like O+25_A10"
        )
    digits = 2 - math.floor(math.log10(amplitude))
    return round(offset, digits), round(amplitude, digits)
