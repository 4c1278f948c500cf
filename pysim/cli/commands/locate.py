"""`pysim locate`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import names
from pysim.cli.outputs import CHECKPOINT
from pysim.cli.steps import SUBJECT, end_step, read_parts, results, run_step, write_model

if TYPE_CHECKING:
    from pysim.present.diagnosis import Diagnosed


def run(given: Given) -> Diagnosed:
    """The places with the law that each would need."""
    from pysim.diagnosis import learn
    from pysim.present.diagnosis.words import learned_sentence
    from pysim.workflow import effects_of, session_of

    parts, there = read_parts(given), getattr(given, "with")  # a word of Python
    effects = effects_of(there, parts) if there else ()
    session = session_of(parts)
    return run_step(
        given,
        parts,
        lambda progress, checkpoint: learn(session, effects, progress=progress, checkpoint=checkpoint),
        question="Where is what missing?",
        answer=learned_sentence,
    )


COMMAND = Command(
    "locate",
    "Estimate what is missing at each place of a model, and its shape, without naming an effect.",
    run,
    options=(*SUBJECT, names("--with", "effects that the model is to have already"), *results(", parameters.toml")),
    files=write_model,
    done=end_step,
    goes_on=(CHECKPOINT,),
)
