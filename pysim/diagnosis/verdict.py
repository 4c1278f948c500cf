"""The verdict: effects in the order of what leaving each out costs, what is left, and whether the model is complete."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.special import fdtri

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Refused, sensor_name
from pysim.diagnosis.learn.learn import Learning
from pysim.diagnosis.left import Follows
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.search import Compared, Found, Table
from pysim.diagnosis.session import TEST, Session
from pysim.diagnosis.settings import Settings
from pysim.effects import makes_events
from pysim.identify.greybox import Nuisance, NuisanceKind
from pysim.identify.greybox.effective_size import inflation
from pysim.identify.greybox.trust import at_bound
from pysim.types import Effect, EffectParameter, Estimate, Note, NoteCode, RecordFit
from pysim.types.answer import ErrorStep, FoundEffect, GainTest, Left, Rival, StandsOut, Verdict
from pysim.types.fit import HALF_95


def found_effects(found: Found, estimates: Sequence[Estimate], session: Session) -> tuple[FoundEffect, ...]:
    """The effects that are kept, the most costly to leave out first; sensor errors as effects at their signal."""
    candidate = found.final.candidate
    by_name = {one.name: one for one in estimates}
    avoidable = sum(test.gain for test in found.losses.values())
    shares = {k: _share(v.gain, avoidable) if v.verdict is Verdict.BETTER else 0.0 for k, v in found.losses.items()}
    rows: list[tuple[float, FoundEffect]] = []
    for effect in candidate.effects:
        place, loss = candidate.places[effect.name], found.losses[effect.name]
        own = tuple(by_name[f"{place}.{p.name}"] for p in effect.parameters)
        rows.append((loss.gain, FoundEffect(effect, place, own, shares[effect.name])))
    labels = candidate.labels[len(candidate.effects) :]
    sizes = found.final.point.carried.nuisances.tolist()
    for nuisance, label, size in zip(candidate.nuisances, labels, sizes, strict=True):
        loss = found.losses[label]
        rows.append((loss.gain, _sensor(nuisance, size, loss, shares[label], found.final, session)))
    return tuple(one for _, one in sorted(rows, key=lambda row: -row[0]))


def _sensor(
    nuisance: Nuisance, size: float, loss: GainTest, share: float, final: FinalFit, session: Session
) -> FoundEffect:
    """A sensor error as a found effect; its interval follows from what leaving it out costs (Wald)."""
    unit = session.dataset.signal(nuisance.signal).unit
    unit = {NuisanceKind.GAIN: "1", NuisanceKind.DELAY: "s", NuisanceKind.DRIFT: f"{unit}/s"}.get(nuisance.kind, unit)
    far = 100 * max(abs(size), nuisance.prior_sd)
    parameter = EffectParameter("size", unit, -far, far, nuisance.prior_sd, 0.0, 0.0, f"{nuisance.kind.value} error")
    inflated = rivals.samples(final) / loss.effective_size
    sd = abs(size) / math.sqrt(max(2 * loss.gain, 1e-9)) * math.sqrt(inflated)
    estimate = Estimate("size", unit, size, 0.0, -far, far, sd, (size - HALF_95 * sd, size + HALF_95 * sd), "")
    effect = Effect(sensor_name(nuisance), nuisance.signal, "", (parameter,))
    return FoundEffect(effect, nuisance.signal, (estimate,), share)


def what_is_left(
    found: Found, follows: Follows | None, tone: float | None, last: ErrorStep, settings: Settings
) -> Left:
    """What the final model leaves; `last` is its step of the error history."""
    floors = {f"{dataset}/{signal}": floor for (dataset, signal), floor in found.floors.floors.items()}
    share, t = (None, None) if follows is None else (follows.share, follows.t)
    worst = stands_out([record for record in last.records if record.use != TEST], settings)
    return Left(floors, last.fit, last.validate, share, t, tone, worst)


def is_complete(found: Found, follows: Follows | None, left: Left, last: ErrorStep, settings: Settings) -> bool:
    """Whether only noise is left.

    That is: no candidate is significant, the model's signals do not predict the residual, it has no tone, and no log
    that was fitted or used to choose leaves more than the others.
    """
    if found.undecidable or found.more or left.tone is not None or left.stands_out is not None:
        return False
    if follows is not None and follows.share > settings.small and follows.t > settings.follows_t:
        return False
    if found.floors.within(found.final, settings.near):  # the only sign of misfit if there is no regression
        return True
    return follows is not None and not hardly_explains(last, settings)


def stands_out(records: Sequence[RecordFit], settings: Settings) -> StandsOut | None:
    """The log in which a signal's residual is most clearly larger than in the others; None where chance may do that.

    A sensor's noise is the same in all. Two variances are compared by their F test. Squares of n Gaussian residuals
    with autocorrelations rho are worth n / sum(rho^2) independent ones (Bartlett 1946).
    """
    rests = [(one, k, rest[k]) for one in records for rest in (one.residual,) for k in rest.names]
    columns = [(one, k, rest[there, None]) for one, k, rest in rests for there in (np.isfinite(rest),) if there.any()]
    if not columns:
        return None
    names = np.array([f"{one.dataset}/{k}" for one, k, _ in columns])
    others = (names[:, None] == names) & ~np.eye(len(columns), dtype=bool)
    variance = np.array([np.mean(column**2) for *_, column in columns])
    worth = np.array([column.size / inflation([column], [column]) for *_, column in columns])
    rest = others @ worth  # 0 where no other log has the signal: no limit then
    ratio = variance / np.maximum(others @ (worth * variance) / np.maximum(rest, 1.0), 1.0)
    limit = settings.held_out**2 * fdtri(worth, rest, 1 - settings.false_alarm / len(columns))
    k = int(np.argmax(np.nan_to_num(ratio / limit)))
    return StandsOut(columns[k][0].source, columns[k][1], float(np.sqrt(ratio[k]))) if ratio[k] > limit[k] else None


def hardly_explains(last: ErrorStep, settings: Settings) -> bool:
    """Whether the residual of some signal is so large that the model hardly describes the signal."""
    return any(
        float(np.nanstd(record.measured.values[:, j] - record.simulated.values[:, j]))
        > settings.unexplained * float(np.nanstd(record.measured.values[:, j]))
        for record in last.records
        if record.use == "fit"
        for j in range(record.measured.values.shape[1])
        if float(np.nanstd(record.measured.values[:, j])) > settings.near * record.noise[j]
    )


def ranking(tables: Sequence[Table]) -> tuple[Rival, ...]:
    """All candidates that were tried, model by model, best first; those only screened at the end."""
    rows: list[Rival] = []
    for one in tables:
        rows += [_row(one.names, rival, one.avoidable) for rival in one.rivals]
        refitted = {rival.added for rival in one.rivals}
        aside = [s for s in one.looked if s.effect.name not in refitted]
        rows += [Rival((*one.names, s.effect.name), s.gain, 1.0, _share(s.gain, one.avoidable), False) for s in aside]
    return tuple(rows)


def _share(gain: float, avoidable: float) -> float:
    return max(min(gain / max(avoidable, 1e-9), 1.0), 0.0)


def _row(names: tuple[str, ...], one: Compared, avoidable: float) -> Rival:
    own = {key[1]: value for key, value in one.fit.values.items() if isinstance(key, tuple) and key[0] == one.added}
    share = _share(one.test.gain, avoidable)
    return Rival((*names, one.added), one.test.penalised, one.test.p_value, share, one.fit.ended, own, one.test)


def ties(found: Found) -> tuple[tuple[str, ...], ...]:
    """Groups of labels that these data do not separate, one for each part that is kept and tied."""
    kept = set(found.final.candidate.labels)
    return tuple(
        (step.added, *step.rivals[0].ties)
        for step in found.steps
        if step.rivals and step.rivals[0].ties and step.added in kept
    )


def notes_of(
    found: Found, estimates: Sequence[Estimate], refused: Mapping[str, Refused], session: Session
) -> list[Note]:
    """Notes on the answer: effects not tried, estimates at bounds, and what the intervals are conditional on."""
    notes = [one.note(name) for name, one in refused.items()]
    notes += [at_bound(one) for one in estimates if one.at]
    if found.final.names:
        notes.append(Note(NoteCode.INTERVAL_CONDITIONAL, {}))
        chosen = [r.source for r in session.dataset.records if r.use == "validate"]
        if chosen and session.unseen is None:
            notes.append(Note(NoteCode.USED_TO_CHOOSE, {"records": ", ".join(chosen)}))
    return notes


def note_of_laws(learning: Learning | None, final: FinalFit) -> Note:
    """Why no law was learned beside the final model."""
    if learning is None:
        names = ", ".join(effect.name for effect in final.candidate.effects if makes_events(effect))
        return Note(NoteCode.LAWS_NOT_TRIED, {"effects": names})
    if learning.test is None:
        places = ", ".join(dict.fromkeys(one.law.place.name for one in learning.ranked)) or "no place"
        return Note(NoteCode.NO_LAW_RUNS, {"places": places})
    code = NoteCode.LAW_VETOED if learning.test.verdict is Verdict.VETOED else NoteCode.NO_LAW
    return Note(code, {"law": learning.fits[0].law.label})
