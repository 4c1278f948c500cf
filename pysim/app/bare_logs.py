"""What the columns of bare logs are, as far as headings and the model tell it, and the description made of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import chain, repeat
from pathlib import Path
from typing import Any

from pysim.app.description import described
from pysim.io import name_and_unit, read_thesis_folder
from pysim.types import SECONDS, UNITS, BadInput, MeasuredSignal, conversion
from pysim.types.record_kind import CHIRP, LOGS, STEPPED_SINE

SINE = STEPPED_SINE.name
ROLES = ("time", "input", "output", "-")
KINDS = tuple(kind.name for kind in reversed(LOGS))


def guesses(headings: Sequence[str], clock: int = 0, *, fixed: bool = False) -> list[dict[str, Any]]:
    """The clock, then the command, then what answers; a unit in the heading's brackets is taken.

    Args:
        headings: as the log has them, a dash for a column that holds no numbers.
        clock: number of the column that is the time.
        fixed: whether columns are found by their headings, which then stay as they are.
    """
    roles = chain(("input",), repeat("output"))
    own = ["-" if one == "-" else "time" if k == clock else next(roles) for k, one in enumerate(headings)]
    return [_guess(k + 1, one, role, fixed) for k, (one, role) in enumerate(zip(headings, own, strict=True))]


def _guess(number: int, heading: str, role: str, fixed: bool) -> dict[str, Any]:
    name, unit = name_and_unit(heading)
    own = {"number": number, "name": heading if fixed else name, "role": role}
    return {**own, "unit": unit if unit in UNITS else "", "variable": "", "noise": None}


def matched(column: dict[str, Any], variables: Sequence[Sequence[str]]) -> None:
    """Take the variable of the column's name, its role, and its unit where the heading has none.

    Args:
        variables: of the model: name, causality, unit, and more.
    """
    found = next((v for v in variables if v[0] == column["name"]), None) or _but_for_case(column, variables)
    if found is None or column["variable"] or column["role"] == "time" or column.get("seen"):
        return
    column["seen"] = True  # what the user then chooses stays
    column["variable"] = found[0]
    column["role"] = "input" if found[1] == "input" else "output"
    if not column["unit"] and found[2] in UNITS:
        column["unit"] = found[2]


def _but_for_case(column: dict[str, Any], variables: Sequence[Sequence[str]]) -> Sequence[str] | None:
    """The only variable of that name in other letters, unless its unit is of another quantity."""
    found = [v for v in variables if v[0].lower() == column["name"].lower()]
    fits = len(found) == 1 and (not column["unit"] or conversion(column["unit"], found[0][2]) is not None)
    return found[0] if fits else None


def bare_description(
    folder: Path, logs: Sequence[Path], columns: Sequence[Mapping[str, Any]], kind: str
) -> dict[str, Any]:
    """The content of a dataset.toml.

    Args:
        folder: of the data set.
        logs: in it, or below.
        columns: of every log: `name`, `role`, `unit`, `variable` ("" where the name is the model's too), `noise`.
        kind: of all logs.
    Raises:
        BadInput: what has to be chosen otherwise.
    """
    own = [{**c, "variable": c["variable"] or c["name"]} for c in columns]
    without = [c["name"] for c in own if c["role"] in ("input", "output") and not c["unit"]]
    if without:
        raise BadInput(f"{', '.join(without)}: choose a unit, or a dash to leave the column out")
    content = described(folder.name, own, _sines(folder, own) if kind == SINE else _others(folder, logs, kind))
    unit = _time_unit(own)
    if unit != "s":
        content["dataset"]["time_unit"] = unit
    return content


def _time_unit(columns: Sequence[Mapping[str, Any]]) -> str:
    """Of the clock, s where nothing was chosen."""
    unit = next((c["unit"] for c in columns if c["role"] == "time" and c["unit"]), "s")
    if unit not in SECONDS:
        raise BadInput(f"time is not stated in {unit}; choose {', '.join(SECONDS)}")
    return str(unit)


def _others(folder: Path, logs: Sequence[Path], kind: str) -> list[dict[str, Any]]:
    """The last of several is not fitted."""
    if kind == CHIRP.name:
        raise BadInput("chirps need offset and amplitude; write a dataset.toml (docs/reference/data_set.md)")
    files = [path.relative_to(folder).as_posix() for path in logs]
    held = len(files) - 1 if len(files) > 1 else -1
    return [{"file": f, "kind": kind, "use": "validate" if k == held else "fit"} for k, f in enumerate(files)]


def _sines(folder: Path, columns: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Offset, amplitude and frequency from names, or read off the command."""
    if [c["role"] for c in columns][:1] != ["time"] or "-" in [c["role"] for c in columns]:
        raise BadInput("stepped sines without a dataset.toml: time must be the first column, and none be left out")
    if _time_unit(columns) != "s":
        raise BadInput(
            "stepped sines without a dataset.toml: their times must be in s; write a dataset.toml for others"
        )
    # offsets and amplitudes stay in the unit of the files, as a dataset.toml tells them
    signals = [MeasuredSignal(c["name"], c["role"], "1", c["name"], c["variable"]) for c in columns[1:]]
    found = read_thesis_folder(folder, signals).records
    return [
        {"file": r.source, "kind": r.kind, "use": r.use}
        | {"offset": r.offset, "amplitude": r.amplitude, "frequency": r.frequency}
        for r in found
    ]
