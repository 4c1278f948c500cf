"""What the columns of bare logs are, as far as headings and the model tell it, and the data set made of them."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Mapping, Sequence
from itertools import chain, repeat
from pathlib import Path, PurePosixPath
from typing import Any

from pysim.app.description import description_text, put_unit, read_description
from pysim.io import log_source, read_described, read_thesis_folder, write_file
from pysim.io.load import READERS, RawTable
from pysim.io.load.clock import read_clock, rises
from pysim.io.load.headings import name_and_unit
from pysim.nouns.data import load
from pysim.types import UNITS, BadInput, MeasuredSignal, conversion
from pysim.types.record_kind import LOGS, STEPPED_SINE

SINE = STEPPED_SINE.name
ROLES = ("time", "input", "output", "-")
COLUMNS = "columns.json"  # what was said of the columns of logs, beside the data set that was made of them
KINDS = tuple(kind.name for kind in reversed(LOGS) if not kind.needs or kind is STEPPED_SINE)


def guesses(table: RawTable) -> list[dict[str, Any]]:
    """The clock, then the command, then what answers; a unit that the log tells is taken."""
    try:
        clock = read_clock(table, None, {}, ()).heading
    except BadInput:  # none, or several: the user will say
        clock = next((one for one in table.headings if rises(table, one)), table.headings[0])
    roles = chain(("input",), repeat("output"))
    found = []
    for heading in table.headings:
        name, unit = name_and_unit(heading)
        unit = table.units.get(heading, unit)
        role = "time" if heading == clock else next(roles) if _holds_numbers(table, heading) else "-"
        own = {"heading": heading, "name": name, "role": role, "unit": unit if unit in UNITS else ""}
        found.append({**own, "variable": "", "noise": None})
    return found


def _holds_numbers(table: RawTable, heading: str) -> bool:
    try:
        return bool(table.numbers(heading).size)
    except BadInput:
        return False


def matched(column: dict[str, Any], variables: Sequence[Sequence[str]]) -> None:
    """Take the model's variable of the column's name, its role, and its unit where the heading has none."""
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


def describe_logs(folder: Path, columns: Sequence[Mapping[str, Any]], kind: str, into: Path) -> None:
    """Write the logs of a folder as a data set: text, times in s, a dataset.toml. The last of several is held out.

    Args:
        columns: of every log: `heading`, `name`, `role`, `unit`, `noise`, and `variable`: "" where the name is the
            model's too.
        kind: of all logs, one of KINDS.
        into: a folder that is not there yet.
    Raises:
        BadInput: what has to be chosen otherwise.
    """
    clocks = [c for c in columns if c["role"] == "time"]
    own = {role: {c["name"]: c for c in columns if c["role"] == role} for role in ("input", "output")}
    signals = own["input"] | own["output"]
    if len(clocks) != 1 or not all(own.values()):
        raise BadInput("columns: choose one as time, and at least one input and one output")
    if len(signals) < sum(c["role"] in own for c in columns):
        raise BadInput("columns: two have the same name; give each its own")
    if without := [name for name, c in signals.items() if not c["unit"]]:
        raise BadInput(f"{', '.join(without)}: choose a unit, or a dash to leave the column out")
    time = {clocks[0]["heading"]: clocks[0]["unit"]} if clocks[0]["unit"] else {}  # another heading tells its own unit
    _refuse_unlike(folder, [c for c in columns if c["role"] != "-"])
    try:
        inputs, outputs = ({name: _called(c, columns) for name, c in one.items()} for one in own.values())
        load(
            folder, inputs=inputs, outputs=outputs, time=_called(clocks[0], columns),
            units={name: c["unit"] for name, c in signals.items()} | time,
            noise={name: c["noise"] for name, c in signals.items() if c["noise"] is not None},
            variables={name: c["variable"] for name, c in signals.items() if c["variable"]},
        ).save(into)  # fmt: skip
    except BadInput as error:
        raise BadInput(str(error).replace(f"{folder}{os.sep}", "")) from error
    content = read_description(into / "dataset.toml")
    content["dataset"]["description"] = "dropped as logs"
    for name, c in signals.items():
        put_unit(name, content["signals"][name], c["unit"], name_and_unit(c["heading"])[1])
    if kind == SINE:
        content["records"] = _sines(into, content)
    for record in content["records"]:
        record["kind"] = kind
        record.pop("origin", None)  # where it lay on this machine
    if kind != SINE and len(content["records"]) > 1:
        content["records"][-1]["use"] = "validate"
    write_file(into / "dataset.toml", description_text(content))
    write_file(into / COLUMNS, json.dumps({"columns": list(columns), "kind": kind}, indent=1))


def _called(column: Mapping[str, Any], columns: Sequence[Mapping[str, Any]]) -> str:
    """What a column is called in every log: its name without the unit, unless another one has that too."""
    names = [name_and_unit(one["heading"])[0] for one in columns]
    name = name_and_unit(column["heading"])[0]
    return str(column["heading"]) if names.count(name) > 1 else name


def _refuse_unlike(folder: Path, columns: Sequence[Mapping[str, Any]]) -> None:
    """A log that lacks a column of the others, or has it in another unit."""
    for log in sorted(path for path in folder.rglob("*") if path.suffix.lower() in READERS):
        (table, *more) = READERS[log.suffix.lower()](log)
        for heading, role in () if more else ((str(c["heading"]), c["role"]) for c in columns):
            name, unit = name_and_unit(heading)
            found = [one for one in table.headings if one == heading or name_and_unit(one)[0] == name]
            if not found:
                its = ", ".join(map(repr, table.headings))
                raise BadInput(f"{log.name} has no column {heading!r}, but {its}; all logs need the same columns")
            if role != "time" and heading not in found and {name_and_unit(one)[1] for one in found} - {"", unit}:
                raise BadInput(f"{log.name} has {found[0]!r}, and another log {heading!r}; give all logs one unit")


def add_logs(folder: Path, data: Path, into: Path) -> Path:
    """More logs, beside those that are there and described as those are; one takes the place of its namesake.

    Args:
        data: the data set, or logs that nobody has described yet.
        into: where all of them go, and what is returned; not there yet.
    Raises:
        BadInput: one that is not like those that are there.
    """
    shutil.copytree(data, into)
    if not (into / "dataset.toml").is_file():
        return Path(shutil.copytree(folder, into, dirs_exist_ok=True))
    content = read_description(into / "dataset.toml")
    known = {PurePosixPath(log_source(str(one["file"]))).name: one for one in content["records"]}
    if (into / COLUMNS).is_file():
        said, made = json.loads((into / COLUMNS).read_text(encoding="utf-8")), into.with_name(f"{into.name}-made")
        describe_logs(folder, said["columns"], said["kind"], made)
        new = [{**one, "use": "fit"} for one in read_description(made / "dataset.toml")["records"]]
        folder = made
    else:
        like = {key: one for key, one in content["records"][0].items() if key in ("columns", "kind", "time")}
        new = [{**like, "file": path.name} for path in folder.rglob("*") if path.suffix.lower() in READERS]
    for one in new:
        before = known.get(PurePosixPath(one["file"]).name)
        shutil.copy(folder / one["file"], into / (one if before is None else before)["file"])
        if before is None:
            content["records"].append(one)
    write_file(into / "dataset.toml", description_text(content))
    for file, why in read_described(into, partly=True).refused:
        if PurePosixPath(file).name in {PurePosixPath(one["file"]).name for one in new}:
            raise BadInput(f"{why}; or put the data set aside on the page Data, and drop all logs anew")
    return into


def _sines(folder: Path, content: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Logs with a frequency in their names: offset, amplitude and frequency from names, or read off the command."""
    # offsets and amplitudes stay in the unit of the files, as a dataset.toml tells them
    signals = [MeasuredSignal(name, one["role"], "1", name, name) for name, one in content["signals"].items()]
    inputs = [signal.name for signal in signals if signal.role == "input"]
    records = {str(record["file"]): record for record in content["records"]}
    told = {"input": inputs[0]} if len(inputs) > 1 else {}
    return [
        {**records[r.source], "offset": r.offset, "amplitude": r.amplitude, "frequency": r.frequency, **told}
        for r in read_thesis_folder(folder, signals).records
    ]
