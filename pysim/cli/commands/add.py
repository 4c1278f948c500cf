"""`pysim add`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from pysim.cli.command import Given
from pysim.cli.option import names
from pysim.cli.steps import read_parts, run_step, step_command

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed


def run(given: Given) -> Diagnosed:
    """What each effect does to the error, on logs that are fitted and that are not."""
    from pysim.diagnosis import add
    from pysim.workflow import effects_of, session_of

    parts = read_parts(given)
    return run_step(given, parts, partial(add, session_of(parts), effects_of(given.effects, parts)))


COMMAND = step_command(
    "add",
    "Add effects to a model, refit everything, and write the extended class with its FMU.",
    run,
    names("--effects", "effects to add, in this order", required=True),
    what=", parameters.toml, the extended class and its FMU",
)
