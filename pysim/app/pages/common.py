"""What several pages do alike."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any
from urllib.parse import quote

from nicegui import ui

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.disk import disk_trouble
from pysim.app.jobs import FAILED, STOPPED, adding
from pysim.app.parts import Chart, Entry, box, button, note, say, text
from pysim.app.records import MOST, Overlay
from pysim.app.worker import Ended
from pysim.types import UNITS, BadInput, conversion


def refused(error: Exception) -> None:
    """Say what cannot be done, whatever asked for it."""
    if isinstance(error, BadInput | OSError | Ended):
        told = disk_trouble(error) if isinstance(error, OSError) else error
        say(str(told) or "the process that did it broke down; press again", bad=True)


def start_button(desk: Desk, words: str, command: str, kind: str = "", *, then: str = "") -> None:
    """A button that starts a piece of work, by its name in `works`, and goes to a page."""

    def begin() -> None:
        desk.start(desk.work(command))
        if then:
            ui.navigate.to(then)

    button(words, begin, kind, off=busy(desk))


def busy(desk: Desk, here: str = "") -> str:
    """Why nothing can be started now, as the page `here` says it; "" where something can."""
    data, prepare = ("" if here == page else f" on the page {page}" for page in ("Data", "Prepare"))
    if desk.runner.running is not None:
        return f"Wait until {desk.runner.running.work.title} has ended"
    if desk.doing:
        return desk.doing
    if desk.check is None or not desk.check.records:
        bare = desk.project.data.is_dir() and not desk.project.description.is_file()
        first = "Say" if desk.project.settings().model else "Use a model, then say"
        return (f"{first} what the columns of the logs are" if bare else "Drop a data set") + data
    if desk.loaded is not None and desk.loaded.refused:
        return "Mend the logs that were refused, or leave them out" + data
    if desk.loaded is not None and desk.loaded.empty_cells:
        return "Fill the cells that are empty, or cut them out" + prepare
    if not desk.project.settings().model:
        return "Name a model first"
    if unfit(desk):
        return "Let every signal be a variable of the model, or leave it out" + data
    return (
        "Wait until the model is built"
        if desk.model_busy
        else desk.model_trouble and "Mend the model and drop it again, or name another one"
    )


def unfit(desk: Desk) -> list[str]:
    """What keeps signals from being variables of the model."""
    variables = {} if desk.model is None else {str(one[0]): str(one[2]) for one in desk.model["variables"]}
    units, found = {*variables.values()} - {"1", ""}, []  # a model without any counts in those of the data
    for signal in desk.check.dataset.signals if desk.check and variables else ():
        name, own, unit = signal.variable, variables.get(signal.variable), signal.unit
        if own is None:
            found.append(f"The model has no variable {name}; choose another one for {signal.name}, or leave it out.")
        elif units and own in UNITS and conversion(unit, own) is None:
            cure = f"choose {own} as its unit, and write as its factor how many {own} are 1 {unit}"
            found.append(f"{signal.name} is in {unit}, {name} of the model in {own}; {cure}.")
    return found


def ended(desk: Desk) -> None:
    """What became of the last piece of work, where that needs words; how to go on."""
    aside(desk)
    if desk.trouble:
        note(desk.trouble, "bad")
    for work in desk.answers.unreadable:
        note(f'"{work.title}" was done by another version, and its result cannot be read here; run it again.', "bad")
    job = desk.last if desk.last is not None and desk.last.state in (FAILED, STOPPED) else None
    job = job or (desk.unfinished() if desk.runner.running is None else None)
    if job is None or desk.runner.running is not None:
        return
    if job.state == FAILED:
        note(f"{job.work.title} failed: {job.message}", "bad")
    else:
        with box("note row end"):
            text("span", f"{job.work.title} was stopped; what it had found is kept.")
            with box("row"):
                if (best := job.best) is not None:
                    words = f"Keep its best values ({best['error']:.3g} × noise)"
                    button(words, lambda: desk.keep(best["values"]), "small", off=busy(desk))
                button("Go on", lambda: desk.start(job.work), "small", off=busy(desk))


def aside(desk: Desk) -> None:
    """What became of results that belong to other choices, and a button that makes them of these."""
    if desk.put_aside and desk.runner.running is None:
        added = desk.project.settings().added
        with box("note row end"):
            text("span", aside_words(desk))
            again = lambda: desk.start(adding(desk.project, added) if added else desk.work("compare"))  # noqa: E731
            button("Fit it again", again, "small", off=busy(desk))


def aside_words(desk: Desk) -> str:
    """Why there are no results."""
    back = "Redo" if desk.history.future else "Undo"
    return f"The results belonged to what was chosen before. Changed: {desk.put_aside}. {back} brings them back."


def doubts(answer: Answer) -> None:
    """A banner in red that says why the last fit is not to be believed; nothing where it is."""
    found = answer.data.get("warnings", {}).get(answer.last["step"], ())  # none in answers of an earlier version
    if found:
        with box("note bad").props('role="alert"'):
            text("b", "Do not believe this fit")
            for line in dict.fromkeys(map(str, found)):
                text("p", line)


def played(answer: Answer) -> None:
    """What a bench plays for the next test, to take away."""
    link = text("a", "Download its commands as CSV", "plain")
    link._props["href"], link._props["download"] = f"/commands/{quote(answer.folder.name)}", "next_test.zip"


def nothing(title: str, words: str) -> None:
    """Where there is nothing to show yet."""
    with box("card empty"):
        text("b", title)
        text("span", words)


def segments(options: list[tuple[str, str]], chosen: str, pick: Callable[[str], None], label: str) -> None:
    """A few choices of which one is on."""
    with box("seg").props('role="group"') as group:
        group._props["aria-label"] = label
        for key, words in options:
            one = button(words, partial(pick, key), "on" if key == chosen else "")
            one._props["aria-pressed"] = "true" if key == chosen else "false"


def amount(value: Any, put: Callable[[float | None], Any], label: str, *, signed: bool = False) -> None:
    """A number that may be left empty."""

    def changed(written: str) -> None:
        try:
            value = float(written) if written else None
        except ValueError:
            say(f"{label}: {written!r} is no number; write one, or leave it empty", bad=True)
        else:
            put(value)  # what it refuses it says itself

    props = f"type=number step=any {'' if signed else 'min=0'}"
    Entry(label, "" if value is None else value, changed, props)


def record_chart(
    overlay: Overlay, of: str, number: int, label: str, height: int,
    on_range: Callable[[tuple[float, float] | None], Any] | None = None,
) -> None:  # fmt: skip
    """A log over time, whose samples are fetched by window from the address /series."""
    place, traces = f"/series?of={of}&record={number}", list(range(len(overlay.lines)))
    series = {"url": place, "traces": traces, "span": overlay.span, "most": MOST}
    Chart(overlay.figure(), label, height=height, series=series, on_range=on_range)
