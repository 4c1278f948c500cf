"""Logs without a dataset.toml: the user says what their columns are, and the description is written."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import background_tasks, ui

from pysim.app.description import change_description, described
from pysim.app.desk import Desk
from pysim.app.pages.common import amount, attempt, counted
from pysim.app.parts import Choice, box, button, card, note, text
from pysim.io import LOG_SUFFIXES, column_names, read_thesis_folder
from pysim.types import UNITS, BadInput, MeasuredSignal

_NAMED = (".parquet", ".tdms")  # whose columns are found by name
_HEADING = re.compile(r"(?P<name>[^\[(]+?)\s*[\[(](?P<unit>[^\])]*)[\])]")
_ROLES = ("time", "input", "output", "-")
_KINDS = ("other", "step", "stochastic", "chirp", "multisine", "frequency-response")


def describe_form(desk: Desk) -> None:
    """A row per column of the logs; what was chosen so far is kept until these logs are described or others come."""
    logs = [path for path in sorted(desk.project.data.rglob("*")) if path.suffix.lower() in LOG_SUFFIXES]
    if not logs:
        return
    try:
        draft = _draft(desk, logs)
    except BadInput as error:
        with card("These logs cannot be read"):
            note(f"{error}, or drop others", "bad")
        return
    columns = draft["columns"]
    with card("What are the columns of these logs?"):
        text(
            "p",
            f"{counted(len(logs), 'log')}, {len(columns)} columns, as {logs[0].name} has them. "
            "A dash leaves a column out; the noise may be left empty.",
            "small",
        )
        with box("form").style("grid-template-columns: 1.2fr 0.8fr 0.8fr 1.6fr 0.8fr"):
            for words in ("column", "is", "unit", "variable of the model", "noise"):
                text("span", words, "head")
            for column in columns:
                _row(desk, column, fixed=logs[0].suffix.lower() in _NAMED)
        with box("row"):
            text("span", "They are")
            with box("form").style("width: 220px"):
                Choice("kind of the logs", _KINDS, draft["kind"], partial(_set, draft, "kind"))
            button("Use these logs", lambda: _use(desk, logs, columns, draft["kind"]), "main")


def _draft(desk: Desk, logs: list[Path]) -> dict[str, Any]:
    """What was chosen for these logs so far, with the model's variables where a column has the name of one."""
    key = tuple((path, path.stat().st_mtime_ns) for path in logs)
    if desk.draft.get("key") != key:
        sines = all("hz" in path.stem.lower() for path in logs)
        read = column_names(logs[0])
        columns = [guess(k, name, fixed=logs[0].suffix.lower() in _NAMED) for k, name in enumerate(read)]
        desk.draft = {"key": key, "kind": "frequency-response" if sines else "other", "columns": columns}
    for column in desk.draft["columns"]:
        matched(column, (desk.model or {}).get("variables", []))
    return desk.draft


def _row(desk: Desk, column: dict[str, Any], *, fixed: bool) -> None:
    """One column; a file that knows its columns by name keeps their names."""
    name = ui.element("input").props("type=text")
    name._props["aria-label"], name._props["value"] = f"name of column {column['number']}", column["name"]
    name._props["disabled"] = fixed
    name.on("change", lambda event: _set(column, "name", event.args), js_handler="(e) => emit(e.target.value)")
    label = f"of column {column['number']}"
    Choice(f"role {label}", _ROLES, column["role"], partial(_set, column, "role"))
    Choice(f"unit {label}", ("", *UNITS), column["unit"], partial(_set, column, "unit"))
    variables = [str(v[0]) for v in (desk.model or {}).get("variables", [])]
    options = list(dict.fromkeys(["", column["variable"], *variables]))
    Choice(f"variable {label}", options, column["variable"], partial(_set, column, "variable"))
    amount(column["noise"], partial(_set, column, "noise"), f"noise {label}")


def _set(one: dict[str, Any], key: str, value: Any) -> None:
    one[key] = str(value).strip() if key == "name" else value


def guess(number: int, heading: str, *, fixed: bool = False) -> dict[str, Any]:
    """Time first, then the command, then what answers; a unit in the heading's brackets is taken.

    Args:
        number: of the column, from 0.
        heading: as the log has it.
        fixed: whether the column is found by its heading, which then stays as it is.
    """
    found = _HEADING.fullmatch(heading)
    name = heading if found is None or fixed else found["name"]
    unit = "" if found is None else found["unit"]
    role = "time" if number == 0 else "input" if number == 1 else "output"
    own = {"number": number + 1, "name": name, "role": role, "unit": unit if unit in UNITS else "", "variable": ""}
    return {**own, "noise": None}


def matched(column: dict[str, Any], variables: Sequence[Sequence[str]]) -> None:
    """Take the variable of the column's name, its role, and its unit where the heading has none.

    Args:
        variables: of the model: name, causality, unit, and more.
    """
    found = next((v for v in variables if v[0].lower() == column["name"].lower()), None)
    if found is None or column["variable"] or column["role"] == "time" or column.get("seen"):
        return
    column["seen"] = True  # what the user then chooses stays
    column["variable"] = found[0]
    column["role"] = "input" if found[1] == "input" else "output"
    if not column["unit"] and found[2] in UNITS:
        column["unit"] = found[2]


def _use(desk: Desk, logs: list[Path], columns: list[dict[str, Any]], kind: str) -> None:
    def write() -> None:
        own = [{**c, "variable": c["variable"] or c["name"]} for c in columns]
        without = [c["name"] for c in own if c["role"] in ("input", "output") and not c["unit"]]
        if without:
            raise BadInput(f"{', '.join(without)}: choose a unit, or a dash to leave the column out")
        rows = (
            _sines(desk.project.data, own) if kind == "frequency-response" else _others(desk.project.data, logs, kind)
        )
        content = described(desk.project.data.name, own, rows)
        if any(c["role"] == "time" and c["unit"] == "ms" for c in own):
            content["dataset"]["time_unit"] = "ms"
        change_description(desk.project.description, content)

    if attempt(write):
        background_tasks.create(desk.read_data())


def _others(folder: Path, logs: list[Path], kind: str) -> list[dict[str, Any]]:
    """The last of several is held out."""
    if kind == "chirp":
        raise BadInput("chirps need their offset and amplitude; write a dataset.toml, as docs/data.md shows")
    files = [path.relative_to(folder).as_posix() for path in logs]
    held = len(files) - 1 if len(files) > 1 else -1
    return [{"file": f, "kind": kind, "use": "validate" if k == held else "fit"} for k, f in enumerate(files)]


def _sines(folder: Path, columns: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Offset, amplitude and frequency from names, or read off the command."""
    if [c["role"] for c in columns][:1] != ["time"] or "-" in [c["role"] for c in columns]:
        raise BadInput("stepped sines without a dataset.toml: time must be the first column, and none be left out")
    if columns[0]["unit"] == "ms":
        raise BadInput("stepped sines without a dataset.toml: their times must be in s; write a dataset.toml for ms")
    signals = [MeasuredSignal(c["name"], c["role"], c["unit"], c["name"], c["variable"]) for c in columns[1:]]
    found = read_thesis_folder(folder, signals).records
    return [
        {"file": r.source, "kind": r.kind, "use": r.use}
        | {"offset": r.offset, "amplitude": r.amplitude, "frequency": r.frequency}
        for r in found
    ]
