"""Page 2: logs made ready: what to keep and to cut, steps in a list, what was logged thin behind what they make."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from pysim.app.description import moved, put_steps, read_description
from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.pages.common import nothing, record_chart
from pysim.app.pages.data import change
from pysim.app.parts import Choice, Entry, box, button, card, head, text
from pysim.app.records import measured_overlay
from pysim.io import counted
from pysim.io.prepare import call, step_of, values_of
from pysim.io.toml_section import Section
from pysim.present.data_check.words import cures, sentence
from pysim.types import BadInput, Dataset

_ALL_SIGNALS, _ALL_INPUTS, _ALL_LOGS = "all signals", "all inputs", "all logs"  # choices that name none
# What can be added to the list: word of the step, field of its number, and the number's unit or meaning.
_KINDS: Mapping[str, tuple[str, str, str]] = {
    "turn the sign": ("flip", "", ""),
    "add an offset": ("scale", "offset", "in the signal's unit"),
    "multiply": ("scale", "factor", "factor"),
    "shift in time": ("delay", "seconds", "s, later"),
    "low pass": ("lowpass", "hz", "Hz"),
    "resample": ("resample", "hz", "samples a second"),
    "fill gaps": ("fill_gaps", "longest", "longest gap, s"),
    "take out outliers": ("drop_outliers", "sigmas", "standard deviations"),
    "take off the mean": ("detrend", "", ""),
}
_OF_LOGS = ("flip", "scale")  # steps that may change some logs alone
_ONE = ("scale", "delay")  # steps that name one signal; below, those that name any
_SOME = ("flip", "lowpass", "drop_outliers", "detrend", "fill_gaps")


def prepare_page(desk: Desk) -> None:
    """Logs and steps."""
    view = _View(desk)
    head("Prepare", "Make the logs ready. Each step stands in dataset.toml, so Python and the command line do it too.")
    live(lambda: (desk.version, view.log), view.lights, "gap")
    live(lambda: (desk.version, view.log), view.look, "gap")
    with box("two"):
        live(lambda: desk.version, view.steps, "gap")
        live(lambda: (desk.version, view.kind), view.adder, "gap")


class _View:
    """What one tab looks at: a log, the window of it, and the step that is being made."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self.log, self.kind = 0, next(iter(_KINDS))
        self._window: tuple[float, float] | None = None
        self._signal, self._number, self._of = _ALL_SIGNALS, "", _ALL_LOGS
        self._said: tuple[object, str] = None, ""  # data that were checked with the model, and the answer

    def lights(self) -> None:
        """A light per log, and what cures what was found."""
        check = self._desk.check
        if check is None or not check.dataset.logs():
            nothing("No logs yet", "Drop logs on the page Data.")
            return
        with card("Logs"), box("tight"):
            off = self._desk.model_busy or self._desk.runner.running is not None or self._desk.model is None
            words = "Name a model, and wait until nothing runs" if off else ""
            with box("row"):
                button("Check signs and units with the model", self._checked, "small", off=words)
                said = self._said[1] if self._said[0] is self._desk.loaded else "Signs and units are not checked yet"
                text("span", said, "small")
            for k, log in enumerate(check.dataset.logs()):
                found = [one for one in check.findings if one.source == log.source]
                with box("row").mark(log.source):
                    light = "bad" if any(one.cure for one in found) else "" if found else "good"
                    text("span", {"bad": "✗ mend", "": "? look", "good": "✓ ready"}[light], f"chip {light}")
                    button(log.source, partial(self._look_at, k), "small" if k != self.log else "small main")
                    text("span", "; ".join(map(sentence, found)), "small")
                    for step in cures(found):
                        button(call(step), partial(self._insert, values_of(step)), "small")

    async def _checked(self) -> None:
        await self._desk.check_with_model()
        found = self._desk.check.findings if self._desk.check else ()
        words = f"{counted(len(found), 'finding')} below" if found else "signs and units fit the model"
        self._said = self._desk.loaded, f"Checked: {words}"
        self._desk.changed()

    def _look_at(self, number: int) -> None:
        self.log, self._window = number, None

    def look(self) -> None:
        """The log that was picked, as it was logged and as the steps make it."""
        check = self._desk.check
        if check is None or not check.dataset.logs():
            return
        logs = check.dataset.logs()
        self.log = min(self.log, len(logs) - 1)
        log = logs[self.log]
        overlay = measured_overlay(log, self._desk.raw_of(log))
        with card():
            with box("row end"):
                text("h2", log.source)
                with box("row"):
                    self._told = text("span", "", "small mono")
                    button("Keep this stretch", partial(self._stretch, "trim"), "small")
                    button("Cut it out", partial(self._stretch, "exclude"), "small")
            text("p", "Drag over a stretch to zoom in, then keep it or cut it out. Double click shows all.", "small")
            label, height = f"{log.source} as it was logged and as it is prepared", 80 + 130 * len(overlay.names)
            record_chart(overlay, "prepared", self.log, label, height, self._zoomed)
        self._zoomed(self._window)

    def _zoomed(self, window: tuple[float, float] | None) -> None:
        self._window = window
        self._told.set_text("the whole log" if window is None else f"{window[0]:.4g} to {window[1]:.4g} s")

    def _stretch(self, word: str) -> None:
        if self._window is None:
            raise BadInput("no stretch is chosen; drag over a part of the figure first")
        ends = dict(zip(("start", "stop"), (float(f"{end:.6g}") for end in self._window), strict=True))
        name = self._shown.logs()[self.log].source
        self._insert({"step": word, **({"logs": [name]} if word == "trim" else {"log": name}), **ends})
        self._window = None

    def _content(self) -> list[dict[str, Any]]:
        """Steps as dataset.toml has them, those that are switched off too."""
        path = self._desk.project.description
        return list(read_description(path)["dataset"].get("preparation", [])) if path.is_file() else []

    def _insert(self, step: Mapping[str, Any]) -> None:
        change(self._desk, lambda content: put_steps(content, [*self._content(), dict(step)]))

    def steps(self) -> None:
        """The chain: switch off, reorder, remove."""
        if self._desk.check is None and not self._content():
            return
        chain = self._content()
        with card("Steps, in this order"):
            if not chain:
                text("p", "None yet: the logs are taken as they are.", "small")
            for k, one in enumerate(chain):
                with box("row step").mark(_typed(one)):
                    Entry(f"step {k + 1} is done", not one.get("off"), partial(self._turn, k), "type=checkbox")
                    text("span", f"{k + 1}. {_typed(one)}", "mono dim" if one.get("off") else "mono")
                    for words, by, end in (("↑", -1, 0), ("↓", 1, len(chain) - 1)):
                        off = "Nothing lies beyond" if k == end else ""
                        label = f"move step {k + 1} {'up' if by < 0 else 'down'}"
                        button(words, partial(self._move, k, by), "small quiet", off=off, label=label)
                    button("Remove", partial(self._move, k, 0), "small quiet", label=f"remove step {k + 1}")

    def _turn(self, number: int, on: bool) -> None:
        chain = self._content()
        chain[number] = {**chain[number], "off": not on}
        change(self._desk, lambda content: put_steps(content, chain))

    def _move(self, number: int, by: int) -> None:
        change(self._desk, lambda content: put_steps(content, moved(self._content(), number, by)))

    def adder(self) -> None:
        """One more step."""
        check = self._desk.check
        if check is None:
            return
        word, field, unit = _KINDS[self.kind]
        with card("Add a step"):
            with box("form").style("grid-template-columns: 1fr 1fr"):
                text("span", "do", "head")
                Choice("kind of step", list(_KINDS), self.kind, partial(self._set, "kind"))
                if word in (*_ONE, *_SOME):
                    names = [signal.name for signal in check.dataset.signals]
                    options = [_ALL_INPUTS if word == "fill_gaps" else _ALL_SIGNALS, *names] if word in _SOME else names
                    self._signal = self._signal if self._signal in options else options[0]
                    text("span", "to", "head")
                    Choice("signal of the step", options, self._signal, partial(self._set, "_signal"))
                if word in _OF_LOGS:
                    logs = [_ALL_LOGS, *(log.source for log in check.dataset.logs())]
                    self._of = self._of if self._of in logs else _ALL_LOGS
                    text("span", "in", "head")
                    Choice("logs of the step", logs, self._of, partial(self._set, "_of"))
                if field:
                    text("span", unit, "head")
                    Entry("number of the step", self._number, partial(self._set, "_number"), "type=number step=any")
            button("Add", self._made, "main")

    def _set(self, key: str, value: str) -> None:
        setattr(self, key, value)

    def _made(self) -> None:
        word, field, unit = _KINDS[self.kind]
        step: dict[str, Any] = {"step": word}
        if word in _ONE:
            step["signal"] = self._signal
        elif word in _SOME and (self._signal not in (_ALL_SIGNALS, _ALL_INPUTS) or word == "flip"):
            step["signals"] = [s.name for s in self._shown.signals] if self._signal == _ALL_SIGNALS else [self._signal]
        if word in _OF_LOGS and self._of != _ALL_LOGS:
            step["logs"] = [self._of]
        if field:
            try:
                step[field] = float(self._number)
            except ValueError:
                raise BadInput(f"{self.kind}: the field '{unit}' has no number yet; write one") from None
        self._insert(step)

    @property
    def _shown(self) -> Dataset:
        assert self._desk.check is not None
        return self._desk.check.dataset


def _typed(section: Mapping[str, Any]) -> str:
    """A step as it is typed in Python."""
    return call(step_of(Section("", dict(section))))
