"""Where one begins: examples to click, projects that were opened lately."""

from __future__ import annotations

from functools import partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from nicegui import background_tasks, ui

from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.parts import box, button, card, head, text
from pysim.app.recent import recent

_EXAMPLES = {
    "pump": ("pump", "A variable displacement pump whose swash plate follows a command."),
    "drive": ("positioning drive", "A motor turns a spindle, the spindle moves a carriage. Two controllers hold it."),
    "heater": ("heater", "A plate heats a block. Both temperatures are logged, above that of the room."),
}


def start_page(desk: Desk) -> None:
    """Examples and projects."""
    head("Start", "Find out what a model lacks. Begin with an example, or with logs of your own on the page Data.")
    live(lambda: desk.version, lambda: examples(desk), "gap")
    live(lambda: desk.version, lambda: projects(desk), "gap")
    text("p", f"Version {_version()}", "small")


def examples(desk: Desk) -> None:
    """A click makes logs and model of a machine, and holds them beside each other."""
    off = desk.doing or ("Wait until the running work has ended" if desk.runner.running else "")
    with card("Examples"):
        text("p", "Simulated machines, each with something that its model lacks. Can you find it?", "small")
        with box("files"):
            for name, (title, about) in _EXAMPLES.items():
                with box("file"):
                    text("h3", title.capitalize())
                    text("p", about, "small")
                    button(f"Open the {title}", partial(_open_example, desk, name), off=off)


def _open_example(desk: Desk, name: str) -> None:
    """In this project where it is empty, else in one of its own beside it."""
    if not desk.project.empty:
        desk.open(_free(desk.project.folder.parent, f"{name}-example"))
    background_tasks.create(desk.example(name))
    ui.navigate.to("/compare")


def _free(folder: Path, name: str) -> Path:
    """A place in a folder where nothing is yet."""
    tried = 1
    while (place := folder / (name if tried == 1 else f"{name}-{tried}")).exists():
        tried += 1
    return place


def projects(desk: Desk) -> None:
    """What was opened lately, this one left out."""
    others = [folder for folder in recent() if folder != desk.project.folder]
    if not others:
        return
    with card("Recent projects"), box("tight"):
        for folder in others:
            with box("row").mark(folder.name):
                button(folder.name, partial(_open, desk, folder), "small")
                text("span", str(folder.parent), "small mono")


def _open(desk: Desk, folder: Path) -> None:
    desk.open(folder)
    background_tasks.create(desk.read())
    ui.navigate.to("/")


def _version() -> str:
    try:
        return version("hydraulic-test-bench")
    except PackageNotFoundError:
        return "of a checkout"
