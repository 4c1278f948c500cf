"""Page 2: measured beside simulated: a map of the error, any record with what is left over, Bode plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from nicegui import ui

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.error_map import ErrorMap, command_unit, error_maps, response_unit, working_point
from pysim.app.live import live
from pysim.app.pages.common import doubts, ended, nothing, record_chart, segments, start_button
from pysim.app.pages.moving import moving
from pysim.app.parts import Chart, Table, box, card, head, quantity, text
from pysim.app.records import compared_overlay, measured_overlay, stage_keys
from pysim.present.comparison.figures import bode_chart
from pysim.present.diagnosis.figures.where import map_chart, map_words
from pysim.present.diagnosis.words import BEYOND, step_name
from pysim.present.notes import USES
from pysim.types import Dataset, MeasuredRecord, Record


@dataclass
class _View:
    """What one tab looks at.

    Args:
        record: its number among the logs, since one file may hold several; None: the worst one.
        model: key of LOOKS.
        response: number of the frequency response.
    """

    record: int | None = None
    model: str = ""
    response: int = 0


def compare_page(desk: Desk) -> None:
    """Measured and simulated."""
    view = _View()
    live(lambda: desk.version, lambda: _top(desk), "gap")
    moving(desk)
    live(lambda: (desk.version, view.model), lambda: _maps(desk, view), "gap")
    live(lambda: (desk.version, view.record), lambda: _record(desk, view), "gap")
    live(lambda: (desk.version, view.model, view.response), lambda: _bode(desk, view), "gap")


def _answer(desk: Desk) -> Answer | None:
    return desk.answers.with_effects(desk.project.settings().added) or desk.answers.with_effects(())


def _top(desk: Desk) -> None:
    answer = _answer(desk)
    head("Measured and simulated", "Every log beside the model; residuals in standard deviations of the noise.")
    ended(desk)
    if answer is not None:
        doubts(answer)
    with box("row"):
        start_button(desk, "Compare and refit", "compare", "main" if answer is None else "")
        if answer is not None:
            start_button(desk, "Find what is missing", "diagnose", "main", then="/add")
            for step in answer.data["error"]:
                value = step["fit"] or step["validate"]
                name = step_name(step["step"])
                text("span", f"{name}: {value:.2f}" if value else name, "chip")


def _maps(desk: Desk, view: _View) -> None:
    """Which record to open: the error over offset, amplitude and frequency, and over the time of other logs."""
    answer = _answer(desk)
    check = desk.check
    if answer is None or check is None:
        return
    keys = stage_keys(answer)
    chosen = next((one for one in keys if one[0] == view.model), keys[-1])
    with card():
        with box("row end"):
            text("h2", "Where the error is")
            segments([(key, words) for key, words, _ in keys], chosen[0], lambda key: _set(view, model=key), "Model")
        text("p", map_words(check.dataset), "small")
        for k, one in enumerate(error_maps(chosen[2], check.dataset)):
            figure = map_chart(one.rows, one.columns, one.values, one.title, scale=not k)
            label = f"Map of the error: {len(one.rows)} rows, {len(one.columns)} columns"
            Chart(figure, label, height=76 + 36 * len(one.rows), on_pick=partial(_pick, view, one))


def _pick(view: _View, one: ErrorMap, at: Mapping[str, Any]) -> None:
    """Open the record of a cell; its place on the map tells which."""
    index = at.get("index")
    if isinstance(index, list) and len(index) == 2:
        number = one.logs[int(index[0])][int(index[1])]
        if number is not None:
            _open(view, number)


def _open(view: _View, number: int) -> None:
    view.record = number
    ui.run_javascript("document.getElementById('record')?.scrollIntoView({block: 'start'})")


def _set(view: _View, **values: Any) -> None:
    for name, value in values.items():
        setattr(view, name, value)


def _record(desk: Desk, view: _View) -> None:
    """One record with all models, and the list of all."""
    check = desk.check
    logs = check.dataset.logs() if check else ()
    if check is None or not logs:
        if check is None or not check.records:
            nothing(desk.doing or "No records yet", "" if desk.doing else "Drop a data set on the page Data.")
        return
    answer = _answer(desk)
    errors = _errors(answer)
    number = _worst(logs, errors) if view.record is None or view.record >= len(logs) else view.record
    source = logs[number].source
    overlay = compared_overlay(answer, number) if answer else None
    overlay = overlay or measured_overlay(logs[number])
    of = answer.job.work.name if answer and overlay.models else "data"
    with card() as place:
        place.props('id="record"')
        with box("row end"):
            text("h2", source)
            text("span", USES[logs[number].use], "chip")
        told = "Drag to zoom, double click for all; with the keyboard: arrows, + and −, 0. Grey holds 95 % of noise."
        text("p", told, "small")
        panels = len(overlay.names) * (1.6 if overlay.models else 1.0)
        label, height = f"{source}: measured and simulated over time", round(120 + 165 * panels)
        record_chart(overlay, of, number, label, height)
    _list(view, check.dataset, errors, number)


def _worst(logs: Sequence[MeasuredRecord], errors: Mapping[int, Sequence[float | None]]) -> int:
    """The log with the largest error of the last model, the longest one of several; its number."""

    def size(number: int) -> tuple[float, int]:
        data = logs[number].data
        return errors.get(number, [None])[-1] or 0.0, data.time.size if isinstance(data, Record) else 0

    return max(range(len(logs)), key=size)


def _errors(answer: Answer | None) -> dict[int, list[float | None]]:
    """Number of a log -> error over noise of the base and the last model, its worst signal; None if not simulated."""
    stages = [] if answer is None else [answer.base, answer.last][: 1 if answer.last is answer.base else 2]
    found: dict[int, list[float | None]] = {}
    for k, stage in enumerate(stages):
        for record in stage["records"]:
            sizes = [v for v in record["rms"] if v is not None]
            found.setdefault(record["index"], [None] * len(stages))[k] = max(sizes, default=None)
    return found


def _list(view: _View, dataset: Dataset, errors: Mapping[int, list[float | None]], picked: int) -> None:
    logs = dataset.logs()
    sine = ("offset", "amplitude", "Hz") if any(log.offset is not None for log in logs) else ()
    columns = [("record", "words"), ("use", "words"), *((title, "number") for title in sine)]
    count = max((len(one) for one in errors.values()), default=0)
    columns += [("error, refitted" if k == 0 else "error, now", "number") for k in range(count)]
    units = [command_unit(dataset, log.command) if sine else None for log in logs]
    rows = [_row(log, unit, errors.get(k, []), count) for k, (log, unit) in enumerate(zip(logs, units, strict=True))]
    with card("All records"):
        Table("Records", columns, rows, on_row=lambda k: _open(view, k), picked=picked, height="330px")


def _row(log: MeasuredRecord, unit: str | None, errors: list[float | None], count: int) -> list[Any]:
    """A log, its sine in a unit (None: no cells for it), and its errors over noise in so many cells."""
    hertz = "" if log.frequency is None else f"{log.frequency:g}"
    cells: list[Any] = ["" for _ in range(count)]
    for k, value in enumerate(errors):
        if value is not None:
            cells[k] = {"text": f"{value:.2f}", "value": value, "mark": "high" if value > BEYOND else "low"}
    sine = [] if unit is None else [quantity(log.offset, unit), quantity(log.amplitude, unit), hertz]
    return [log.source, USES[log.use], *sine, *cells]


def _bode(desk: Desk, view: _View) -> None:
    """A frequency response with the band of Table 1.3 and its verdict."""
    answer = _answer(desk)
    check = desk.check
    if answer is None or check is None or not answer.base["responses"]:
        return
    tests = answer.base["responses"]
    number = view.response if view.response < len(tests) else 0
    one = tests[number]
    models = []
    for key, words, stage in stage_keys(answer):
        side = stage["responses"][number]["simulated"] if number < len(stage["responses"]) else None
        if side is not None:
            models.append((key, words, side))
    last, judged = answer.last["responses"][number], (desk.model or {}).get("is_thesis_pump")
    with card():
        with box("row end"):
            text("h2", "Frequency responses")
            if judged:
                words, kind = ("passes", "good") if last["passes"] else ("beyond", "bad")
                text("span", f"{words} Table 1.3", f"chip {kind}")
        options = [(str(k), words) for k, words in enumerate(_points(tests, check.dataset))]
        segments(options, str(number), lambda key: _set(view, response=int(key)), "Operating point")
        if last["message"]:
            text("p", str(last["message"]), "note bad")
        Chart(bode_chart(one, models), f"Bode plot of {one['output']} to {one['input']}", height=440)
        known = [d for d in last["deviations"] if judged and d["value"] is not None]
        told = ", ".join(f"{d['name']} {d['value']:.2g} of {d['limit']:g} {d['unit']}" for d in known)
        text("p", f"{told}." if told else "", "small")


def _points(tests: Sequence[Mapping[str, Any]], dataset: Dataset) -> list[str]:
    """What distinguishes frequency responses."""
    several = len({test["output"] for test in tests}) > 1
    points = [working_point(t["offset"], t["amplitude"], response_unit(dataset, t)) for t in tests]
    return [f"{p}, {t['output']}" if several else p for p, t in zip(points, tests, strict=True)]
