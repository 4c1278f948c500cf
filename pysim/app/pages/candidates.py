"""Page 4: which effects may be missing, with evidence, equation and sketch; none and unknown are answers too."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from nicegui import ui

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.pages.common import busy, ended, nothing, played, start_button
from pysim.app.pages.moving import moving
from pysim.app.parts import box, button, card, curve, head, text
from pysim.io import shown_value
from pysim.present.diagnosis.words import called, share_text
from pysim.present.notes import listed


def candidates_page(desk: Desk) -> None:
    """The ranking."""
    live(lambda: desk.version, lambda: _top(desk), "gap")
    moving(desk)
    live(lambda: desk.version, lambda: _build(desk), "gap")


def _top(desk: Desk) -> None:
    answer = desk.answers.newest("ranking")
    told = "Every effect of the catalogue that fits a slot of the model, by what it would explain."
    head("What may be missing", told)
    ended(desk)
    with box("row"):
        start_button(desk, "Rank the candidates", "rank", "main" if answer is None else "")
        start_button(desk, "Find what is missing", "diagnose", then="/add")
        text("span", "Ranking decides nothing; finding adds what the measurements demand, and says why.", "small")
    whole = desk.answers.verdict
    if whole is not None and whole.added == desk.project.settings().added:  # else it is about another model
        _verdict(whole)


def _build(desk: Desk) -> None:
    answer = desk.answers.newest("ranking")
    effects = (desk.model or {}).get("effects", [])
    if answer is None and not effects:
        named = "The model has no slots that an effect fits. Compare shows where it fails."
        nothing("No candidates", named if desk.model else "Name a model with slots on the page Data.")
        return
    with card("Candidates" if answer else "Effects that fit the model's slots"):
        rows = _rows(answer)
        tried = {row["effect"] for row in rows}  # a law may have been written since
        rows += [{"effect": one["name"]} for one in effects if one["name"] not in tried]
        groups = [] if answer is None else [set(group) for group in answer.data["confusable"]]
        with box("tight").props('role="list"'):
            for rank, row in enumerate(rows, 1):
                _candidate(desk, rank, row, groups)


def _rows(answer: Answer | None) -> list[Mapping[str, Any]]:
    """Of the first round, best first; the verdict reports a later round."""
    if answer is None:
        return []
    first = [row for row in answer.data["ranking"] if row["round"] == 1]
    return sorted(first, key=lambda row: -(row["score"] or 0.0))


def best_of(answer: Answer) -> str:
    """The candidate that improves the fit most, or that none does."""
    first = next(iter(_rows(answer)), None)
    return called(str(first["effect"])) if first is not None and (first["score"] or 0.0) > 0 else "none gains"


def _verdict(answer: Answer) -> None:
    """The diagnosis in its own words."""
    with card():
        text("p", str(answer.data["reason"]), "statement")
        for group in answer.data["confusable"]:
            text("p", f"These data cannot tell {listed(group)} apart.", "note")
        if "next_test_about" in answer.data:
            with box("note row"):
                text("span", f"The test that would: {answer.data['next_test_about']}")
                if "plan" in answer.data["files"]:
                    played(answer)


def _candidate(desk: Desk, rank: int, row: Mapping[str, Any], groups: list[set[str]]) -> None:
    name = str(row["effect"])
    known = next((one for one in (desk.model or {}).get("effects", []) if one["name"] == name), None)
    tied = any(name in group for group in groups)
    gains, place = (row.get("score") or 0.0) > 0, "first " * (rank == 1)
    kind = f"{place if gains else 'idle ' if 'score' in row else ''}{'tied' if tied else ''}"
    with box(f"candidate {kind}").props('role="listitem"').mark(name):
        text("span", str(rank) if gains else "·", "rank")
        curve(known and known["sketch"])
        with box("tight"):
            _named(known or {"name": name, "about": called(name)}, tied=tied)
        _gain(row, {one["name"]: one["unit"] for one in (known or {}).get("parameters", ())})
        _trying(desk, name)


def effect_row(desk: Desk, effect: Mapping[str, Any]) -> None:
    """An effect in three cells: sketch, name with law, and what tries it."""
    curve(effect["sketch"])
    with box("tight candidate-words"):
        _named(effect)
    _trying(desk, str(effect["name"]))


def _named(effect: Mapping[str, Any], *, tied: bool = False) -> None:
    name = str(effect["name"])
    with box("row"):
        text("h3", str(effect.get("about", name)).removesuffix(f"({name})").strip())
        text("span", name, "chip mono")
        if tied:
            text("span", "tied", "chip").props('title="These data cannot tell the tied apart"')
    if effect.get("law"):
        text("div", str(effect["law"]), "law").props("tabindex=0")  # a long one is scrolled


def _trying(desk: Desk, name: str) -> None:
    if name in desk.project.settings().added:
        text("span", "in the model", "chip good")
    elif others := occupied(desk.model or {}, name, desk.project.settings().added):
        text("span", f"its slot has {' and '.join(others)}; undo to try this one", "small")
    elif any(one["name"] == name for one in (desk.model or {}).get("effects", [])):  # a sensor's error is none of them
        button("Try", lambda: _try(desk, name), "small", off=busy(desk)).mark(name)


def occupied(model: Mapping[str, Any], name: str, added: Sequence[str]) -> list[str]:
    """Effects in the slot of another one that no class puts beside them."""
    slots = {str(one["name"]): str(one["slot"]) for one in model.get("effects", [])}
    here = [one for one in added if name in slots and slots.get(one) == slots[name]]
    classes = [set(of) for slot, *of in model.get("pairs", []) if slot == slots.get(name)]
    return [] if set() in classes or {*here, name} in classes else here


def _gain(row: Mapping[str, Any], units: Mapping[str, str]) -> None:
    with box("gain"):
        if "score" not in row:
            return
        gains, explained = (row["score"] or 0.0) > 0, float(row["explained"] or 0.0)
        with box("bar"):
            ui.element("i").style(f"width: {100 * max(0.0, min(1.0, explained)) * gains:.1f}%")
        how = "refitted" if row["refitted"] else "estimated, not refitted"
        share = f"explains {share_text(explained)} of the misfit"
        text("span", f"{share} ({how})" if gains else "gains nothing: no better than the model without it")
        found = {name: value for name, value in row["parameters"].items() if value is not None}
        sizes = (f"{name} {shown_value(value, units.get(name) or '1', '.4g')}" for name, value in found.items())
        text("span", ", ".join(sizes), "small mono")


def _try(desk: Desk, name: str) -> None:
    desk.add(name)
    ui.navigate.to("/add")
