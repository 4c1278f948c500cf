"""A law that is typed for a slot: drawn over the learned curve, its parameters as rows, a mistake at its place."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from nicegui import background_tasks, run, ui

from pysim.app.desk import Desk
from pysim.app.live import live, news
from pysim.app.pages.common import amount, busy
from pysim.app.parts import Chart, Entry, box, button, text
from pysim.io import shown_unit
from pysim.present.diagnosis.figures.law import law_chart
from pysim.types import BadInput
from pysim.workflow import LawPlace, typed_law
from pysim.workflow.own_law import Range

_NUMBERS = {"low": "lowest", "usual": "usual", "high": "highest"}  # fields of a range


class Writing:
    """One tab's law for one slot."""

    def __init__(self, desk: Desk, slot: str) -> None:
        self._desk, self._slot = desk, slot
        self._law, self._name, self._trouble, self._wrong = "", f"my.{slot}", "", -1
        self._ranges: dict[str, Range] = {}  # as they are shown
        self._chosen: dict[str, Range] = {}  # by the user
        self._version = self._asked = 0
        self._learned: Mapping[str, Any] | None = None
        self._curve: list[float] | None = None  # of the law, beside the learned one
        self._followed = True  # whether usual values come from the learned curve

    def show(self, learned: Mapping[str, Any] | None) -> None:
        """As it is typed so far.

        Args:
            learned: the law that was learned there, if one was; drawn.
        """
        is_new, self._learned = learned != self._learned, learned
        self._chart = None
        if learned is not None:
            self._over = learned["depends_on"] + (f" times {learned['factor']}" if learned["factor"] else "")
            explains = f"A curve over {self._over} explains {100 * learned['share']:.1f} % of the misfit."
            text("p", f"{explains} The band holds 95 percent.", "small")
            if len(learned["shape"]["argument"]) > 1:
                self._chart = Chart(*self._figure(), height=280)
        project, model = self._desk.project, self._desk.model or {}
        try:
            libraries = [project.folder / one for one in project.settings().libraries]
            self._place = LawPlace.of(str(model["class"]), self._slot, libraries)
        except (BadInput, KeyError):
            return
        slot = self._place.slot
        text("h3", f"Write a law for {slot.name}")
        words = ", ".join(f"{name} ({self._place.units.get(name) or 'any unit'})" for name in (*slot.sees, "time"))
        gives = ", ".join(f"{name} ({self._place.units.get(name) or 'any unit'})" for name in slot.gives)
        text("p", f"It gives {gives}. It may use {words}. Any other name becomes a parameter.", "small")
        units = dict.fromkeys(learned["shape"][name] for name in ("argument_unit", "unit")) if learned else {}
        read = {unit: shown_unit(unit) for unit in units if shown_unit(unit)[1] != 1.0}
        told = ", ".join(f"1 {unit} = {factor:.4g} {shown}" for unit, (shown, factor) in read.items())
        if told:
            text("p", f"The curve is drawn in other units than a law is written in: {told}.", "small")
        props = "rows=2 spellcheck=false autocomplete=off"
        field = Entry(f"law for {slot.name}", self._law, self._typed, props, tag="textarea", each=True)
        field.classes("field mono")._props["placeholder"] = "-F_c*tanh({0}/{0}_0)".format((slot.sees or ("time",))[-1])
        live(lambda: self._version, self._rows, "tight")
        if is_new and self._law:
            self._typed(self._law)

    def _figure(self) -> tuple[Mapping[str, Any], str]:
        """The curves, and what they are."""
        assert self._learned is not None
        over = f"Learned law at {self._slot} over {self._learned['depends_on']} with its 95 percent band"
        words = over if self._curve is None else f"Learned law, and the one written: {self._law}"
        return law_chart(self._learned, self._curve), words

    def _typed(self, law: str) -> None:
        """The last letter wins: those that came while one text was read are left out."""
        self._law = law
        self._asked += 1
        if self._asked == self._version + 1:
            background_tasks.create(self._read())

    async def _read(self) -> None:
        while self._version < self._asked:
            asked, law = self._asked, self._law
            self._trouble, self._wrong, self._curve = "", -1, None
            try:
                found = await run.io_bound(typed_law, law, self._place, self._learned, self._chosen)
                if found is None:  # the server ends
                    return
                self._ranges = {name: self._chosen.get(name, one) for name, one in found.ranges.items()}
                self._followed = found.curve is not None
                self._curve = None if found.curve is None else found.curve.tolist()
            except BadInput as error:
                self._trouble = getattr(error, "what", str(error)) if law.strip() else ""
                self._wrong = getattr(error, "place", -1)
            if self._chart is not None:
                self._chart.show(*self._figure())
            self._version = asked
            news.emit()

    def _rows(self) -> None:
        """What is wrong, or the parameters and the button that adds the law."""
        if self._trouble:
            with box("note bad").props('role="alert"'):
                with box("mono", "p"):
                    text("span", self._law[: self._wrong] if self._wrong > 0 else "")
                    text("mark", self._law[max(self._wrong, 0) :] or " ")
                text("p", self._trouble)
        elif self._law.strip():
            if self._ranges:
                with box("form").style("grid-template-columns: 1fr 1fr 1fr 1fr 0.8fr"):
                    for words in ("parameter", *_NUMBERS.values(), "unit"):
                        text("span", words, "head")
                    for name in self._ranges:
                        self._row(name)
                if not self._followed:
                    words = "No learned curve gives these values"
                    if self._chart is not None:
                        words = f"This law is not drawn over the learned curve, which is over {self._over} alone"
                    text("p", f"{words}. Usual values are guesses: write those that you expect.", "note")
            with box("row"):
                named = partial(setattr, self, "_name")
                Entry("name of the law", self._name, named).classes("field").style("width: 180px")
                button("Add and refit", self._add, "main", off=busy(self._desk))
                text("span", "The name of a law of yours changes that law.", "small")

    def _row(self, name: str) -> None:
        text("span", name, "mono")
        for key, words in _NUMBERS.items():
            value = float(f"{getattr(self._ranges[name], key):.4g}")
            amount(value, partial(self._choose, name, key), f"{words} of {name}", signed=True)
        Entry(f"unit of {name}", self._ranges[name].unit, lambda unit: self._choose(name, "unit", unit.strip()))

    def _choose(self, name: str, key: str, value: Any) -> None:
        """A range that the user has set stays while the law is written on."""
        if value is not None:
            self._ranges[name] = self._chosen[name] = self._ranges[name]._replace(**{key: value})
        self._typed(self._law)

    async def _add(self) -> None:
        await self._desk.add_law(self._name.strip(), self._place, self._law, self._ranges)
        ui.navigate.to("/add")
