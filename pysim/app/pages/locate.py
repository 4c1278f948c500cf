"""Page 3: the model as its slots, each with its share of the misfit, and the term that would close the gap."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.figures import missing_figure
from pysim.app.pages.common import busy, ended, nothing, start
from pysim.app.parts import Chart, box, button, card, head, live, note, text


def locate_page(desk: Desk) -> None:
    """Where something is missing."""
    chosen: dict[str, str] = {}
    live(lambda: (desk.version, chosen.get("slot")), lambda: _build(desk, chosen), "gap")


def _build(desk: Desk, chosen: dict[str, str]) -> None:
    answer = desk.answers.newest("missing")
    head(
        "Where is something missing?",
        "No effect is named for this: each place is given the term that closes the gap best.",
    )
    ended(desk)
    with box("row"):
        kind = "main" if answer is None else ""
        button("Locate", lambda: start(desk, lambda: desk.work("locate")), kind, off=busy(desk))
    slots = (desk.model or {}).get("slots", [])
    found = {} if answer is None else {str(one["slot"]): one for one in answer.data["missing"]}
    if not slots and not found:
        nothing("Nothing to look into yet", "Name a model on the page Data, then press Locate.")
        return
    _flow(slots, found, chosen)
    if answer is not None:
        _term(answer, found, chosen)


def _flow(slots: list[Mapping[str, Any]], found: Mapping[str, Mapping[str, Any]], chosen: dict[str, str]) -> None:
    """The places of the model in its own order; those that were looked at with the share that they would take."""
    first = next(iter(found), "")
    about = {str(slot["name"]): str(slot["about"]) for slot in slots}
    with card("Places of the model"):
        text("p", "How much of the avoidable misfit the best term at each place would take.", "small")
        with box("flow"):
            for name in dict.fromkeys([*about, *found]):
                one = found.get(name)
                on = chosen.get("slot", first) == name and bool(one)
                kind = "on" if on else "" if one else "dim"
                with box(f"slot {kind} {'first' if name == first else ''}", "button").props("type=button") as place:
                    place._props["aria-pressed"] = "true" if on else "false"
                    text("span", f"{100 * one['share']:.1f} %" if one else "not looked at" if found else "–", "share")
                    text("span", name, "name")
                    text("span", about.get(name, ""), "about")
                    if one:
                        box("fill").style(f"width: {max(0.0, min(100.0, 100 * one['share'])):.1f}%")
                        place.on("click", lambda name=name: chosen.update(slot=name))
                    else:
                        place._props["disabled"] = True


def _term(answer: Answer, found: Mapping[str, Mapping[str, Any]], chosen: dict[str, str]) -> None:
    one = found.get(chosen.get("slot", "")) or next(iter(found.values()))
    with card(f"What {one['slot']} would need"):
        if one["formula"]:
            text("p", str(one["formula"]), "statement")
        shape = one["shape"]
        if len(shape["argument"]) > 1:
            words = f"Missing term at {one['slot']} over {one['depends_on']} with its 95 percent band"
            Chart(missing_figure(one), words, height=340)
        took = f"Over {one['depends_on']} it takes {100 * one['share']:.1f} % of the misfit."
        text("p", f"{took} The band holds 95 percent.", "small")
    for line in answer.data["notes"]:
        note(str(line))
