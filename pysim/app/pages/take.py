"""Page 6: what to take away: the extended class, its FMU, parameters, the report, and the commands that do it again."""

from __future__ import annotations

from collections.abc import Mapping
from urllib.parse import quote

from nicegui import ui

from pysim.app.answers import Answer
from pysim.app.desk import Desk
from pysim.app.live import live
from pysim.app.pages.common import aside, nothing, played
from pysim.app.parts import box, button, card, head, say, text
from pysim.workflow import command_line

_FILES = (
    ("modelica", "Modelica class", "Yours extended, with the fitted values, and what it needs. Your files stay."),
    ("fmu", "FMU", "The same class compiled; its defaults are the fitted values."),
    ("parameters", "Parameters", "The fitted values as lines NAME = VALUE, for --parameters."),
    ("report", "Report", "The whole answer on one page. Opening it for the first time draws it, in some seconds."),
    ("plan", "Next test", "A plan of the test that separates what these measurements do not, for pysim bench."),
)


def take_page(desk: Desk) -> None:
    """Files and commands."""
    live(lambda: desk.version, lambda: _build(desk), "gap")


def _build(desk: Desk) -> None:
    head("Take it away", "All of it lies in the project's folder; the commands make it again.")
    added = desk.project.settings().added
    answer = desk.answers.with_effects(added)
    aside(desk)
    if answer is None and not desk.put_aside:
        nothing("Nothing to take yet", "Compare, find what is missing, or try a candidate first.")
    elif answer is not None:
        if added:
            text("p", f"The model with {' and '.join(added)}.", "statement")
        _files(answer)
    with card("Commands"):
        text("p", f"In the folder {desk.project.folder}; you can continue a stopped job on the command line.", "small")
        lines = commands(desk)
        text("pre", lines, "code").props('tabindex="0"')
        button("Copy", lambda: _copy(lines), "small")
    if desk.project.settings().model and desk.project.description.is_file():
        with card("In Python"):
            text("p", "The same steps as a notebook, to run in the project's folder.", "small")
            text("a", "Download the notebook", "plain").props('href="/notebook" download="workbench.ipynb"')


def commands(desk: Desk) -> str:
    """The lines that make every result again, in the order in which they were made."""
    done = [one.job.work.words for one in reversed(desk.answers.all)]
    return "\n".join(command_line(words, desk.project.folder) for words in done or [("data", "check", "data")])


def classes(files: Mapping[str, str]) -> list[str]:
    """Where the extended class is, and the files that it needs."""
    return sorted((one for one in files.values() if one.endswith(".mo")), key=lambda one: one != files.get("modelica"))


def _files(answer: Answer) -> None:
    files = {name: str(path) for name, path in answer.data["files"].items()}
    with box("files"):
        for key, title, about in _FILES:
            paths = classes(files) if key == "modelica" else [files[key]] if key in files else []
            if paths:
                with box("file"):
                    text("h2", title)
                    text("p", about, "small")
                    for path in paths:
                        text("span", path, "mono path")
                        link = text("a", "Open" if key == "report" else "Download", "plain")
                        link._props["href"] = f"/result/{quote(answer.folder.name)}/{quote(path)}"
                        link._props["target" if key == "report" else "download"] = "_blank" if key == "report" else ""
                    if key == "plan":
                        played(answer)
    for source in (answer.folder / path for path in classes(files)):
        if source.is_file():
            with card(source.stem):
                text("pre", source.read_text(encoding="utf-8"), "code").props('tabindex="0"')


def _copy(lines: str) -> None:
    ui.clipboard.write(lines)
    say("Copied")
