"""`pysim diagnose`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import number
from pysim.cli.outputs import JOURNAL
from pysim.cli.steps import EFFECTS, SUBJECT, end_step, read_parts, results, run_step, write_model

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed


def run(given: Given) -> Diagnosed:
    """The verdict; without effects to add, what each candidate gains, screened or refitted."""
    from pysim.diagnose import diagnose, rank
    from pysim.present.diagnosis.words import ranking_sentence
    from pysim.types import BadInput

    most, seed = given.max_effects, given.seed
    if most < 0:
        raise BadInput(f"--max-effects {most}: write how many effects may be added, 0 or more")
    parts = read_parts(given, only=given.effects)
    if most:
        return run_step(
            given,
            parts,
            lambda session, story, journal: diagnose(session, seed=seed, most=most, progress=story, journal=journal),
        )
    return run_step(
        given,
        parts,
        lambda session, story, journal: rank(session, seed=seed, progress=story, journal=journal),
        question="What would each effect gain?",
        answer=ranking_sentence,
    )


COMMAND = Command(
    "diagnose",
    "Say which physical effect a model lacks, from measurements.",
    run,
    options=(
        *SUBJECT,
        EFFECTS,
        number("--max-effects", "N", 3, "effects to add at most; 0 ranks them and adds none", convert=int),
        number("--seed", "S", 0, "seed of the random draws; the same seed gives the same answer", convert=int),
        *results(", parameters.toml, the extended class and its FMU"),
    ),
    files=write_model,
    done=end_step,
    goes_on=(JOURNAL,),
)
