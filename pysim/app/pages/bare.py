"""Logs without a dataset.toml: the user says what their columns are, and the description is written."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from pysim.app.bare_logs import KINDS, ROLES, SINE, guesses, matched
from pysim.app.desk import Desk
from pysim.app.pages.common import amount
from pysim.app.parts import Choice, Entry, box, button, card, note, text
from pysim.io.load import READERS
from pysim.present.data_check.words import columns_words
from pysim.types import UNITS, BadInput


def describe_form(desk: Desk) -> None:
    """A row per column of the logs; what was chosen so far is kept until these logs are described or others come."""
    logs = [path for path in sorted(desk.project.data.rglob("*")) if path.suffix.lower() in READERS]
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
        text("p", columns_words(len(logs), len(columns), logs[0].name), "small")
        with box("form").style("grid-template-columns: 1.2fr 0.8fr 0.8fr 1.6fr 0.8fr"):
            for words in ("column", "is", "unit", "variable of the model", "noise"):
                text("span", words, "head")
            for number, column in enumerate(columns, 1):
                _row(desk, column, number)
        with box("row"):
            text("span", "They are")
            with box("form").style("width: 220px"):
                Choice("kind of the logs", KINDS, draft["kind"], partial(_set, draft, "kind"))
            button("Use these logs", lambda: desk.describe(columns, draft["kind"]), "main", off=desk.doing)


def _draft(desk: Desk, logs: list[Path]) -> dict[str, Any]:
    """What was chosen for these logs so far, with the model's variables where a column has the name of one."""
    key = tuple((path, path.stat().st_mtime_ns) for path in logs)
    if desk.draft.get("key") != key:
        sines = all("hz" in path.stem.lower() for path in logs)
        columns = guesses(READERS[logs[0].suffix.lower()](logs[0])[0])
        if [c["heading"] for c in desk.draft.get("columns", ())] != [c["heading"] for c in columns]:
            desk.draft = {"kind": SINE if sines else "other", "columns": columns}
        desk.draft["key"] = key  # more logs of the same columns leave what was chosen
    for column in desk.draft["columns"]:
        matched(column, (desk.model or {}).get("variables", []))
    return desk.draft


def _row(desk: Desk, column: dict[str, Any], number: int) -> None:
    Entry(f"name of column {number}", column["name"], partial(_set, column, "name"))
    label = f"of column {number}"
    Choice(f"role {label}", ROLES, column["role"], partial(_set, column, "role"))
    Choice(f"unit {label}", ("", *UNITS), column["unit"], partial(_set, column, "unit"))
    variables = [str(v[0]) for v in (desk.model or {}).get("variables", [])]
    options = list(dict.fromkeys(["", column["variable"], *variables]))
    Choice(f"variable {label}", options, column["variable"], partial(_set, column, "variable"))
    amount(column["noise"], partial(_set, column, "noise"), f"noise {label}")


def _set(one: dict[str, Any], key: str, value: Any) -> None:
    one[key] = str(value).strip() if key == "name" else value
