"""What the commands of the diagnosis share: their options, how a step runs, and what it leaves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.cli.command import Command, Given
from pysim.cli.option import Option, file
from pysim.cli.options import BOUNDS, DATASET, FREE, JSON, LIBRARY, MODEL, OUTPUT, PARAMETERS, REFERENCE_HZ, SET
from pysim.present.report import CHECKPOINT

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed
    from pysim.types import Diagnosis, ProgressEvent
    from pysim.workflow import SessionParts

SUBJECT = (
    DATASET,
    replace(MODEL, about="a Modelica class with slots, or its .fmu"),
    replace(LIBRARY, about="Modelica library with the model or your effects: folder with package.mo, or .mo; repeat"),
    replace(FREE, about="parameters to refit (all with min, max and nominal that are not set); commas or repeat"),
    BOUNDS,
    SET,
    PARAMETERS,
    REFERENCE_HZ,
)


def step_command(
    name: str, about: str, run: Callable[[Given], Any], *options: Option, what: str = "", **more: Any
) -> Command:
    """A command that takes a model and its measurements one step further.

    Args:
        options: of its own.
        what: lies in the folder besides report and pictures, for the help.
        more: of the command, in place of what its kind has.
    """
    written = (
        replace(JSON, about="write the whole answer here"),
        replace(OUTPUT, about=f"write report.html, pictures{what} here; a stopped run goes on from it"),
        file("--records", "FILE.npz", "write every record beside every model here", suffixes=(".npz",)),
        file("--events", "FILE", "write progress here while it works, as JSON lines", suffixes=(".jsonl", ".json")),
    )
    kind = {"files": write_model, "done": end_step, "goes_on": (CHECKPOINT,), **more}
    return Command(name, about, run, options=(*SUBJECT, *options, *written), **kind)


def read_parts(given: Given, *, refits: bool = True, only: Sequence[str] | None = None) -> SessionParts:
    """What the command line names, opened.

    Args:
        refits: whether parameters will be refitted, so that some must be free.
        only: effects to consider; all that the slots take where None.
    """
    from pysim.cli.options import read_parameters
    from pysim.workflow import reference_of, session_parts

    return session_parts(
        given.model,
        given.dataset,
        libraries=given.library,
        free=given.free,
        bounds=given.bounds,
        values=read_parameters(given, given.model),
        effects=only,
        reference_hz=reference_of(given.dataset.responses(), given.reference_hz),
        refits=refits,
    )


def run_step(given: Given, parts: SessionParts, work: Callable[..., Diagnosis], step: str = "") -> Diagnosed:
    """Run a step of the diagnosis and show it; `--output` holds a checkpoint from which a stopped run goes on.

    Args:
        work: the step; takes `progress`, which receives each event, and `checkpoint`, a path or None.
        step: its name, for what it asks; that of the command by default.
    Raises:
        KeyboardInterrupt: stopped by the user; says how to go on.
    """
    from pysim.present.diagnosis import answered
    from pysim.present.progress import EventFile, Unfolding, announce_compilation
    from pysim.types import ProgressEvent
    from pysim.workflow import whole_answer

    announce_compilation()
    checkpoint = given.output / CHECKPOINT if given.output else None
    log = EventFile(given.events) if given.events else None
    with given.going_on("run"), Unfolding(f"{parts.dataset.name}: {parts.model_name}") as live:

        def progress(event: ProgressEvent) -> None:
            live(event)
            if log is not None:
                log(event)

        found = work(progress=progress, checkpoint=checkpoint)
        if log is not None:  # a program that follows must know why it does not end yet
            log(ProgressEvent("writing report and files"))
    found = whole_answer(found, parts, place=str(given.typed["dataset"]), command=given.repeated)
    given.opened = parts
    return answered(step or given.command.name, found, parts.dataset, parts.model_name)


def write_model(given: Given, result: Diagnosed, folder: Path) -> Diagnosed:
    """Write the fitted values, and class and FMU where effects were added."""
    from pysim.workflow import write_extended

    files = write_extended(result.found, given.opened, folder)
    return replace(result, files={name: path.name for name, path in files.items()})


def end_step(given: Given, result: Diagnosed) -> None:
    """Write the records; nothing is left to go on with, and the next question may use the folder."""
    from pysim.io import write_stages

    if given.records:
        write_stages(given.records, result.found.history)
    if given.output:
        (given.output / CHECKPOINT).unlink(missing_ok=True)
