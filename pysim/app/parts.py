"""What the page is made of: texts, buttons, cards, tables, figures. Every name and text is shown as text."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import nicegui.elements.plotly  # registers the library that chart.js loads
from nicegui import Client, json, ui
from nicegui.element import Element
from nicegui.elements.mixins.text_element import TextElement

from pysim.app.flowchart import CONFIG, flowchart
from pysim.app.live import news
from pysim.app.upload import Limits
from pysim.io import shown_value

_STATIC = Path(__file__).parent / "static"

assert nicegui.elements.plotly
_errors: WeakKeyDictionary[Client, ui.notification] = WeakKeyDictionary()  # that tabs show


class Chart(Element, component=str(_STATIC / "chart.js")):
    """A chart of `pysim.present`.

    Args:
        figure: its data and layout.
        label: what is to be seen, for those who cannot see it.
        series: where the samples of a window come from: `url`, `traces`, `span` (s, s) and `most` points.
        on_pick: receives the place that was clicked: x, y, curve, index.
        on_range: receives the window that is shown, None where that is all; of a chart with `series`.
        height: px.
    """

    follows = True

    def __init__(
        self, figure: Mapping[str, Any], label: str, *, series: Mapping[str, Any] | None = None,
        on_pick: Callable[[dict[str, Any]], Any] | None = None,
        on_range: Callable[[tuple[float, float] | None], Any] | None = None, height: int = 360,
    ) -> None:  # fmt: skip
        super().__init__()
        self._props["series"] = series
        self.show(figure, label)
        self.style(f"height: {height}px")
        if on_pick is not None:
            self.on("pick", lambda event: on_pick(event.args))
        if on_range is not None:
            self.on("range", lambda event: on_range(event.args and (float(event.args[0]), float(event.args[1]))))

    def show(self, figure: Mapping[str, Any], label: str) -> None:
        """Another figure in its place."""
        self._props["figure"] = json.dumps(figure)  # NiceGUI would look at every number of it
        self._props["label"] = label
        self.update()

    def follow(self, ys: Sequence[Sequence[float]], traces: Sequence[int], number: int) -> None:
        """Other heights of some lines; the last of several moves is the one that is drawn."""
        self.run_method("follow", ys, traces, number)


class Sliders(Element, component=str(_STATIC / "sliders.js")):
    """Parameters with a number, a slider and a tick each. `show` answers each of what was given, but not a slide.

    Args:
        rows: `name`, `about`, `value`, `now` (fitted, or None), `unit`, `min`, `max`, `slides` (it has both), `fitted`.
        on_move: gets the name, the value, and whether it was let go.
        on_fit: gets the name, and whether a fit may change it.
        on_bound: gets the name, "min" or "max", and the value.
    """

    follows = True

    def __init__(
        self, rows: Sequence[Mapping[str, Any]], on_move: Callable[[str, float, bool], Any],
        on_fit: Callable[[str, bool], Any], on_bound: Callable[[str, str, float], Any],
    ) -> None:  # fmt: skip
        def told(put: Callable[..., Any], *given: Any, heard: bool = True) -> None:
            self._props["heard"] += heard
            put(*given)

        super().__init__()
        self._props["rows"], self._props["heard"] = list(rows), 0
        self.on("move", lambda event: told(on_move, *_of(event, "name", "value", "done"), heard=event.args["done"]))
        self.on("fit", lambda event: told(on_fit, *_of(event, "name", "on")))
        self.on("bound", lambda event: told(on_bound, *_of(event, "name", "end", "value")))

    def show(self, rows: Sequence[Mapping[str, Any]]) -> None:
        """Other values."""
        self._props["rows"] = list(rows)
        self.update()


class Table(Element, component=str(_STATIC / "table.js")):
    """Rows of texts.

    Args:
        columns: title and kind: "words", "number" or "tick".
        rows: cells: a text, a number, or `{"text", "value", "mark"}`; true or false below "tick".
        on_row: receives the row that was picked.
        on_tick: receives the row, the title of the column, and whether it is ticked.
    """

    follows = True

    def __init__(
        self, label: str, columns: Sequence[tuple[str, str]], rows: Sequence[Sequence[Any]], *,
        on_row: Callable[[int], Any] | None = None, on_tick: Callable[[int, str, bool], Any] | None = None,
        picked: int = -1, height: str = "",
    ) -> None:  # fmt: skip
        super().__init__()
        self._props["columns"] = [{"title": title, "kind": kind} for title, kind in columns]
        self._props["rows"], self._props["label"] = [list(row) for row in rows], label
        self._props["picked"], self._props["height"], self._props["pickable"] = picked, height, on_row is not None
        if on_row is not None:
            self.on("row", lambda event: on_row(int(event.args)))
        if on_tick is not None:
            self.on("tick", lambda event: on_tick(*_of(event, "row", "column", "on")))


def _of(event: Any, *names: str) -> list[Any]:
    return [event.args[name] for name in names]


def quantity(value: float | None, unit: str) -> dict[str, Any] | str:
    """A cell of a table, with its unit; empty where there is no value.

    Args:
        value: in an SI unit, "1" or "%", by which rows are sorted.
    """
    return "" if value is None else {"text": shown_value(value, unit), "value": value}


class Drawing(Element, component=str(_STATIC / "drawing.js")):
    """A flowchart; its places that can be picked are buttons, with the arrow keys between them.

    Args:
        label: what is to be seen.
        places: `name`, `rows` of its text, `kind` of its shape and look, `share` from 0 to 1 or None, `words` for those
            who cannot see it, and `pick`: whether it is a button.
        links: `source`, `target`, and `kind`: "to", "both" or "joint".
        on_pick: is given the name of the place.
        picked: name of a place.
    """

    def __init__(
        self, label: str, places: Sequence[Mapping[str, Any]], links: Sequence[Mapping[str, Any]], *,
        on_pick: Callable[[str], Any], picked: str,
    ) -> None:  # fmt: skip
        super().__init__()
        self._props["label"], self._props["picked"] = label, picked
        self._props["places"] = [{k: v for k, v in place.items() if k != "rows"} for place in places]
        self.on("pick", lambda event: on_pick(str(event.args)))
        with self:
            ui.mermaid(flowchart(places, links), config=CONFIG)

    def pick(self, name: str) -> None:
        """Mark another place."""
        self._props["picked"] = name
        self.update()


class _Field(Element):
    """What a user chooses or types there is shown, until what is built anew, once that was heard, says otherwise."""

    follows = True

    def _begin(self, value: object, put: Callable[[Any], Any]) -> None:
        def told(given: Any) -> None:
            self._props["value"] = given
            self._props["heard"] += 1
            self.update()
            news.emit()
            put(given)

        self._props["value"], self._props["heard"] = value, 0
        self.on("put", lambda event: told(event.args))


class Entry(_Field, component=str(_STATIC / "entry.js")):
    """A field; what is written there is handed over when it is left.

    Args:
        label: for those who cannot see it.
        put: receives what is written; of a box to tick, whether it is ticked.
        props: "type=checkbox" makes it a box to tick.
        tag: "input", or "textarea" for several lines.
        each: whether it is handed over with each letter.
    """

    def __init__(
        self, label: str, value: object, put: Callable[[Any], Any], props: str = "type=text", *, tag: str = "input",
        each: bool = False,
    ) -> None:  # fmt: skip
        super().__init__()
        self.props(props)
        self._props.update({"aria-label": label, "tag": tag, "each": each})
        self._begin(value, put)


class Choice(_Field, component=str(_STATIC / "choice.js")):
    """One of a list of texts.

    Args:
        label: for those who cannot see it.
        on_pick: receives the one that was chosen.
    """

    def __init__(self, label: str, options: Sequence[str], chosen: str, on_pick: Callable[[str], Any]) -> None:
        super().__init__()
        self._props["label"], self._props["options"] = label, list(options)
        self._begin(chosen, on_pick)


class Drop(Element, component=str(_STATIC / "drop.js")):
    """A place to drop files and folders on."""

    def __init__(self, title: str, hint: str, *, limits: Limits, on_text: Callable[[str, bool], Any]) -> None:
        super().__init__()
        self._props["title"], self._props["hint"] = title, hint
        self._props["bytes"], self._props["files"], self._props["limit"] = limits.size, limits.files, limits.words
        self.on("taken", lambda event: on_text(str(event.args), True))
        self.on("refused", lambda event: on_text(str(event.args), False))


def text(tag: str, words: str, kind: str = "") -> TextElement:
    """A paragraph, heading or word; never markup."""
    element = TextElement(tag=tag, text=words)
    return element.classes(kind) if kind else element


def box(kind: str, tag: str = "div") -> Element:
    """An element that holds others."""
    return ui.element(tag).classes(kind)


def button(words: str, action: Callable[[], Any], kind: str = "", *, off: str = "", label: str = "") -> TextElement:
    """A button.

    Args:
        kind: "main" for the one thing to do next, "quiet", or "".
        off: why it cannot be pressed now; shown beside the pointer.
        label: what it does, where its words alone do not say that.
    """
    element = text("button", words, f"button {kind}").props("type=button")
    if label:
        element._props["aria-label"] = label
    if off:
        element._props["disabled"] = True
        element._props["title"] = off

    def press() -> Any:
        _close_error()
        news.emit()
        return action()

    return element.on("click", press)


def head(title: str, lead: str = "") -> None:
    """Of a page."""
    text("h1", title)
    if lead:
        text("p", lead, "lead")


def card(title: str = "", kind: str = "") -> Element:
    """A part of a page with its title."""
    element = box(f"card {kind}", "section")
    if title:
        with element:
            text("h2", title)
    return element


def note(words: str, kind: str = "") -> None:
    """What a reader must know; kind is "bad", "good" or ""."""
    text("p", words, f"note {kind}").props("role=note")


def say(words: str, *, bad: bool = False) -> None:
    """A sentence that goes away by itself; an error stays until it is closed, or a button is pressed."""
    _close_error()
    if not bad:
        ui.notify(words, position="bottom-right", multi_line=True, type="positive", timeout=3500)
        return
    _errors[ui.context.client] = ui.notification(
        words, position="bottom-right", multi_line=True, type="negative", timeout=None, close_button="Close"
    )


def _close_error() -> None:
    """The error of this tab is of an earlier press."""
    shown = _errors.pop(ui.context.client, None)
    if shown is not None and not shown.is_deleted:
        shown.dismiss()


def curve(shown: Mapping[str, Any] | None) -> None:
    """A sketch of a law; only numbers go into the drawing, and what is drawn over what is a text.

    Args:
        shown: `curves`: x and y between -1 and 1, `words`, and `over_time`, as `pysim model --json` writes them.
    """
    curves, over_time = (shown["curves"], shown["over_time"]) if shown is not None else ((), False)
    main = len(curves) - 1 if over_time else len(curves) // 2
    lines = [f'<path class="axes" d="{"M4,26 H68" if over_time else "M4,26 H68 M36,4 V48"}"/>']
    for k, (xs, ys) in enumerate(curves):
        path = " L".join(f"{36 + 31 * float(x):.1f},{26 - 20 * float(y):.1f}" for x, y in zip(xs, ys, strict=True))
        lines.append(f'<path class="law{"" if k == main else " beside"}" d="M{path}"/>')
    svg = f'<svg viewBox="0 0 72 52" aria-hidden="true">{"".join(lines)}</svg>'
    place = ui.html(svg, sanitize=False).classes("sketch")
    if shown is not None:
        place._props["title"] = str(shown["words"])
