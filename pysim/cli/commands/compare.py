"""`pysim compare`."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.cli.command import Given
from pysim.cli.option import switch
from pysim.cli.steps import end_step, read_parts, run_step, step_command, write_model

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed
    from pysim.types import Comparison, Dataset


def run(given: Given) -> Comparison | Diagnosed:
    """Responses are compared by driving the model through the tests they stand for, logs over time sample by sample.

    Logs are compared in units of their noise; with --refit both are, as the model is and refitted.
    """
    dataset = given.dataset
    if not given.refit:
        _refuse_idle(given)
    if given.refit or given.records or given.events or not dataset.responses():
        return _logs(given)
    if dataset.logs():
        print(
            f"Compared are tables of frequency responses alone ({len(dataset.responses())}), not the logs over time "
            f"beside them ({len(dataset.logs())}): --refit takes the logs, or give them a data set of their own.\n"
        )
    return _responses(given, dataset)


def _refuse_idle(given: Given) -> None:
    """Nothing is free where nothing is refitted."""
    from pysim.types import BadInput

    for option in ("free", "bounds"):
        if given.typed[option]:
            raise BadInput(f"--{option}: nothing is refitted without --refit; add that, or leave --{option} out")


def _logs(given: Given) -> Diagnosed:
    """Every record beside the model as it is, and refitted where that is asked for."""
    from pysim.diagnosis import compare
    from pysim.workflow import session_of

    parts = read_parts(given, refits=given.refit)
    return run_step(given, parts, partial(compare, session_of(parts), refitted=given.refit))


def _responses(given: Given, dataset: Dataset) -> Comparison:
    from pysim.cli.options import read_parameters
    from pysim.identify import compare_responses
    from pysim.io import in_model_units
    from pysim.present.progress import announce_compilation
    from pysim.workflow import reference_of

    reference_hz = reference_of(dataset.responses(), given.reference_hz)
    model, name = given.model, given.typed["model"]
    overrides = read_parameters(given, model)
    announce_compilation()
    with given.progress("stepped sines") as progress:
        return compare_responses(
            model,
            in_model_units(dataset, model),
            overrides=overrides,
            label=Path(name).stem if name.lower().endswith(".fmu") else name,
            reference_hz=reference_hz,
            progress=progress,
        )


def _passes(result: Any) -> bool:
    """Whether every test is within the limits that hold, and every record was simulated."""
    from pysim.types import Comparison

    if isinstance(result, Comparison):
        return result.passes
    return bool(result.found.history[-1].passes)


COMMAND = step_command(
    "compare",
    "Hold a model against measurements, the thesis' pump to its Tables 1.3 and 1.4 too; with --refit also refitted.",
    run,
    switch("--refit", "refit within the bounds too, and say where it fails"),
    what=", with --refit parameters.toml",
    passes=_passes,
    files=lambda given, result, folder: result if given.opened is None else write_model(given, result, folder),
    done=lambda given, result: None if given.opened is None else end_step(given, result),
)
