"""Page 2: the model's parameters, each with a slider that every curve follows."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from nicegui import background_tasks

from pysim.app.answers import current
from pysim.app.description import BEGINS, begin_logs, begins, read_description
from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.pages.common import aside, busy, nothing
from pysim.app.pages.data import change
from pysim.app.parts import Chart, Choice, Sliders, box, button, card, head, text
from pysim.app.records import followed_overlay
from pysim.app.worker import Ended
from pysim.types import BadInput


def model_page(desk: Desk) -> None:
    """Parameters and curves."""
    head("Parameters", "Move a slider, and the model follows. Fits and searches begin at these values.")
    follows = _Follows(desk)
    live(lambda: (desk.model is not None, busy(desk), follows.number, _logs(desk)), follows.build, "gap")
    live(lambda: (desk.version, desk.project.values()), follows.told)


def _logs(desk: Desk) -> tuple[str, ...]:
    return tuple(log.source for log in desk.check.dataset.logs()) if desk.check else ()


class _Follows:
    """One tab: its log, its figure, and the newest values, which are asked for once the ones before were answered."""

    def __init__(self, desk: Desk) -> None:
        self._desk, self.number = desk, 0
        self._values: dict[str, float] = {}
        self._known: list[dict[str, Any]] = []
        self._moves, self._shown = 0, -1
        self._asking = False
        self._chart: Chart | None = None
        self._sliders: Sliders | None = None

    def build(self) -> None:
        """The page anew."""
        self._chart = self._sliders = None
        logs = _logs(self._desk)
        if self._desk.model is None or not logs or (why := busy(self._desk)):
            words = why if self._desk.model is not None and logs else "Drop logs and name a model on the page Data."
            nothing("No curves yet", words)
            return
        self.number = min(self.number, len(logs) - 1)
        with card() as self._place, box("row end"):
            self._state = text("span", "", "statement")
            with box("form").style("width: 240px"):
                Choice("log that is shown", logs, logs[self.number], lambda one: self._look(logs.index(one)))
        with card("Parameters"):
            self._sliders = Sliders(self._rows(), self._moved, self._fit, self._bound)
            with box("row"):
                button("All as the model has them", lambda: self._desk.change({}, bounds=()), "small")
                live(lambda: self._desk.version, self._fitted, "row")
        with card("Initial states"), box("row"):
            text("span", "The logs begin")
            live(lambda: self._desk.version, self._beginning)  # a choice may be undone at once
        self._known, self._values, self._shown = self._ends(), self._all(), -1
        self._ask()

    def _fitted(self) -> None:
        """What the fitted model has beside the rows, and a button that lets fits begin at its values."""
        found, added = _fitted_now(self._desk), self._desk.project.settings().added
        if found:
            own = {name: value for name, value in found.items() if name in self._all()}
            more = [f"{name} = {value:.4g}" for name, value in found.items() if name not in own]
            button("Take over the fitted values", lambda: self._desk.keep(own), "small")
            model = f"of the model with {' and '.join(added)}" if added else "of the refitted model"
            text("span", f"Fitted values are those {model}{': ' * bool(more)}{', '.join(more)}.", "small")
        aside(self._desk)

    def _beginning(self) -> None:
        now = begins(read_description(self._desk.project.description))
        with box("form").style("width: 220px"):
            Choice("how the logs begin", [*BEGINS] if now else ["", *BEGINS], now, self._begin)
        text("span", BEGINS[now][1] if now else "The logs differ.", "small")

    def told(self) -> None:
        """What is in the project now, though another tab, or undo, has written it."""
        moved = self._values != self._all()
        if self._sliders is not None and (moved or self._known != self._ends()):
            self._values = self._all()
            self._show()
            if moved:
                self._ask()

    def _ends(self) -> list[dict[str, Any]]:
        """All that the rows say but for the values."""
        return [{**row, "value": None} for row in self._rows()]

    def _look(self, number: int) -> None:
        self.number = number

    def _all(self) -> dict[str, float]:
        return {row["name"]: row["value"] for row in self._rows()}

    def _rows(self) -> list[dict[str, Any]]:
        """Name, value, bounds, unit, and whether it is fitted."""
        set_, settings, now = self._desk.project.values(), self._desk.project.settings(), _fitted_now(self._desk)
        fitted, written, rows = self._desk.fitted, replace(settings, free=()).ranges, []
        for one in (self._desk.model or {}).get("parameters", []):  # none while it is built anew
            if one["start"] is not None:
                low, high = written.get(one["name"], (one["min"], one["max"]))
                own = {"value": set_.get(one["name"], one["start"]), "fitted": one["name"] in fitted}
                own |= {"now": now.get(one["name"]), "slides": None not in (low, high)}
                rows.append({**one, **own, "min": low, "max": high})
        return rows

    def _begin(self, words: str) -> None:
        if words:
            change(self._desk, lambda content: begin_logs(content, words), safe=True)

    def _bound(self, name: str, end: str, value: float) -> None:
        """Another end of the slider, and of what a fit may come to."""
        row = next(one for one in self._rows() if one["name"] == name)
        here, far = row["value"], abs(row["value"])
        ends = {"min": here - far, "max": here + far}  # where the model has none
        low, high = (float(value if end == key else row[key] if row[key] is not None else ends[key]) for key in ends)
        others = [one for one in self._desk.project.settings().bounds if one.rpartition("=")[0] != name]
        try:
            if not low < high:
                raise BadInput(f"{name}: from {low:g} to {high:g} is no range; give a smaller min, or a larger max")
            own = (self._parameter(name)["min"], self._parameter(name)["max"])
            self._desk.change(bounds=(*others, *([] if own == (low, high) else [f"{name}={low!r}:{high!r}"])))
        finally:
            self._show()

    def _fit(self, name: str, on: bool) -> None:
        """Let a fit change a parameter, or leave it."""
        free = tuple(one for one in self._desk.fitted if one != name) + ((name,) if on else ())
        try:
            if not free:
                raise BadInput("nothing would be fitted; leave at least one parameter ticked")
            self._desk.change(free=free)
        finally:
            self._show()

    def _show(self) -> None:
        """The rows as the project has them."""
        if self._sliders is not None:
            self._known = self._ends()
            self._sliders.show(self._rows())

    def _moved(self, name: str, value: float, done: bool) -> None:
        """A slider is elsewhere; what is kept is where it was let go."""
        self._values = {**self._values, name: value}
        self._ask()
        if not done:
            return
        kept = {key: one for key, one in self._desk.project.values().items() if key != name}
        try:
            self._desk.change(kept if value == self._parameter(name)["start"] else {**kept, name: value})
        finally:
            self._show()

    def _parameter(self, name: str) -> Mapping[str, Any]:
        """As the model has it."""
        return next(one for one in (self._desk.model or {})["parameters"] if one["name"] == name)

    def _ask(self) -> None:
        self._moves += 1
        if not self._asking:
            self._asking = True
            background_tasks.create(self._follow())

    async def _follow(self) -> None:
        """The last move wins: those that came while one was answered are left out."""
        try:
            while self._shown < self._moves and self._sliders is not None:
                move = self._moves
                await self._answer(move)
                self._shown = move
        finally:
            self._asking = False

    async def _answer(self, move: int) -> None:
        try:
            own = {row["name"]: row["start"] for row in self._rows()}
            other = {name: value for name, value in self._values.items() if value != own[name]}
            asked = self._desk.runner.worker.ask("curves", self.number, other)
            found = await asyncio.wrap_future(asked)
        except (BadInput, Ended) as error:
            self._state.set_text(str(error) or "The process that simulates broke down; move the slider again.")
            return
        if self._sliders is None:
            return
        rms = zip(found["names"], found["rms"], strict=True)
        self._state.set_text("Residual over noise: " + ", ".join(f"{name} {value:.3g}" for name, value in rms))
        figure = followed_overlay(found).figure()
        if self._chart is None:
            with self._place:
                self._chart = Chart(figure, "Measured and simulated", height=70 + 170 * len(found["names"]))
        else:
            lines = [k for k, one in enumerate(figure["data"]) if one["legendgroup"] != "measured"]
            self._chart.follow([figure["data"][k]["y"] for k in lines], lines, move)


def _fitted_now(desk: Desk) -> dict[str, float]:
    """Parameters of the model as it is now, with what was added -> fitted value; none where nothing was fitted."""
    added = desk.project.settings().added
    answer = desk.answers.with_effects(added)
    estimates = () if answer is None else current(answer, added)["estimates"]
    return {one["name"]: one["value"] for one in estimates if "@" not in one["name"]}
