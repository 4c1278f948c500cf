"""`pysim locate`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from pysim.cli.command import Given
from pysim.cli.option import names
from pysim.cli.steps import read_parts, run_step, step_command

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed


def run(given: Given) -> Diagnosed:
    """The places with the law that each would need."""
    from pysim.diagnosis import learn
    from pysim.workflow import effects_of, session_of

    parts, there = read_parts(given), getattr(given, "with")  # a word of Python
    effects = effects_of(there, parts) if there else ()
    return run_step(given, parts, partial(learn, session_of(parts), effects))


COMMAND = step_command(
    "locate",
    "Estimate what is missing at each place of a model, and its shape, without naming an effect.",
    run,
    names("--with", "effects that are in the model already"),
    what=", parameters.toml",
)
