"""`pysim diagnose`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from pysim.cli.command import Given
from pysim.cli.option import names, number
from pysim.cli.steps import read_parts, run_step, step_command

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed


def run(given: Given) -> Diagnosed:
    """The verdict; without effects to add, what each candidate gains, screened or refitted."""
    from pysim.diagnosis import Settings, diagnose, rank
    from pysim.types import BadInput
    from pysim.workflow import session_of

    most = given.max_effects
    if most < 0:
        raise BadInput(f"--max-effects {most}: write how many effects may be added, 0 or more")
    parts = read_parts(given, only=given.effects or None)
    session = session_of(parts, Settings(max_effects=most))
    return run_step(given, parts, partial(diagnose if most else rank, session), "diagnose" if most else "rank")


COMMAND = step_command(
    "diagnose",
    "Say which physical effect a model lacks, from measurements.",
    run,
    names("--effects", "consider only these of the catalogue"),
    number("--max-effects", "N", 3, "effects to add at most; 0 ranks them and adds none", convert=int),
    what=", parameters.toml, the extended class and its FMU",
)
