"""Records in files: .csv to look at and to hand on, .npz for the exact bits and everything else of the record."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from fmu_build.version import version
from pysim.io.archive import DAMAGED
from pysim.io.files import write_file
from pysim.types import BadInput, Outcome, Record
from pysim.types.json_number import json_number

_TIME = "time [s]"  # heading of the first column
_HEADING = re.compile(r"(?P<name>.*) \[(?P<unit>[^\[\]]*)\]")

_OUTCOMES = "|".join(re.escape(outcome.value) for outcome in Outcome)
_NOTE = re.compile(rf"(?P<origin>.*?): (?P<outcome>{_OUTCOMES})\.(?: (?P<message>.*))?")  # first line of a .csv
_PROGRAM = re.compile(r" \[pysim [^\[\]]*\]$")  # behind it, which version wrote it


def write_record(record: Record, path: Path | str) -> None:
    """Write a record; the suffix chooses the form. The file is complete or not there.

    In a .csv the first line says what it is, the second names each column and its unit, `alpha [deg]`; numbers are
    written with all their digits.

    Raises:
        BadInput: another suffix than .csv or .npz, or a place that cannot be written.
    """
    path = Path(path)
    form = _FORMS.get(path.suffix.lower())
    if form is None:
        raise BadInput(f"{path}: records are written as .csv or .npz; change the suffix")
    try:
        write_file(path, form[0](record))
    except OSError as error:
        raise BadInput(f"{path}: cannot write there ({error.strerror}); choose another folder") from error


def read_record(path: Path | str) -> Record:
    """Read what `write_record` wrote.

    Raises:
        BadInput: no such file, another suffix, or not a record; with the line in a .csv.
    """
    path = Path(path)
    form = _FORMS.get(path.suffix.lower())
    if form is None:
        raise BadInput(f"{path}: records are read from .csv or .npz; change the suffix")
    try:
        return form[1](path)
    except BadInput as error:
        raise error if error.where else BadInput(str(error), where=str(path)) from error
    except OSError as error:
        raise BadInput(f"{path}: cannot be read ({error.strerror})") from error
    except (*DAMAGED, KeyError, TypeError, ValueError) as error:
        raise BadInput(f"{path} is not a record: {error}; write it with write_record") from error


def is_written_record(path: Path) -> bool:
    """Whether `write_record` wrote the file; a log of others may look like a record, but lacks its first line."""
    try:
        read_record(path)
    except BadInput:
        return False
    if path.suffix.lower() != ".csv":
        return True
    with path.open(encoding="utf-8-sig") as file:
        return bool(_PROGRAM.search(file.readline().strip()))


def record_text(record: Record) -> str:
    """A record as a .csv holds it."""
    return _as_csv(record).decode()


def record_data(record: Record) -> dict[str, Any]:
    """A record for JSON: what it says of itself, `time` (n_t) and a row (n_t) per name in `signals`."""
    columns = zip(record.names, record.values.T.tolist(), strict=True)
    signals = {name: [json_number(x) for x in column] for name, column in columns}
    return {**_description(record), "time": record.time.tolist(), "signals": signals}


def _description(record: Record) -> dict[str, Any]:
    """Everything but the numbers, for JSON."""
    return {
        "names": list(record.names),
        "units": list(record.units),
        "outcome": record.outcome.name,
        "message": record.message,
        "origin": record.origin,
        "program": f"pysim {version()}",
        "statistics": dict(record.statistics),
    }


def _as_npz(record: Record) -> bytes:
    buffer = io.BytesIO()
    np.savez_compressed(buffer, time=record.time, values=record.values, about=json.dumps(_description(record)))
    return buffer.getvalue()


def _from_npz(path: Path) -> Record:
    with np.load(path, allow_pickle=False) as file:
        about = json.loads(str(file["about"]))
        return Record(
            file["time"],
            file["values"],
            tuple(about["names"]),
            tuple(about["units"]),
            Outcome[about["outcome"]],
            about["message"],
            about["origin"],
            about["statistics"],
        )


def _as_csv(record: Record) -> bytes:
    text = io.StringIO()
    note = " ".join(f"# {record.origin}: {record.outcome.value}. {record.message} [pysim {version()}]".split())
    text.write(note + "\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([_TIME, *(f"{n} [{u}]" for n, u in zip(record.names, record.units, strict=True))])
    writer.writerows(np.column_stack([record.time, record.values]).tolist())
    return text.getvalue().encode()


def _from_csv(path: Path) -> Record:
    lines = path.read_text(encoding="utf-8-sig").splitlines()
    skipped = 1 if lines and lines[0].startswith("#") else 0
    rows = list(csv.reader(lines[skipped:]))
    headings = [_HEADING.fullmatch(text) for text in rows[0]] if rows else []
    head = f"{path}, line {skipped + 1}"
    if len(headings) < 2 or not all(headings):
        raise BadInput("column names like 'time [s],alpha [deg]' must stand here", where=head)
    if rows[0][0] != _TIME:
        cure = "put the times first, in s"
        raise BadInput(f"the first column is {rows[0][0]!r}, and {_TIME!r} belongs there; {cure}", where=head)
    numbers = np.array([_numbers(path, skipped + i, row, len(headings)) for i, row in enumerate(rows[1:], start=2)])
    numbers = numbers.reshape(-1, len(headings))
    columns = [heading for heading in headings[1:] if heading is not None]
    outcome, message, origin = _noted(lines[0] if skipped else "")
    return Record(
        numbers[:, 0],
        numbers[:, 1:],
        tuple(c["name"] for c in columns),
        tuple(c["unit"] for c in columns),
        outcome,
        message,
        origin,
    )


def _noted(line: str) -> tuple[Outcome, str, str]:
    """Outcome, message and origin from the first line; a line of another hand is the origin."""
    note = _PROGRAM.sub("", line.removeprefix("#").strip())
    found = _NOTE.fullmatch(note)
    if found is None:
        return Outcome.DONE, "", note
    return Outcome(found["outcome"]), found["message"] or "", found["origin"]


def _numbers(path: Path, line: int, row: list[str], width: int) -> list[float]:
    try:
        numbers = [float(text) for text in row]
    except ValueError as error:
        raise BadInput(f"{error}; every entry must be a number", where=f"{path}, line {line}") from error
    if len(numbers) != width:
        raise BadInput(f"{len(numbers)} entries, but {width} columns are named", where=f"{path}, line {line}")
    return numbers


_FORMS = {".csv": (_as_csv, _from_csv), ".npz": (_as_npz, _from_npz)}
