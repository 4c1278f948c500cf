"""Logs without a dataset.toml: the user says what their columns are, and the description is written."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from nicegui import background_tasks, ui
from nicegui.events import GenericEventArguments

from pysim.app.description import UNITS, change_description, described
from pysim.app.desk import Desk
from pysim.app.pages.common import attempt
from pysim.app.parts import box, button, card, text
from pysim.app.upload import LOGS
from pysim.io import column_names, read_thesis_folder
from pysim.types import BadInput, MeasuredSignal

_ROLES = ("time", "input", "output", "-")
_KINDS = ("other", "step", "stochastic", "chirp", "multisine", "frequency-response")


def describe_form(desk: Desk) -> None:
    """A row per column of the logs."""
    from pysim.app.pages.data import amount, choose

    logs = [path for path in sorted(desk.project.data.rglob("*")) if path.suffix.lower() in LOGS]
    if not logs:
        return
    names = column_names(logs[0])
    columns = [_guess(k, name) for k, name in enumerate(names)]
    sines = all("hz" in path.stem.lower() for path in logs)
    kind = {"kind": "frequency-response" if sines else "other"}
    inputs = [v[0] for v in (desk.model or {}).get("variables", []) if v[1] == "input"]
    outputs = [v[0] for v in (desk.model or {}).get("variables", []) if v[1] != "input"]
    with card("What are the columns of these logs?"):
        text(
            "p",
            f"{len(logs)} logs, {len(names)} columns, as {logs[0].name} has them. A dash leaves a column out.",
            "small",
        )
        with box("form").style("grid-template-columns: 1.2fr 0.8fr 0.8fr 1.6fr 0.8fr"):
            for words in ("column", "is", "unit", "variable of the model", "noise"):
                text("span", words, "head")
            for column in columns:
                name = ui.element("input").props("type=text")
                name._props["aria-label"], name._props["value"] = f"name of column {column['number']}", column["name"]
                name.on("change", partial(_named, column), js_handler="(e) => emit(e.target.value)")
                label = f"of column {column['number']}"
                choose(_ROLES, column["role"], partial(_set, column, "role"), f"role {label}")
                choose(UNITS, column["unit"], partial(_set, column, "unit"), f"unit {label}")
                options = ["", *inputs, *outputs]
                choose(options, "", partial(_set, column, "variable"), f"variable {label}")
                amount(None, partial(_set, column, "noise"), f"noise {label}")
        with box("row"):
            text("span", "They are")
            with box("form").style("width: 220px"):
                choose(_KINDS, kind["kind"], lambda v: kind.update(kind=v), "kind of the logs")
            button("Use these logs", lambda: _use(desk, logs, columns, kind["kind"]), "main")


def _set(column: dict[str, Any], key: str, value: Any) -> None:
    column[key] = value


def _named(column: dict[str, Any], event: GenericEventArguments) -> None:
    column["name"] = str(event.args)


def _guess(number: int, name: str) -> dict[str, Any]:
    """Time first, then the command, then what answers."""
    role = "time" if number == 0 else "input" if number == 1 else "output"
    return {"number": number + 1, "name": name, "role": role, "unit": "%", "variable": "", "noise": None}


def _use(desk: Desk, logs: list[Path], columns: list[dict[str, Any]], kind: str) -> None:
    def write() -> None:
        own = [{**c, "variable": c["variable"] or c["name"]} for c in columns]
        rows = (
            _sines(desk.project.data, own) if kind == "frequency-response" else _others(desk.project.data, logs, kind)
        )
        content = described(desk.project.data.name, own, rows)
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
    signals = [MeasuredSignal(c["name"], c["role"], c["unit"], c["name"], c["variable"]) for c in columns[1:]]
    found = read_thesis_folder(folder, signals).records
    return [
        {"file": r.source, "kind": r.kind, "use": r.use}
        | {"offset": r.offset, "amplitude": r.amplitude, "frequency": r.frequency}
        for r in found
    ]
