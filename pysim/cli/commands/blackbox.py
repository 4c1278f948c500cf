"""`pysim blackbox`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import choice, number, switch, text
from pysim.cli.options import DATASET, JSON, OUTPUT, SIGNAL

if TYPE_CHECKING:
    from pysim.identify.blackbox import Structure
    from pysim.present.blackbox import TransferFunctions


def run(given: Given) -> TransferFunctions:
    """A transfer function for every response."""
    from pysim.identify.blackbox import Structure, fit_dataset
    from pysim.present.blackbox import TransferFunctions

    structure = Structure(given.poles, given.zeros, given.dead_time, given.dead_time_max, given.stable)
    _refuse_contradictions(given, structure)
    dataset = given.dataset
    with given.progress("responses") as progress:
        fitted = fit_dataset(
            dataset,
            structure,
            weights=given.weights,
            suggest=given.orders == "suggest",
            output=given.signal,
            tests=given.test,
            progress=progress,
        )
    return TransferFunctions(dataset.name, tuple(fitted))


def _refuse_contradictions(given: Given, structure: Structure) -> None:
    from pysim.types import BadInput

    if given.orders and (structure.zeros or structure.dead_time):
        raise BadInput(
            "--orders suggest: --zeros and --dead-time fix what is to be found; leave them out (--dead-time-max allows "
            "a dead time)"
        )
    if given.orders and not structure.poles:
        raise BadInput("--orders suggest: --poles 0 leaves nothing to compare; give the most poles to try")


def _test(word: str) -> tuple[float, float]:
    """Offset and amplitude."""
    try:
        offset, amplitude = (float(part) for part in word.split("/"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{word!r}: write offset/amplitude in the command's unit, as 25/10") from None
    return offset, amplitude


_WEIGHTS = "how points are weighted: by their noise (if known), all alike (otherwise), or in proportion to the gain"

COMMAND = Command(
    "blackbox",
    "Fit a transfer function to every frequency response of a data set.",
    run,
    options=(
        DATASET,
        number("--poles", "N", None, "number of poles; with --orders, the largest to try", convert=int, required=True),
        number("--zeros", "M", 0, "number of zeros", convert=int),
        number("--dead-time", "S", 0.0, "known dead time, or the smallest to try, s"),
        number("--dead-time-max", "S", None, "estimate the dead time, up to this, s"),
        switch("--stable", "allow stable poles only"),
        choice("--weights", "", ("covariance", "uniform", "relative"), _WEIGHTS),
        choice("--orders", None, ("suggest",), "compare all structures up to --poles and take the best"),
        text("--test", "O/A", "only this offset/amplitude, as -25/10; repeat", repeated=True, convert=_test),
        SIGNAL,
        JSON,
        OUTPUT,
    ),
    passes=lambda result: all(one.fit.converged for one in result.fitted),
)
