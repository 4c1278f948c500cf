"""Entry points of the diagnosis: the whole search, and each of its steps alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from pysim.diagnosis import verdict
from pysim.diagnosis.candidate import Models, Refused
from pysim.diagnosis.checkpoint import Checkpoint, whose
from pysim.diagnosis.error_history import error_step, held_still
from pysim.diagnosis.floors import Floors
from pysim.diagnosis.learn.described import answered
from pysim.diagnosis.learn.fit import together
from pysim.diagnosis.learn.learn import Learner, Learning
from pysim.diagnosis.learn.names import refines, without_the_unseated
from pysim.diagnosis.learn.outside import outside_laws
from pysim.diagnosis.left import follows, tone
from pysim.diagnosis.next_test import next_test
from pysim.diagnosis.progress import Progress, Say
from pysim.diagnosis.refit import FinalFit, begin, converged, finest, integrated
from pysim.diagnosis.search import Found, Search
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import LearnSettings
from pysim.identify.greybox import Simulation
from pysim.types import BadInput, Effect, NextTest, Note, NoteCode
from pysim.types.answer import PRIOR, REFIT, Diagnosis, ErrorStep, LearnedLaw, Left, Verdict

Named = Sequence[tuple[str, FinalFit]]  # steps of the error history: name and model


class Learns(Enum):
    """When to learn a law that no catalogue has."""

    NEVER = "never"
    IF_MISSING = "if more is missing than a small share of what was"
    ALWAYS = "always"


def diagnose(session: Session, *, progress: Say | None = None, checkpoint: Path | None = None) -> Diagnosis:
    """Find the effects that the data demand, in order; the verdict may also be that none is missing, or `unknown`.

    Args:
        progress: called with each ProgressEvent; an exception that it raises ends the diagnosis.
        checkpoint: file of finished refits, from which a stopped diagnosis goes on.
    Raises:
        BadInput: the base model cannot be simulated at its own parameters.
    """
    search = _search(session, progress, checkpoint, "diagnose")
    base = search.fit_base()
    search.say.stage("refit")
    most = session.settings.max_effects if session.build is not None and session.catalogue else 0
    found = search.run(base, most)
    search.say.stage("search")
    return _answer(session, search, found, learns=Learns.IF_MISSING)


def learn(
    session: Session, effects: Sequence[Effect] = (), *, progress: Say | None = None, checkpoint: Path | None = None
) -> Diagnosis:
    """Learn a law that no catalogue has: for each place in the model the curve, over one variable, that fits best.

    If the model's Modelica class is not available, the places are its inputs and outputs, and no law is added.

    Args:
        effects: added to the model before the law is learned.
    Raises:
        BadInput: an effect cannot be compiled or simulated.
    """
    if effects:
        _needs_class(session)
    search = _search(session, progress, checkpoint, "learn")
    base = search.fit_base()
    search.say.stage("refit")
    found, models = _extended(search, base, effects)
    if session.build_law is None:
        search.say.doing("trying laws at inputs and outputs")
        laws = outside_laws(found.final, search.floors.sd)
        return replace(_answer(session, search, found, models=models), missing=laws)
    return _answer(session, search, found, models=models, learns=Learns.ALWAYS)


def compare(
    session: Session, *, refitted: bool = True, progress: Say | None = None, checkpoint: Path | None = None
) -> Diagnosis:
    """Compare the measurements with the nominal model, and with the model once its parameters are refitted.

    Args:
        refitted: False compares the nominal model alone.
    """
    search = _search(session, progress, checkpoint, "compare")
    base = search.fit_base() if refitted else search.as_it_is()
    search.floors = search.floors.with_(base)
    return _answer(session, search, Found(base, base, (), search.floors), refitted=refitted)


def rank(session: Session, *, progress: Say | None = None, checkpoint: Path | None = None) -> Diagnosis:
    """Rank the effects by what each of them gains when it is added to the refitted base model; none is kept.

    Raises:
        BadInput: the model's Modelica class is not available.
    """
    _needs_class(session)
    search = _search(session, progress, checkpoint, "rank")
    base = search.fit_base()
    search.floors = search.floors.with_(base)
    search.expand(base)
    return _answer(session, search, Found(base, base, (), search.floors))


def add(
    session: Session, effects: Sequence[Effect], *, progress: Say | None = None, checkpoint: Path | None = None
) -> Diagnosis:
    """Add the given effects one after the other, and refit all parameters each time.

    Raises:
        BadInput: the model's Modelica class is not available, or an effect cannot be compiled or simulated.
    """
    _needs_class(session)
    search = _search(session, progress, checkpoint, "add")
    base = search.fit_base()
    found, models = _extended(search, base, effects)
    return _answer(session, search, found, models=models)


def _extended(search: Search, base: FinalFit, effects: Sequence[Effect]) -> tuple[Found, list[FinalFit]]:
    """The base model with effects that are added one after the other, and the model after each of them."""
    steps = [base]
    for k, effect in enumerate(effects, start=1):
        search.say.doing(f"adding {effect.name}")
        steps.append(search.with_effects(steps[-1], effects[:k]))
    search.floors = search.floors.with_(base).with_(steps[-1])
    losses = {e.name: search.test(steps[k], steps[k + 1]) for k, e in enumerate(effects)}
    return Found(base, steps[-1], (), search.floors, losses), steps[1:]


def _needs_class(session: Session) -> None:
    if session.build is None:
        raise BadInput("no effect can be added: the model's Modelica class is not at hand; name it with its library")


def _search(session: Session, progress: Say | None, checkpoint: Path | None, step: str) -> Search:
    kept = Checkpoint(checkpoint, whose(session, step))
    say = Progress(progress or (lambda told: None))
    return Search(Models(session), Simulation(workers=session.workers), session.settings, say, kept)


@dataclass(frozen=True)
class _Account:
    """The error history of a sequence of models, and what the last of them leaves of the measurements."""

    history: tuple[ErrorStep, ...]
    notes: tuple[Note, ...]
    left: Left
    complete: bool


def _account(session: Session, found: Found, models: Named, simulation: Simulation) -> _Account:
    steps = [
        error_step(name, fit, session, found.floors.floors, simulation, fitted=name != PRIOR) for name, fit in models
    ]
    last, notes = steps[-1][0], dict.fromkeys(note for _, own in steps for note in own)
    rest = follows(found.final, session.dataset, session.treatment.noise.blocks)
    heard = tone(found.final, session.dataset, session.settings.false_alarm)
    left = verdict.what_is_left(found, rest, heard, last, session.settings)
    complete = verdict.is_complete(found, rest, left, last, session.settings)
    return _Account(tuple(step for step, _ in steps), tuple(notes), left, complete)


def _answer(
    session: Session,
    search: Search,
    found: Found,
    *,
    refitted: bool = True,
    models: Sequence[FinalFit] = (),
    learns: Learns = Learns.NEVER,
) -> Diagnosis:
    """Assemble the answer: learn a law if asked for, then compute the error history, the intervals and the verdict.

    Args:
        models: models of the error history, one per added effect; the search's own steps if empty.
        learns: when to learn a law beside the final model.
    """
    search.say.doing("counting what is left")
    found = _in_true_form(found, search, keep=bool(models))
    final = found.final
    if refitted:
        final = integrated(final, session.settings.refinements)
    found = replace(found, base=found.base if found.final.names else final, final=final)
    untouched = [(PRIOR, search.as_it_is()), *([(REFIT, found.base)] if refitted else [])]
    named: Named = [*untouched, *_kept(found, models, final, search)]
    account = _account(session, found, named, search.fine)
    estimates = held_still(final)[0] if refitted else ()
    wanted = learns is Learns.ALWAYS or (learns is Learns.IF_MISSING and _lacks_much(found, account))
    wanted &= session.build_law is not None
    learning = _learned(session, search, found) if wanted and not final.candidate.has_events else None
    laws, new = list[Learning](), [learning] if learning is not None and learning.law is not None else []
    for _ in range(session.settings.max_effects):
        if not new or new is laws:
            break
        laws, law = new, new[-1].fits[0]
        found, named = _with_laws(found, named, laws)
        account = _account(session, found, named, finest(search.fine, law.fit.simulation))
        new = _another(session, search, found, laws) if _lacks_much(found, account) else laws
    if wanted:
        search.say.stage("learn")
    curves = {name for one in laws for name in one.fits[0].own}
    history = tuple(
        replace(step, estimates=tuple(one for one in step.estimates if one.name not in curves))
        for step in account.history
    )
    estimates = history[-1].estimates if laws else estimates
    _said(search.say, history)
    search.say.stage("intervals")
    settles, unsettled = _next_test(session, found)
    learned, missing = _of_each_place(laws or ([learning] if learning else []), history)
    of_law = [verdict.note_of_laws(learning, final)] if wanted and not learned else []
    places = {} if learning is None else {place: Refused(why) for place, why in learning.refused.items()}
    refused = search.models.refused | places
    own = verdict.notes_of(found, estimates, refused, session)
    beyond = {name for table in search.tables for name in table.beyond} & {one.name for one in session.catalogue}
    own += [Note(NoteCode.BEYOND_BOUND, {"effect": name}) for name in sorted(beyond - set(final.names))]
    return Diagnosis(
        effects=verdict.found_effects(found, estimates, session),
        complete=account.complete,
        left=account.left,
        rivals=verdict.ranking(search.tables),
        ties=verdict.ties(found),
        history=history,
        failures=history[min(1, len(history) - 1)].failures,
        learned=learned,
        missing=missing,
        next_test=settles,
        estimates=estimates,
        notes=(*session.notes, *account.notes, *unsettled, *own, *of_law),
        seconds=search.say.seconds,
        detectable=search.detectable(found.final),
    )


def _with_laws(found: Found, models: Named, laws: Sequence[Learning]) -> tuple[Found, Named]:
    """Result and history with the last of these laws as the last model, without the effects, laws and doubts that it
    made needless."""
    law = laws[-1].fits[0]
    kept, learned = set(law.fit.candidate.labels), {"", *(one.fits[0].law.label for one in laws)}
    losses = {label: loss for label, loss in found.losses.items() if label in kept}
    beside = [one for one in models if kept.issuperset(one[1].candidate.labels) and one[1].candidate.law in learned]
    floors = found.floors.with_(law.fit)
    return replace(found, final=law.fit, floors=floors, losses=losses, more=False), [*beside, (law.law.label, law.fit)]


def _learned(session: Session, search: Search, found: Found) -> Learning:
    """Learn the best law beside the base model and, if it cannot take the place of the effects, beside these.

    It takes their place if it explains clearly more than they do ("unseats"), refines none of them, and a law beside
    them explains little more. Of the effects beside a law those are dropped that it makes needless.
    """
    floors, settings = found.floors, LearnSettings()
    alone = _law_beside(found.base, session, search, floors)
    if found.final is found.base:
        return alone
    base, final, left = floors.avoidable(found.base), floors.avoidable(found.final), math.inf
    if alone.law is not None and not any(refines(alone.law.law, one) for one in found.final.candidate.effects):
        own = floors.avoidable(alone.law.fit)
        left = own if final - own > settings.unseats * base else math.inf
    if left <= settings.least * base:
        return alone
    learning, best = _law_beside(found.final, session, search, floors), final
    if learning.law is not None:
        tried, one = search.models.alone, learning.law
        law = without_the_unseated(
            session, one, learning.present, found.base, found.losses, tried, floors, search.tried
        )
        learning, best = replace(learning, fits=(law, *learning.fits[1:])), floors.avoidable(law.fit)
    return alone if left - best < settings.least * base else learning


def _law_beside(present: FinalFit, session: Session, search: Search, floors: Floors) -> Learning:
    """The best law beside a model."""
    if session.has_clock and not present.candidate.transient:
        present = _alone(present, search, transient=True)
    return Learner(session, present, floors, search.tried, search.vetoed, search.say.doing).learn()


def _lacks_much(found: Found, account: _Account) -> bool:
    """Whether more than a small share of what the base model lacked is left."""
    floors = found.floors
    much = floors.avoidable(found.final) > LearnSettings().least * floors.avoidable(found.base)
    return much and not account.complete


def _another(session: Session, search: Search, found: Found, laws: list[Learning]) -> list[Learning]:
    """The laws and one more that is learned beside them, all refitted; the same laws if no more is found or allowed.
    Where a single log is all there is, another law could not be contradicted.

    The last law may only have stood in for the new one. It is left out if the best law at the new one's place, learned
    without it, leaves as little of the avoidable sum of squares, but for a small share.
    """
    many = len(laws) + len(found.final.names) >= session.settings.max_effects
    if many or len(session.dataset.logs()) < 2:
        return laws
    fits, floors = [one.fits[0] for one in laws], found.floors
    learner = Learner(session, fits[-1].held, floors, search.tried, search.vetoed, search.say.doing, beside=fits)
    more = learner.learn()
    if more.law is None:
        return laws
    both = _all_refitted([*laws, more], session, search, floors)
    fewer = _instead_of_the_last(session, search, found, laws, more.law.law.place.name)
    lost = floors.avoidable(fewer[-1].fits[0].fit) - floors.avoidable(both[-1].fits[0].fit) if fewer else math.inf
    return fewer if lost < LearnSettings().least * floors.avoidable(found.base) else both


def _instead_of_the_last(
    session: Session, search: Search, found: Found, laws: list[Learning], place: str
) -> list[Learning]:
    """The laws with the best one at a place instead of the last, all refitted; empty if none passes its test there."""
    present, kept = laws[-1].present, found.final.candidate
    if present.candidate.labels != kept.labels:  # the last law has made effects needless
        if len(laws) > 1:
            return []
        candidate = search.models.alone(kept.effects, kept.nuisances, transient=present.candidate.transient)
        present = converged(begin(candidate, present.values, present.simulation, present))
        if not present.good:
            return []
    beside, floors = [one.fits[0] for one in laws[:-1]], found.floors
    learner = Learner(
        session, present, floors, search.tried, search.vetoed, search.say.doing, beside=beside, only=place
    )
    new = learner.learn()
    return [] if new.law is None else _all_refitted([*laws[:-1], new], session, search, floors)


def _all_refitted(laws: list[Learning], session: Session, search: Search, floors: Floors) -> list[Learning]:
    """The laws refitted at once; the last one was learned beside the others. Its shares are then of what the first one
    could explain."""
    *others, last = laws
    if not others:
        return laws
    scale = floors.avoidable(last.present) / max(floors.avoidable(others[0].present), 1e-9)
    last = replace(last, shares=tuple(scale * share for share in last.shares))
    search.say.doing("refitting all laws")
    fits = together([one.fits[0] for one in laws], session.settings.least_gain)
    return [replace(one, fits=(fit, *one.fits[1:])) for one, fit in zip([*others, last], fits, strict=True)]


def _of_each_place(
    laws: Sequence[Learning], history: Sequence[ErrorStep]
) -> tuple[tuple[LearnedLaw, ...], tuple[LearnedLaw, ...]]:
    """The laws that were kept, and the best law of each place, as `Diagnosis` has them."""
    steps = range(-len(laws), 0)
    answers = [
        answered(one, (history[k - 1].validate, history[k].validate)) for k, one in zip(steps, laws, strict=True)
    ]
    learned = tuple(law for kept, _ in answers for law in kept)
    taken = {law.slot for law in learned}
    return learned, (*learned, *(law for _, places in answers[:1] for law in places if law.slot not in taken))


def _next_test(session: Session, found: Found) -> tuple[NextTest | None, list[Note]]:
    """A test that would separate the last effect from the first rival tied with it, or a note why there is none."""
    step = found.steps[-1] if found.steps else None
    if step is None or step.added not in found.losses or not step.rivals[0].ties:
        return None, []
    rival = next(one.fit for one in step.rivals if one.added == step.rivals[0].ties[0])
    try:
        return next_test(session, step.model, rival), []
    except BadInput as error:  # these tests have no log over time, or not one command
        return None, [Note(NoteCode.NO_NEXT_TEST, {"reason": str(error)})]


def _in_true_form(found: Found, search: Search, *, keep: bool) -> Found:
    """The result with the true forms of its effects, without those that pass their test in their smooth form alone.

    Args:
        keep: whether all effects stay, as they were asked for.
    """
    if not found.final.names:
        return found
    final = _alone(found.final, search)
    for effect in [] if keep else [one for one in final.candidate.effects if one.smooth]:
        smaller = search.without(found.final, effect.name)
        if search.test(smaller, final).verdict is not Verdict.BETTER:
            losses = {label: loss for label, loss in found.losses.items() if label != effect.name}
            smaller = smaller if smaller.names else found.base
            return _in_true_form(replace(found, final=smaller, losses=losses, more=True), search, keep=keep)
    return replace(found, final=final)


def _alone(fit: FinalFit, search: Search, *, transient: bool = False) -> FinalFit:
    """The model compiled with its own effects only, in their true form, and refitted to the end from the fit's values.

    If this form differs from the search's, runs are ten times finer. Returns `fit` if it does not compile or run.
    """
    try:
        candidate = search.models.alone(fit.candidate.effects, fit.candidate.nuisances, transient=transient)
    except BadInput:
        return fit
    alike = candidate.transient == fit.candidate.transient and not candidate.has_events
    same = alike and not any(effect.smooth for effect in candidate.effects)
    simulation = fit.simulation if same else search.fine.finer()
    again = converged(begin(candidate, fit.values, simulation, fit if alike else None))
    return again if again.good else fit


def _kept(found: Found, models: Sequence[FinalFit], final: FinalFit, search: Search) -> Named:
    """Steps of the error history beyond the base model; effects that are significant only together share a step."""
    if models:
        return [(fit.names[-1], final if fit is models[-1] else _alone(fit, search)) for fit in models]
    kept, steps, waiting = set(final.candidate.labels), list[tuple[str, FinalFit]](), list[str]()
    for step in found.steps:
        if step.added not in kept:
            continue
        waiting.append(step.added)
        if set(step.model.candidate.labels) <= kept and not step.on_trial:
            steps.append((" + ".join(waiting), step.model))
            waiting = []
    if final.names:
        last = " + ".join([*(waiting or [steps.pop()[0] if steps else " + ".join(final.names)])])
        steps.append((last, final))
    return [(name, fit if fit is final else _alone(fit, search)) for name, fit in steps]


def _said(say: Progress, history: Sequence[ErrorStep]) -> None:
    for step in history:
        parts = [f"{name} {value:.3f}" for name, value in (("fitted", step.fit), ("held out", step.validate)) if value]
        say.entered(step, f"{step.step}: residual over noise, {', '.join(parts)}")
