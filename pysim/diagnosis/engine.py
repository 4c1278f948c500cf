"""Entry points of the diagnosis: the whole search, and each of its steps alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from pysim.diagnosis import verdict
from pysim.diagnosis.candidate import Models, Refused
from pysim.diagnosis.checkpoint import Checkpoint, whose
from pysim.diagnosis.error_history import error_step, held_still
from pysim.diagnosis.law_search import LawSearch, of_each_place
from pysim.diagnosis.learn.learn import Learning
from pysim.diagnosis.learn.outside import outside_laws
from pysim.diagnosis.left import follows, tone
from pysim.diagnosis.next_test import next_test
from pysim.diagnosis.progress import Progress, Say
from pysim.diagnosis.refit import FinalFit, finest, integrated
from pysim.diagnosis.search import Found, Search
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import LearnSettings
from pysim.identify.greybox import Simulation
from pysim.types import BadInput, Effect, NextTest, Note, NoteCode
from pysim.types.answer import PRIOR, REFIT, Diagnosis, ErrorStep, Left, Verdict

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
    search_of_laws, laws = LawSearch(session, search), list[Learning]()
    learning = search_of_laws.first(found) if wanted and not final.candidate.has_events else None
    if learning is not None and learning.law is not None:
        found, account, laws = _with_laws(session, search, search_of_laws, found, named, learning)
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
    learned, missing = of_each_place(laws or ([learning] if learning else []), history)
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


def _with_laws(
    session: Session, search: Search, search_of_laws: LawSearch, found: Found, models: Named, first: Learning
) -> tuple[Found, _Account, list[Learning]]:
    """The result with a law, and with further ones as long as much is missing; its account; and the laws.

    Effects, sensor errors and doubts that a law made needless are left out, and steps of the history that had these.
    """
    more, steps = [first], list[tuple[str, FinalFit]]()
    for _ in range(max(session.settings.max_effects, 1)):
        laws, law = more, more[-1].fits[0]
        kept, floors = set(law.fit.candidate.labels), found.floors.with_(law.fit)
        losses = {label: loss for label, loss in found.losses.items() if label in kept}
        found = replace(found, final=law.fit, floors=floors, losses=losses, more=False)
        steps = [*steps[: len(laws) - 1], (law.law.label, law.fit)]
        named = [one for one in (*models, *steps) if kept.issuperset(one[1].candidate.labels)]
        account = _account(session, found, named, finest(search.fine, law.fit.simulation))
        more = search_of_laws.another(found, laws) if _lacks_much(found, account) else laws
        if more is laws:
            break
    return found, account, laws


def _lacks_much(found: Found, account: _Account) -> bool:
    """Whether more than a small share of what the base model lacked is left."""
    floors = found.floors
    much = floors.avoidable(found.final) > LearnSettings().least * floors.avoidable(found.base)
    return much and not account.complete


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
    final = search.in_true_form(found.final)
    for effect in [] if keep else [one for one in final.candidate.effects if one.smooth]:
        smaller = search.without(found.final, effect.name)
        if search.test(smaller, final).verdict is not Verdict.BETTER:
            losses = {label: loss for label, loss in found.losses.items() if label != effect.name}
            smaller = smaller if smaller.names else found.base
            return _in_true_form(replace(found, final=smaller, losses=losses, more=True), search, keep=keep)
    return replace(found, final=final)


def _kept(found: Found, models: Sequence[FinalFit], final: FinalFit, search: Search) -> Named:
    """Steps of the error history beyond the base model; effects that are significant only together share a step."""
    if models:
        return [(fit.names[-1], final if fit is models[-1] else search.in_true_form(fit)) for fit in models]
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
    return [(name, fit if fit is final else search.in_true_form(fit)) for name, fit in steps]


def _said(say: Progress, history: Sequence[ErrorStep]) -> None:
    for step in history:
        parts = [f"{name} {value:.3f}" for name, value in (("fitted", step.fit), ("held out", step.validate)) if value]
        say.entered(step, f"{step.step}: residual over noise, {', '.join(parts)}")
