"""Page 3: the model drawn as its parts and slots, each slot with its share of the misfit, and what a slot misses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.pages.candidates import effect_row
from pysim.app.pages.common import ended, nothing, start_button
from pysim.app.pages.moving import moving
from pysim.app.pages.write import Writing
from pysim.app.parts import Drawing, box, card, note, text
from pysim.present.diagnosis.law_words import formula_text

_Found = Mapping[str, Mapping[str, Any]]


def locate_page(desk: Desk) -> None:
    """Where something is missing."""
    chosen: dict[str, str] = {}
    laws: dict[str, Writing] = {}
    live(lambda: desk.version, lambda: _build(desk, chosen), "gap")
    moving(desk)
    live(lambda: (desk.version, chosen.get("slot")), lambda: _below(desk, chosen, laws), "gap")


def _answer(desk: Desk) -> Answer | None:
    return desk.answers.newest("missing", desk.project.settings().added)


def _found(desk: Desk) -> _Found:
    """Slot -> the best law there, the best slot first."""
    answer = _answer(desk)
    return {} if answer is None else {str(one["slot"]): one for one in answer.data["missing"]}


def _slots(desk: Desk) -> dict[str, Mapping[str, Any]]:
    return {str(slot["name"]): slot for slot in (desk.model or {}).get("slots", [])}


def _build(desk: Desk, chosen: dict[str, str]) -> None:
    found, answer = _found(desk), _answer(desk)
    chosen["slot"] = chosen.get("slot") or next(iter(found), "")
    asked = answer is not None and answer.asked == desk.project.settings().added
    with box("row end"):
        text("h1", "Where is something missing?")
        start_button(desk, "Locate", "locate", "" if asked else "main")
    text("p", "For each place in the model we estimate the force, flow or signal that would close the gap.", "lead")
    ended(desk)
    if answer is not None and not asked:
        had = f"with {' and '.join(answer.asked)}" if answer.asked else "without effects"
        note(f"This was found of the model {had}. Press Locate to ask about the model that is shown now.")
    if not _slots(desk) or (desk.model or {}).get("structure") is None:
        if not found:
            named = "The model has no slots. Locate tries laws at its states, or at the inputs and outputs of an FMU."
            nothing("Nothing to look into yet", named if desk.model else "Name a model on the page Data.")
        return
    _drawing(desk, found, chosen)


def _drawing(desk: Desk, found: _Found, chosen: dict[str, str]) -> None:
    """Every part; the slots with the share of the misfit that a law there would explain."""
    assert desk.model is not None
    parts, added = desk.model["structure"], _added(desk)
    places = [_place(node, found, _slots(desk), added) for node in parts["nodes"]]

    def pick(name: str) -> None:
        chosen["slot"] = name
        drawing.pick(name)

    with card("The model, along its signals"):
        told = "How much of the misfit the best law at each place would explain. Pick a slot to see it."
        text("p", told if found else "Pick a slot to see what may stand there.", "small")
        label = f"{desk.model['name']}: {len(places)} places, {len(_slots(desk))} of them slots"
        drawing = Drawing(label, places, parts["links"], on_pick=pick, picked=chosen["slot"])
        with box("legend small"):
            for kind, words in _legend(bool(found), bool(added)):
                with box("", "span"):
                    box(kind, "i")
                    text("span", words)


def _added(desk: Desk) -> dict[str, list[str]]:
    """Slot -> the effects that were added there."""
    places = {str(one["name"]): str(one["slot"]) for one in (desk.model or {}).get("effects", [])}
    found: dict[str, list[str]] = {}
    for name in desk.project.settings().added:
        found.setdefault(places.get(name, ""), []).append(name)
    return found


def _legend(looked: bool, added: bool) -> list[tuple[str, str]]:
    more = [("has", "effect that was added")] if added else []
    if not looked:
        return [("", "slot: a law can be put there"), *more, ("part", "fixed part")]
    return [("seen", "slot with its share"), ("", "slot that was not looked at"), *more, ("part", "fixed part")]


def _place(
    node: Mapping[str, Any], found: _Found, slots: Mapping[str, Mapping[str, Any]], added: Mapping[str, list[str]]
) -> dict[str, Any]:
    """One place as the drawing takes it."""
    name, kind = str(node["name"]), str(node["kind"])
    slot = name in slots
    one = found.get(name)
    share = None if one is None else max(0.0, min(1.0, float(one["share"])))
    told = "" if share is None else f"{100 * share:.1f} %"
    rows = [name, *filter(None, [told]), *(f"+ {effect}" for effect in added.get(name, []))]
    words = " ".join(rows)  # as they stand there: who speaks to the page says what is to be seen
    words += " of the misfit" if told and slot else "; not looked at" if found and slot else ""
    words += f"; {node['about']}" if node["about"] else ""
    look = [kind if slot or kind != "slot" else "part", "seen" if told else "", "first" if name in [*found][:1] else ""]
    look += ["has"] if name in added else []
    return {
        "name": name, "rows": rows, "kind": " ".join(filter(None, look)), "share": share, "words": words, "pick": slot,
    }  # fmt: skip


def _below(desk: Desk, chosen: dict[str, str], laws: dict[str, Writing]) -> None:
    """What the chosen slot would need, and which effects may stand there."""
    found, slots = _found(desk), _slots(desk)
    name = chosen.get("slot", "")
    one = found.get(name)
    if one is None and name not in slots:
        return
    with card(f"What {name} would need" if one else name):
        answer = _answer(desk)
        if one:
            looks = formula_text(one["formula"], one["factor"], one["shape"]["unit"])
            words = answer.data["reason"] if answer and name == next(iter(found)) else ""
            if words or looks:
                text("p", str(words) or f"It looks like {looks}.", "statement")
        about = str(slots[name]["about"]) if name in slots else ""
        if about:
            text("p", f"{about}.", "small")
        if one is None and found:
            text("p", "No law was learned here: other places explain more.", "note")
        laws.setdefault(name, Writing(desk, name)).show(one)
    _effects(desk, name)
    for line in answer.data["notes"] if answer is not None else ():
        note(str(line["text"]))


def _effects(desk: Desk, slot: str) -> None:
    """Those of the catalogue that fit the slot."""
    own = [one for one in (desk.model or {}).get("effects", []) if one["slot"] == slot]
    if own:
        with card("Effects that fit here"), box("effects"):
            for one in own:
                effect_row(desk, one)
