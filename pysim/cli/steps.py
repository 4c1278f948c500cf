"""What the commands of the diagnosis share: their options, how a step runs, and what it leaves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import Given
from pysim.cli.option import Option, file, names
from pysim.cli.options import (
    BOUNDS,
    DATASET,
    FREE,
    JSON,
    LIBRARY,
    MODEL,
    OUTPUT,
    PARAMETERS,
    REFERENCE_HZ,
    SET,
)
from pysim.cli.outputs import JOURNAL

if TYPE_CHECKING:
    from pysim.cli._subject import Named
    from pysim.present.diagnosis import Diagnosed
    from pysim.types import Diagnosis, Told

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
EFFECTS = names("--effects", "consider only these of the catalogue")


def results(what: str) -> tuple[Option, ...]:
    """Options of what a step writes.

    Args:
        what: lies in the folder besides report and pictures, for the help.
    """
    return (
        replace(JSON, about="write the whole answer here"),
        replace(OUTPUT, about=f"write report.html, pictures{what} here; a stopped run goes on from it"),
        file("--records", "FILE.npz", "write every record beside every model here", suffixes=(".npz",)),
        file("--story", "FILE", "write what is told on the way here, JSON lines", suffixes=(".jsonl", ".json")),
    )


def run_step(
    given: Given,
    named: Named,
    work: Callable[[Callable[[Told], None], Path | None], Diagnosis],
    *,
    question: str = "Which effect is missing?",
    answer: Callable[[Diagnosis], str] | None = None,
) -> Diagnosed:
    """Run a step of the diagnosis and show it; in `--output` lies a journal from which a stopped run goes on.

    Args:
        work: the step, handed what tells and the journal's place.
        question, answer: what leads text and page; the verdict by default.
    Raises:
        KeyboardInterrupt: stopped by the user; says how to go on.
    """
    from pysim.cli.live import Story, StoryFile
    from pysim.cli.progress import announce_compilation
    from pysim.present.diagnosis import Diagnosed
    from pysim.types import Told

    announce_compilation()
    journal = given.output / JOURNAL if given.output else None
    try:
        with Story(f"{named.dataset.name}: {named.model_name}") as story:
            told: list[Callable[[Told], None]] = [story, *([StoryFile(given.story)] if given.story else [])]

            def tell(what: Told) -> None:
                for one in told:
                    one(what)

            found = work(tell, journal)
            for one in told[1:]:  # a program that follows is told why it does not end yet
                one(Told("writing report and files"))
    except KeyboardInterrupt:
        cure = "the same command goes on where it was" if journal else "with --output DIR a run can be gone on with"
        raise KeyboardInterrupt(cure) from None
    found = replace(found, conditions={**_conditions(given, named), **found.conditions})
    said = answer(found) if answer is not None else ""
    given.opened = named
    return Diagnosed(found, named.dataset, named.model_name, question, said)


def write_model(given: Given, result: Diagnosed, folder: Path) -> Diagnosed:
    """Write the fitted values, and class and FMU where effects were added."""
    from pysim.cli._extended import write_extended

    files = write_extended(result.found, given.opened, folder, place=given.output)
    return replace(result, files={name: path.name for name, path in files.items()})


def end_step(given: Given, result: Diagnosed) -> None:
    """Write the records; nothing is left to go on with, and the next question may use the folder."""
    from pysim.io import write_stages

    if given.records:
        write_stages(given.records, result.found.stages)
    if given.output:
        (given.output / JOURNAL).unlink(missing_ok=True)


def _conditions(given: Given, named: Named) -> dict[str, str]:
    """What it takes to repeat it."""
    from pysim.diagnose.conditions import versions

    model = named.subject.model
    found = {
        "model": f"{named.model_name}, FMI {model.abilities.fmi}, token {model.token}",
        "data set": f"{named.dataset.name}, {len(named.dataset.records)} records, {given.typed['dataset']}",
        "libraries": ", ".join(str(library) for library in named.libraries) or "the one that comes along",
        "free parameters": ", ".join(named.subject.free) or "none",
        "parameters set": ", ".join(f"{name} = {value:g}" for name, value in named.overrides.items()) or "none",
        "candidates": ", ".join(effect.name for effect in named.subject.catalogue) or "none",
    }
    if "seed" in given:
        found["seed"] = str(given.seed)
    return {**found, "versions": versions(), "command": given.repeated}
