"""Today's answer of the diagnosis as that of tomorrow and back, until one of them is gone."""

from __future__ import annotations

import numpy as np

from pysim.types import answer, diagnosis
from pysim.types.note import Note, NoteCode

_Z95 = 1.959963984540054  # half width of a 95 percent interval over the standard deviation


def to_answer(old: diagnosis.Diagnosis) -> answer.Diagnosis:
    """The same as numbers and codes; sentences become notes of the code OTHER, the reason first."""
    names = tuple(added.effect.name for added in old.added)
    last = old.error[-1] if old.error else None
    complete = old.complete if old.complete is not None else old.verdict == diagnosis.NONE or old.verdict in names
    left = old.left or (last.fit if last else None, last.validate if last else None, None, None)
    stages = {stage.step: stage for stage in old.stages}
    return answer.Diagnosis(
        effects=tuple(answer.FoundEffect(one.effect, one.place, one.estimates) for one in old.added),
        complete=complete,
        left=answer.Left({}, *left),
        rivals=tuple(
            answer.Rival(
                (*names[: c.round - 1], c.effect), c.score / 2, c.p_value, c.explained, c.refitted, c.parameters
            )
            for c in old.ranking
        ),
        ties=old.confusable,
        history=tuple(_history(step, stages.get(step.step, diagnosis.Stage(step.step))) for step in old.error),
        failures=old.where,
        missing=tuple(_law(one) for one in old.missing),
        next_test=old.next_test,
        estimates=old.parameters,
        notes=tuple(
            Note(NoteCode.OTHER, {"text": one}) if isinstance(one, str) else one for one in (old.reason, *old.notes)
        ),
        conditions=old.conditions,
        seconds=old.seconds,
    )


def from_answer(new: answer.Diagnosis) -> diagnosis.Diagnosis:
    """The same as today's commands, pages and reports read it."""
    notes = [str(one.values["text"]) if one.code is NoteCode.OTHER else one for one in new.notes]
    reason = notes.pop(0) if notes and isinstance(notes[0], str) else ""
    return diagnosis.Diagnosis(
        verdict=new.verdict,
        reason=str(reason),
        added=tuple(diagnosis.AddedEffect(one.effect, one.place, one.estimates) for one in new.effects),
        ranking=tuple(
            diagnosis.Candidate(
                r.effects[-1], 2 * r.score, r.p_value, r.explained, r.refitted, r.parameters, len(r.effects)
            )
            for r in new.rivals
        ),
        confusable=new.ties,
        error=tuple(as_ledger(step) for step in new.history),
        parameters=new.estimates,
        where=new.failures,
        seconds=new.seconds,
        notes=tuple(notes),
        missing=tuple(_missing(law) for law in new.missing),
        next_test=new.next_test,
        stages=tuple(
            diagnosis.Stage(s.step, s.estimates, s.undetermined, s.records, s.responses, s.failures)
            for s in new.history
        ),
        conditions=new.conditions,
        complete=new.complete,
        left=(new.left.fit, new.left.validate, new.left.share_explained, new.left.t),
    )


def as_ledger(step: answer.ErrorStep) -> diagnosis.LedgerStep:
    """As the pages that follow a diagnosis read it."""
    return diagnosis.LedgerStep(
        step.step, step.fit, step.validate, step.criteria, step.passes, step.cost, step.not_simulated
    )


def _history(step: diagnosis.LedgerStep, stage: diagnosis.Stage) -> answer.ErrorStep:
    return answer.ErrorStep(
        step.step,
        step.fit,
        step.validate,
        None,
        step.criteria,
        step.passes,
        step.cost,
        step.not_simulated,
        stage.estimates,
        stage.undetermined,
        stage.records,
        stage.responses,
        stage.where,
    )


def _law(missing: diagnosis.Missing) -> answer.LearnedLaw:
    """Its band is a standard deviation per knot: how knots vary together is not in today's answer."""
    shape = missing.shape
    sd = (shape.high - shape.low) / (2 * _Z95)
    return answer.LearnedLaw(
        slot=missing.slot,
        factor="",
        argument=missing.depends_on,
        knots=shape.argument,
        coefficients=shape.value,
        covariance=np.diag(sd**2),
        share=missing.share,
        argument_unit=shape.argument_unit,
        unit=shape.unit,
        absorbed=shape.absorbed,
        formula=missing.formula,
        alternatives=missing.alike,
        parameters=missing.parameters,
    )


def _missing(law: answer.LearnedLaw) -> diagnosis.Missing:
    half = _Z95 * np.sqrt(np.diag(law.covariance))
    shape = diagnosis.Shape(
        law.knots,
        law.coefficients,
        law.coefficients - half,
        law.coefficients + half,
        law.argument_unit,
        law.unit,
        law.absorbed,
    )
    return diagnosis.Missing(law.slot, law.share, law.argument, shape, law.formula, law.alternatives, law.parameters)
