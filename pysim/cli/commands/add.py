"""`pysim add`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import names
from pysim.cli.outputs import CHECKPOINT
from pysim.cli.steps import SUBJECT, end_step, read_parts, results, run_step, write_model

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed


def run(given: Given) -> Diagnosed:
    """What each effect does to the error, on fitted and held-out data."""
    from pysim.diagnosis import add
    from pysim.present.diagnosis.words import added_sentence
    from pysim.workflow import effects_of, session_of

    parts = read_parts(given)
    effects = effects_of(given.effects, parts)
    session = session_of(parts)
    return run_step(
        given,
        parts,
        lambda progress, checkpoint: add(session, effects, progress=progress, checkpoint=checkpoint),
        question="What do the effects mend?",
        answer=added_sentence,
    )


COMMAND = Command(
    "add",
    "Add effects to a model, refit everything, and write the extended class with its FMU.",
    run,
    options=(
        *SUBJECT,
        names("--effects", "to add, by their standard names, in order", required=True),
        *results(", parameters.toml, the extended class and its FMU"),
    ),
    files=write_model,
    done=end_step,
    goes_on=(CHECKPOINT,),
)
