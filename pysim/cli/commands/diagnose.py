"""`pysim diagnose`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import number
from pysim.cli.outputs import CHECKPOINT
from pysim.cli.steps import EFFECTS, SUBJECT, end_step, read_parts, results, run_step, write_model

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from pysim.present.diagnosis import Diagnosed
    from pysim.types import Diagnosis, ProgressEvent


def run(given: Given) -> Diagnosed:
    """The verdict; without effects to add, what each candidate gains, screened or refitted."""
    from pysim.diagnosis import Settings, diagnose, rank
    from pysim.present.diagnosis.words import ranking_sentence
    from pysim.types import BadInput
    from pysim.workflow import session_of

    most = given.max_effects
    if most < 0:
        raise BadInput(f"--max-effects {most}: write how many effects may be added, 0 or more")
    parts = read_parts(given, only=given.effects)
    session = session_of(parts, Settings(max_effects=most))
    if most:

        def work(progress: Callable[[ProgressEvent], None], checkpoint: Path | None) -> Diagnosis:
            return diagnose(session, progress=progress, checkpoint=checkpoint)

        return run_step(given, parts, work)
    return run_step(
        given,
        parts,
        lambda progress, checkpoint: rank(session, progress=progress, checkpoint=checkpoint),
        question="What would each effect explain?",
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
        number("--seed", "S", 0, "stands in the answer; the search draws nothing at random", convert=int),
        *results(", parameters.toml, the extended class and its FMU"),
    ),
    files=write_model,
    done=end_step,
    goes_on=(CHECKPOINT,),
)
