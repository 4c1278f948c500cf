"""`pysim locate`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import names
from pysim.cli.outputs import CHECKPOINT
from pysim.cli.steps import SUBJECT, end_step, read_parts, results, run_step, write_model

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from pysim.present.diagnosis import Diagnosed
    from pysim.types import Diagnosis, Effect, ErrorStep, LearnedLaw, ProgressEvent
    from pysim.types.diagnosis import LedgerStep, Missing, Stage
    from pysim.workflow import SessionParts

_Z95 = 1.959963984540054  # half width of a 95 percent interval over the standard deviation


def run(given: Given) -> Diagnosed:
    """The places with the law that each would need."""
    from pysim.present.diagnosis.words import learned_sentence
    from pysim.workflow import effects_of

    parts, there = read_parts(given), getattr(given, "with")  # a word of Python
    effects = effects_of(there, parts) if there else ()
    return run_step(
        given,
        parts,
        lambda progress, checkpoint: located(parts, effects, progress, checkpoint),
        question="Where is what missing?",
        answer=learned_sentence,
    )


def located(
    parts: SessionParts,
    effects: Sequence[Effect] = (),
    progress: Callable[[ProgressEvent], None] | None = None,
    checkpoint: Path | None = None,
) -> Diagnosis:
    """The last user of `pysim.diagnose.located`: its answer as today's. `pysim.diagnosis.learn` replaces it."""
    from pysim.diagnose import located as old_located
    from pysim.present.notes import words
    from pysim.types import Diagnosis, FoundEffect, Left, Note, NoteCode, ProgressEvent
    from pysim.types.answer import UNKNOWN
    from pysim.types.diagnosis import Stage, Told
    from pysim.workflow import subject_of

    def follow(told: Told) -> None:
        if progress is not None:
            step = None if told.step is None else _step(told.step, Stage(told.step.step))
            progress(ProgressEvent(told.stage, told.text, step))

    old = old_located(subject_of(parts), effects, progress=follow, journal=checkpoint)
    known = {words(note): note for note in parts.notes}
    stages = {stage.step: stage for stage in old.stages}
    last = old.error[-1]
    return Diagnosis(
        effects=tuple(FoundEffect(one.effect, one.place, one.estimates) for one in old.added),
        complete=old.verdict != UNKNOWN,
        left=Left({}, last.fit, last.validate),
        rivals=(),
        ties=old.confusable,
        history=tuple(_step(step, stages.get(step.step, Stage(step.step))) for step in old.error),
        failures=old.where,
        places=tuple(_law(one) for one in old.missing),
        estimates=old.parameters,
        notes=tuple(
            one if isinstance(one, Note) else known.get(one, Note(NoteCode.OTHER, {"text": one})) for one in old.notes
        ),
        seconds=old.seconds,
    )


def _step(step: LedgerStep, stage: Stage) -> ErrorStep:
    from pysim.types import ErrorStep

    head = (step.step, step.fit, step.validate, None, step.criteria, step.passes, step.cost, step.not_simulated)
    return ErrorStep(*head, stage.estimates, stage.undetermined, stage.records, stage.responses, stage.where)


def _law(missing: Missing) -> LearnedLaw:
    """Its band is a standard deviation per knot: how knots vary together is not in the old answer."""
    import numpy as np

    from pysim.types import LearnedLaw

    shape = missing.shape
    return LearnedLaw(
        slot=missing.slot,
        factor="",
        argument=missing.depends_on,
        knots=shape.argument,
        coefficients=shape.value,
        covariance=np.diag(((shape.high - shape.low) / (2 * _Z95)) ** 2),
        share=missing.share,
        argument_unit=shape.argument_unit,
        unit=shape.unit,
        absorbed=shape.absorbed,
        formula=missing.formula,
        alternatives=missing.alike,
        parameters=missing.parameters,
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
