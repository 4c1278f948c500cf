"""Page 1: the data set and the model: what was read, what was refused and why, signals, noise, what is not fitted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from itertools import starmap
from typing import Any

from nicegui import background_tasks, ui

from pysim.app import description
from pysim.app.desk import Desk, Loaded
from pysim.app.live import live
from pysim.app.pages.bare import describe_form
from pysim.app.pages.common import amount, busy, ended, record_chart, start_button, unfit
from pysim.app.pages.start import examples, projects
from pysim.app.parts import Choice, Drop, Entry, Table, box, button, card, head, note, quantity, say, text
from pysim.app.records import measured_overlay
from pysim.identify.data_check import DataCheck, RecordCheck
from pysim.io import counted
from pysim.present.data_check.words import assumed_between_samples, not_compared, sentence, uses_words
from pysim.present.notes import NOT_FITTED, USES
from pysim.types import UNITS, BadInput, Record
from pysim.workflow import models_in

_NO_SLOTS = (
    "The class has no slots, so the page can fit it and show where it fails, but not add what is missing. A slot is a "
    "part that is replaceable and whose filling gives 0; docs/tutorials/own_model.md shows one."
)
_READY = (
    "Compare refits the model and shows where it fails. Find also tries every effect that fits. That takes seconds for "
    "a small model and minutes for a pump; it can be stopped and goes on later."
)
_TICKS = ("validate", "test")  # uses of a log that can be ticked
_NUMBERS = ("factor", "offset", "noise", "resolution")  # of a signal
MODELS = ("HydraulicTestBench.Pump.FreeGreyBox", "HydraulicTestBench.Pump.LockedGreyBox")


def data_page(desk: Desk) -> None:
    """Data and model."""
    preview: dict[str, int] = {}
    named: dict[str, str] = {}
    head("Data and model", "Drop what the bench has logged, name the model, and look at what was read.")
    live(lambda: (desk.project.empty, desk.doing), lambda: examples(desk) if desk.project.empty else None, "gap")
    live(lambda: desk.version, lambda: _ready(desk), "gap")
    Drop(
        "Drop a data set here",
        "A folder, a .zip or single logs: text, CSV, LabVIEW, Excel, MATLAB, Parquet. "
        "The model is an .fmu or a Modelica library.",
        limits=desk.limits, on_text=lambda words, good: say(words, bad=not good),
    )  # fmt: skip
    live(lambda: desk.version, lambda: _model(desk, named), "gap")
    live(lambda: desk.version, lambda: _data(desk), "gap")
    live(lambda: (desk.version, _described(desk)), lambda: _signals(desk), "gap")
    live(lambda: (desk.version, preview.get("record")), lambda: _records(desk, preview), "gap")
    live(lambda: desk.version, lambda: _earlier(desk), "gap")
    live(lambda: desk.version, lambda: projects(desk) if desk.project.empty else None, "gap")


def _ready(desk: Desk) -> None:
    """What to do next."""
    ended(desk)
    why = busy(desk, here="Data")
    if why and desk.runner.running is None:
        if not desk.project.empty:
            note(f"Next: {why[0].lower()}{why[1:]}.")
        return
    with box("card row end"):
        with box("tight"):
            text("b", "Ready to compare")
            text("span", _READY, "small")
        with box("row"):
            start_button(desk, "Compare and refit", "compare", then="/compare")
            start_button(desk, "Find what is missing", "diagnose", "main", then="/add")


def _model(desk: Desk, named: dict[str, str]) -> None:
    """The model that is used; `named` holds what this tab has typed."""
    settings, info = desk.project.settings(), desk.model
    with card("Model"):
        with box("row"):
            names = list(dict.fromkeys([*MODELS, *([settings.model] if settings.model else [])]))
            own = models_in([desk.project.folder / one for one in settings.libraries])
            name = named.get("name", settings.model or next(iter(own), ""))
            label = "Modelica class, or the name of an .fmu below model"
            field = Entry(label, name, lambda words: named.update(name=words), "type=text list=models spellcheck=false")
            field.classes("field").style("width: 430px; max-width: 100%")
            with ui.element("datalist").props("id=models"):
                for one in dict.fromkeys([*own, *names]):
                    ui.element("option")._props["value"] = one
            off = "Wait until the running work has ended" if desk.runner.running else ""
            button("Use this model", lambda: _use(desk, named, name), "" if settings.model else "main", off=off)
            if desk.model_busy:
                box("spin")
                text("span", "building the model; the first on a machine takes some minutes on Windows", "small")
        if not settings.model:
            text("p", f"A Modelica class, such as {MODELS[0]}, or drop an .fmu or a library above.", "small")
        if desk.model_trouble:
            note(desk.model_trouble, "bad")
        if settings.libraries:
            text("p", f"Libraries of yours: {', '.join(settings.libraries)}", "small")
        if info is not None:
            free = [p for p in info["parameters"] if None not in (p["min"], p["max"], p["start"])]
            told = (len(info["states"]), len(free), len(info["slots"]), len(info["effects"]))
            with box("row"):
                fits = " that fits" if len(info["effects"]) == 1 else " that fit"
                words = (("state", ""), ("parameter", " with bounds"), ("slot", ""), ("effect", fits))
                for count, (word, more) in zip(told, words, strict=True):
                    text("span", f"{counted(count, word)}{more}", "chip")
            if info["structure"] is None:
                note("Its Modelica class is not at hand, so no effect can be added; drop its library above.")
            elif not info["slots"]:
                note(_NO_SLOTS)


def _use(desk: Desk, named: dict[str, str], name: str) -> None:
    project, name = desk.project, named.get("name", name)
    project.use_model(project.model_name(name), project.settings().libraries)
    named.clear()
    background_tasks.create(desk.read_model())


def _data(desk: Desk) -> None:
    loaded = desk.loaded
    if loaded is None:
        return
    if loaded.trouble:
        with card("The data set was refused"):
            note(loaded.trouble, "bad")
    elif loaded.check is None:
        describe_form(desk)
    else:
        _refused(desk, loaded)


def _refused(desk: Desk, loaded: Loaded) -> None:
    """Files that could not be read, why, and what to do."""
    if not loaded.refused:
        return
    count = len(loaded.refused)
    with card(f"{count} {'log was' if count == 1 else 'logs were'} refused"):
        columns = [("file", "words"), ("why, and what to do", "words")]
        Table("Refused logs", columns, [list(row) for row in loaded.refused])
        with box("row"):
            files = {file for file, _ in loaded.refused}
            leave = lambda: change(desk, lambda c: description.leave_out(c, files), safe=True)  # noqa: E731
            button("Leave them out", leave, "small")
            text("span", "or mend them and drop the folder again", "small")


def change(desk: Desk, edit: Callable[[dict[str, Any]], Any], *, safe: bool = False) -> None:
    """Edit the description; where that is refused, nothing is changed.

    Args:
        safe: whether the edit cannot make it one that is refused, so that nothing has to be read to know.
    Raises:
        BadInput: work is running, or what is wrong with it.
    """
    try:
        if desk.runner.running is not None:
            raise BadInput("wait until the running work has ended, or stop it")
        content = description.read_description(desk.project.description)
        edit(content)
        description.change_description(desk.project.description, content, read=not safe)
        desk.history.look()
    finally:
        background_tasks.create(desk.read_data())  # what was typed is as it was, where it was refused


def _described(desk: Desk) -> int:
    """When the description was written, though by another program."""
    path = desk.project.description
    return path.stat().st_mtime_ns if path.is_file() else 0


def _signals(desk: Desk) -> None:
    """Which column is which variable of the model, its unit in the files, and its noise."""
    check = desk.check
    if check is None:
        return
    content = description.read_description(desk.project.description)
    variables = [] if desk.model is None else [str(v[0]) for v in desk.model["variables"]]
    with card("Signals"):
        told = "Signal = factor × column + offset, in this unit: a factor of −1 turns a sign, volts become bar. "
        text("p", f"{told}Noise is one standard deviation; left empty, it is estimated from the logs.", "small")
        with box("form").style("grid-template-columns: 1fr 0.8fr 0.7fr 1.3fr 1.2fr repeat(4, 0.7fr)"):
            for words in ("signal", "role", "unit", "variable of the model", "between samples", *_NUMBERS):
                text("span", words, "head")
            for name, section in content["signals"].items():
                _signal(desk, name, section, variables)
    for words in [*unfit(desk), *filter(None, starmap(description.uncounted, content["signals"].items()))]:
        note(words, "bad")
    for told in not_compared(check.dataset):
        note(told)
    for _, told in assumed_between_samples(check.dataset):
        note(f"{told} Choose what it was between samples: the difference may be far more than the noise.")


def _signal(desk: Desk, name: str, section: Mapping[str, Any], variables: list[str]) -> None:
    def put(key: str, value: Any) -> None:
        change(desk, lambda content: content["signals"][name].update({key: value}))

    text("b", name)
    role, unit = str(section.get("role", "")), str(section.get("unit", ""))
    roles = list(dict.fromkeys((role, *description.ROLES)))
    Choice(f"role of {name}", roles, role, lambda one: change(desk, lambda c: description.put_role(c, name, one)))
    units = lambda one: change(desk, lambda c: description.put_unit(name, c["signals"][name], one, unit))  # noqa: E731
    Choice(f"unit of {name}", UNITS, unit, units)
    variable = str(section.get("variable", name))
    if variables:
        options = list(dict.fromkeys([variable, *variables]))
        Choice(f"variable for {name}", options, variable, lambda value: put("variable", value))
    else:
        text("span", variable)
    if role == "input":
        now = next(words for words, hold in description.READ.items() if hold == section.get("hold"))
        Choice(f"{name} between samples", [*description.READ], now, lambda words: put("hold", description.READ[words]))
    else:
        text("span", "")
    for key in _NUMBERS:
        amount(section.get(key), partial(put, key), f"{key} of {name}", signed=key in ("factor", "offset"))


def _records(desk: Desk, preview: dict[str, int]) -> None:
    check = desk.check
    if check is None or not check.records:
        return
    columns = [("record", "words"), *((USES[use], "tick") for use in _TICKS), ("kind", "words")]
    columns += [(words, "number") for words in ("rows", "s", "samples/s", "offset", "amplitude", "Hz")]
    columns += [("look at", "words")]

    def used(row: int, words: str, on: bool) -> None:
        use = next(use for use in _TICKS if USES[use] == words) if on else "fit"
        change(desk, lambda content: description.put_use(content, read, row, use), safe=True)

    held = sum(record.use != "fit" for record in check.records)
    read = [record.source for record in check.records]
    with card(f"{counted(len(check.records), 'record')}, {held} {NOT_FITTED}"):
        text("p", uses_words(record.use for record in check.records), "small")
        Table(
            "Records", columns, [_row(record) for record in check.records], height="360px", on_tick=used,
            on_row=lambda k: preview.update(record=k), picked=preview.get("record", -1),
        )  # fmt: skip
    number = _log_number(check, preview.get("record", -1))
    if number is not None:
        log = check.dataset.logs()[number]
        overlay = measured_overlay(log)
        with card(log.source):
            record_chart(overlay, "data", number, f"{log.source} over time", 110 + 130 * len(overlay.names))


def _earlier(desk: Desk) -> None:
    """Data sets that a drop took the place of."""
    earlier, off = desk.project.earlier_data(), "Wait until the running work has ended" if desk.runner.running else ""
    if desk.project.data.exists():
        with box("row"):
            button("Put this data set aside", partial(desk.bring_back, None), "small quiet", off=off)
            text("span", "Then drop other logs. Until then, logs that are dropped are added to these.", "small")
    if not earlier:
        return
    with card("Earlier data sets"), box("tight"):
        for folder in earlier:
            with box("row").mark(folder.name):
                button(f"Bring back {folder.name}", partial(desk.bring_back, folder), "small", off=off)
                found = [path.name for path in folder.rglob("*") if path.is_file()]
                told = ", described" if "dataset.toml" in found else ", as they were dropped; columns not described"
                text("span", counted(len(found), "file") + told, "small")


def _log_number(check: DataCheck, row: int) -> int | None:
    """Which of the logs a record is, by its place: two may be of one file; None where it is none."""
    if row not in range(len(check.records)) or not isinstance(check.dataset.records[row].data, Record):
        return None
    return sum(isinstance(record.data, Record) for record in check.dataset.records[:row])


def _row(record: RecordCheck) -> list[Any]:
    base = record.clock
    clock = ["", ""] if base is None else [f"{base.duration:.4g}", f"{base.rate:.4g}"]
    frequency = "" if record.frequency is None else f"{record.frequency:g}"
    about = (quantity(value, record.unit) for value in (record.offset, record.amplitude))
    ticks, told = (record.use == use for use in _TICKS), "; ".join(map(sentence, record.findings))
    return [record.source, *ticks, record.kind, record.rows, *clock, *about, frequency, told]
