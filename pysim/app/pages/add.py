"""Page 5: the search while it runs; the error, step by step; parameters before and after; undo."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from string import ascii_uppercase
from typing import Any

from pysim.app.answers import Answer, current, history
from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.pages.common import busy, doubts, ended, nothing, start_button
from pysim.app.pages.moving import moving
from pysim.app.parts import Chart, Entry, Table, box, button, card, head, note, text
from pysim.present.criteria import CRITERIA
from pysim.present.diagnosis.figures.criteria import criteria_chart
from pysim.present.diagnosis.figures.error import error_chart
from pysim.present.diagnosis.words import step_name
from pysim.present.parameters import parameters_chart
from pysim.present.plain_text import with_interval
from pysim.types import read_step


def add_page(desk: Desk) -> None:
    """The falling error."""
    live(lambda: desk.version, lambda: _top(desk), "gap")
    moving(desk)
    live(lambda: desk.version, lambda: _below(desk), "gap")


def _top(desk: Desk) -> None:
    settings, running = desk.project.settings(), desk.runner.running
    answer = desk.answers.with_effects(settings.added)
    current = answer is not None and answer.added == settings.added and running is None  # not what was undone
    head("Watch the error fall", str(answer.data["reason"]) if answer is not None and current else "")
    ended(desk)
    if desk.answers.verdict is None and not settings.added and running is None:
        with box("row"):
            start_button(desk, "Find what is missing", "diagnose", "main")
            text("span", "or try a candidate on the page Candidates", "small")
    if answer is not None and running is None:
        doubts(answer)
    if settings.added:
        back = partial(desk.choose, settings.added[:-1])
        with box("row end"):
            text("span", f"The model with {' and '.join(settings.added)}", "statement")
            button(f"Undo {settings.added[-1]}", back, "small", off=busy(desk))


def _below(desk: Desk) -> None:
    settings = desk.project.settings()
    answer = desk.answers.with_effects(settings.added)
    if answer is None:
        if desk.runner.running is None and not desk.put_aside:
            nothing("Nothing was fitted yet", "The error begins with the model as it is.")
        return
    _error(history(answer, settings.added))
    _branches(desk)
    if (desk.model or {}).get("is_thesis_pump"):
        _criteria(answer, settings.added)
    _parameters(answer, settings.added)
    for one in answer.data["notes"]:
        note(str(one["text"]))


def _error(steps: Sequence[Mapping[str, Any]]) -> None:
    with card("Error over noise, step by step"):
        text("p", "Root-mean-square residual in standard deviations of the noise: 1 means only noise is left.", "small")
        told = "; ".join(f"{s['step']} {s['fit'] or s['validate'] or 0:.2f}" for s in steps)
        figure = error_chart([read_step(s) for s in steps])
        Chart(figure, f"Error over noise, step by step: {told}", height=350)


def _branches(desk: Desk) -> None:
    """Models that were tried, side by side: any of them can be shown again, or deleted."""
    found, now = desk.answers.branches, desk.project.settings().added
    if not found.keys() - {now}:
        return
    with card("Branches"):
        text("p", "Each model that was tried, and what it leaves in fitted and in held-out logs.", "small")
        first = next(iter(found.values()))
        named = desk.project.settings().named
        names = {added: named.get("+".join(added), "") for added in found}
        ends = [one.data["error"][-1] | {"step": names[added] or " + ".join(added)} for added, one in found.items()]
        figure = error_chart([read_step(s) for s in [*history(first, ())[-1:], *ends]], apart=True)
        Chart(figure, f"Error over noise of {len(found)} branch{'es' if len(found) > 1 else ''}", height=300)
        with box("tight"):
            for letter, (added, one) in zip(ascii_uppercase, found.items(), strict=False):
                all_, off = " + ".join(added), busy(desk)
                with box("row").mark(*added):
                    rename, props = partial(desk.name, added), f'type=text placeholder="{letter}"'
                    field = Entry(f"name of branch {letter}", names[added], rename, props)
                    field.classes("field").style("width: 150px")
                    for name in added:
                        text("span", f"+ {name}", "chip")
                    if added == now:
                        text("span", "shown", "chip good")
                    else:
                        button("Show", partial(desk.choose, added), "small", off=off, label=f"show {all_}")
                    button("Delete", partial(desk.delete, one), "small quiet", off=off, label=f"delete {all_}")


def _criteria(answer: Answer, added: Sequence[str]) -> None:
    """Worst value of each criterion of thesis Tables 1.3 and 1.4, per step, with its limit."""
    steps = history(answer, tuple(added))
    symbols = [s for s in CRITERIA if any(s in step["criteria"] for step in steps)]
    if not symbols:
        return
    columns = [("criterion", "words"), ("limit", "number")]
    columns += [(step_name(s["step"]), "number") for s in steps]
    rows = []
    for symbol in symbols:
        one = CRITERIA[symbol]
        cells: list[Any] = [one.name, {"text": f"{one.limit:g} {one.unit}", "value": one.limit}]
        for step in steps:
            value = step["criteria"].get(symbol)
            met = value is not None and value <= one.limit
            told = "–" if value is None else f"{value:.3g} {'✓' if met else '✗'}"
            cells.append({"text": told, "value": value, "mark": "low" if met else "high"})
        rows.append(cells)
    with card("Criteria of thesis Tables 1.3 and 1.4"):
        text("p", "The worst record counts. ✓ within the limit, ✗ beyond it.", "small")
        Chart(criteria_chart(steps), "Worst value of each criterion over its limit, step by step", height=320)
        Table("Worst value of each criterion", columns, rows)


def _parameters(answer: Answer, added: tuple[str, ...]) -> None:
    """Before and after, with 95 percent intervals."""
    model = current(answer, added)
    before = {e["name"]: e for e in answer.base["estimates"]}
    after = {} if model is answer.base else {e["name"]: e for e in model["estimates"]}
    names = list(dict.fromkeys([*before, *after]))
    if not names:
        return
    columns = [("parameter", "words"), ("unit", "words"), ("as it is", "number"), ("refitted", "number")]
    columns += [("95 % from", "number"), ("to", "number")]
    columns += [("now", "number"), ("95 % from", "number"), ("to", "number")] if after else []
    rows, drawn = [], []
    for name in names:
        first, last = before.get(name), after.get(name)
        one = last or first
        assert one is not None
        now = _three(last) if after else []
        rows.append([name, one["unit"], _number(first and first["start"]), *_three(first), *now])
        if one["lower"] is not None and one["upper"] is not None:
            ends = {key: one[key] for key in ("lower", "upper")}
            drawn.append({"name": name, **ends, "before": _point(first), "after": _point(last)})
    with card("Parameters before and after"):
        told = "Estimates with 95 percent intervals; a dash where the measurements do not determine one by itself."
        text("p", told, "small")
        if drawn:
            Chart(parameters_chart(drawn), "Parameters between their bounds", height=80 + 27 * len(drawn))
        Table("Parameters", columns, rows)


def _three(e: Mapping[str, Any] | None) -> list[Any]:
    if e is None:
        return ["", "", ""]
    value: Any
    three = (e["value"], e["low"], e["high"])
    value, *ends = map(_number, three) if None in three else with_interval(e["value"], three[1:], 4)
    if e["value"] in (e["lower"], e["upper"]):
        value = {"text": f"{value} AT BOUND", "value": e["value"], "mark": "high"}
    return [value, *(ends if e["determined"] else ("–", "–"))]


def _point(e: Mapping[str, Any] | None) -> tuple[float, float, float] | None:
    if e is None:
        return None
    low, high = (e["low"], e["high"]) if e["determined"] else (e["value"], e["value"])
    return float(e["value"]), float(low), float(high)


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.4g}"
