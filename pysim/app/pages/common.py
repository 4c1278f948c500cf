"""What several pages do alike."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from nicegui import ui

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.disk import disk_trouble
from pysim.app.jobs import FAILED, STOPPED, Work
from pysim.app.parts import box, button, note, say, text
from pysim.types import BadInput


def attempt(action: Callable[[], object]) -> bool:
    """Do what a button says; what cannot be is said in a sentence."""
    try:
        action()
    except BadInput as error:
        say(str(error), bad=True)
        return False
    except OSError as error:
        say(str(disk_trouble(error)), bad=True)
        return False
    return True


def start(desk: Desk, work: Callable[[], Work], *, then: str = "") -> None:
    """Start a piece of work, and go to a page."""
    if attempt(lambda: desk.start(work())) and then:
        ui.navigate.to(then)


def busy(desk: Desk) -> str:
    """Why nothing can be started now; "" where something can."""
    if desk.runner.running is not None:
        return f"{desk.runner.running.work.title} is running"
    if desk.doing:
        return desk.doing
    check = desk.loaded.check if desk.loaded else None
    if check is None or not check.records:
        return "Drop a data set first"
    if desk.loaded is not None and desk.loaded.refused:
        return "Some logs were refused; mend them or leave them out on the page Data"
    if desk.loaded is not None and desk.loaded.empty_cells:
        return "Some cells are empty; fill them, or cut them out, on the page Prepare"
    if not desk.project.settings().model:
        return "Name a model first"
    return "The model is being built" if desk.model_busy else desk.model_trouble and "The model cannot be used"


def ended(desk: Desk) -> None:
    """What became of the last piece of work, where that needs words; how to go on."""
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
                    button(words, lambda: attempt(lambda: desk.keep(best["values"])), "small", off=busy(desk))
                button("Go on", lambda: attempt(lambda: desk.start(job.work)), "small", off=busy(desk))


def doubts(answer: Answer) -> None:
    """A banner in red that says why the last fit is not to be believed; nothing where it is."""
    found = answer.data.get("warnings", {}).get(answer.last["step"], ())  # none in answers of an earlier version
    if found:
        with box("note bad").props('role="alert"'):
            text("b", "Do not believe this fit")
            for line in dict.fromkeys(map(str, found)):
                text("p", line)


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
    field = ui.element("input").props(f"type=number step=any {'' if signed else 'min=0'}")
    field._props["aria-label"], field._props["value"] = label, "" if value is None else value

    def changed(written: str) -> None:
        try:
            put(float(written) if written else None)
        except ValueError:
            say(f"{label}: {written!r} is no number; write one, or leave it empty", bad=True)

    field.on("change", lambda event: changed(str(event.args)), js_handler="(e) => emit(e.target.value)")
