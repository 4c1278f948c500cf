"""Which physical effect is missing: the steps in a row, and each of them alone."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from pysim.diagnose.answer import answered, decided
from pysim.diagnose.corrections import Settled, recounted
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.jumps import jumping
from pysim.diagnose.locating.locate import locate
from pysim.diagnose.next_test import next_test
from pysim.diagnose.ranking import rows
from pysim.diagnose.refit import refit_from
from pysim.diagnose.rounds import Tried, screened
from pysim.diagnose.screen import screen
from pysim.diagnose.search import search
from pysim.diagnose.settling import plausible, settle
from pysim.diagnose.story import Say, Story, begin
from pysim.diagnose.strengths import declared, setting
from pysim.diagnose.subject import Subject, extended
from pysim.diagnose.trials import refitted
from pysim.types import BadInput, Diagnosis, Effect, Missing, NextTest
from pysim.types.diagnosis import UNKNOWN

# Effects that may be added one after the other.
MOST = 3
# How often a diagnosis is begun again without logs.
_AGAIN = 2
_JUMPS = (
    "{log}: left out of the fit, because the model's answer jumps there where a parameter moves by 0.3 percent, as "
    "where it has several steady states"
)
_NOT_AT_HAND = "the model's Modelica class is not at hand, so no effect of the catalogue could be tried"


def diagnose(
    subject: Subject,
    *,
    seed: int = 0,
    most: int = MOST,
    workers: int | None = None,
    progress: Say | None = None,
    journal: Path | None = None,
) -> Diagnosis:
    """Answer which effect of the catalogue the data demand, that they demand none, or that it is unknown.

    Args:
        subject: model, measurements, catalogue.
        seed: of the bootstrap; the same seed gives the same answer.
        most: effects that may be added one after the other.
        workers: runs at a time; all cores where None. The answer does not depend on it.
        progress: told what is being done and what was learned; what it raises ends the diagnosis.
        journal: file that a diagnosis which was stopped goes on from, with the same answer.
    Raises:
        BadInput: the base model cannot be simulated at its own parameters, or a journal of another diagnosis.
    """
    told: dict[str, object] = {"step": "diagnose", "most": most}
    story = begin(subject, seed=seed, workers=workers, progress=progress, journal=journal, settings=told)
    base, final = _searched(story, most)
    for _ in range(_AGAIN):
        story.now("asking whether the model jumps")
        sources = story.journal.once("jumps", partial(jumping, final.lean, final.at))
        story.stage("jumps")
        if not sources:
            break
        line = _JUMPS.format(log=", ".join(sources))
        story.say(f"{line}; begun again")
        story = story.without(sources)
        story.note(line)
        base, final = _searched(story, most)
    verdict, reason = decided(story, base, final, why_none="" if most else "no effect was tried")
    missing = _missing(story, final) if verdict == UNKNOWN else ()
    return answered(story, final.at, verdict, reason, missing, _next_test(story))


def _searched(story: Story, most: int) -> tuple[Settled, Settled]:
    """The refitted base model, and with the effects that the data demand."""
    nominal = _prior(story)
    base = _refit(story, nominal)
    if story.subject.build_variant is None:
        story.note(_NOT_AT_HAND)
    elif story.subject.catalogue:
        return search(story, nominal, base, most)
    return base, base


def against(
    subject: Subject,
    *,
    refitted: bool = True,
    workers: int | None = None,
    progress: Say | None = None,
    journal: Path | None = None,
) -> Diagnosis:
    """Hold the model against the measurements, as it is and refitted.

    Args:
        refitted: without, the model is only compared as it is.
    Returns:
        the ledger's steps "prior" and "refit", where the model fails, and its parameters.
    Raises:
        BadInput: as `diagnose`.
    """
    told: dict[str, object] = {"step": "against"}
    story = begin(subject, seed=0, workers=workers, progress=progress, journal=journal, settings=told)
    prior = _prior(story)
    last = _refit(story, prior) if refitted else Settled.as_is(story.ruler.plain, prior)
    return answered(story, last.at, *decided(story, last, last, why_none="no effect was tried"))


def rank(
    subject: Subject,
    *,
    seed: int = 0,
    workers: int | None = None,
    progress: Say | None = None,
    journal: Path | None = None,
) -> Diagnosis:
    """Screen the catalogue at the refitted model and refit the promising ones; nothing is added.

    Returns:
        as `against`, with the ranking.
    Raises:
        BadInput: as `diagnose`, or a model whose class is not at hand.
    """
    _needs_class(subject)
    story = begin(subject, seed=seed, workers=workers, progress=progress, journal=journal, settings={"step": "rank"})
    nominal = _prior(story)
    base = _refit(story, nominal)
    tried = screened(story, base.whole)
    found = refitted(story, tried, nominal) if tried.promises else {}
    story.ranking += rows(story, tried, found, 1)
    return answered(story, base.at, *decided(story, base, base, why_none="effects were ranked, none was added"))


def add(
    subject: Subject,
    effects: Sequence[Effect],
    *,
    workers: int | None = None,
    progress: Say | None = None,
    journal: Path | None = None,
) -> Diagnosis:
    """Add given effects one after the other and refit everything each time.

    Args:
        effects: in the order in which they are added.
    Returns:
        as `against`, with a step of the ledger per effect, and the effects' sizes.
    Raises:
        BadInput: as `rank`, an effect that the model has no place for, or one that cannot be simulated.
    """
    _needs_class(subject)
    names = [effect.name for effect in effects]
    told: dict[str, object] = {"step": "add", "effects": names}
    story = begin(subject, seed=0, workers=workers, progress=progress, journal=journal, settings=told)
    base, current = _with(story, effects)
    return answered(story, current.at, *decided(story, base, current))


def located(
    subject: Subject,
    effects: Sequence[Effect] = (),
    *,
    workers: int | None = None,
    progress: Say | None = None,
    journal: Path | None = None,
) -> Diagnosis:
    """Estimate, at each place of the model, the term that would close the gap; no effect is named for it.

    Args:
        effects: that the model is to have already.
    Returns:
        as `add`, with the missing terms, the most likely place first.
    Raises:
        BadInput: as `add`.
    """
    if effects:
        _needs_class(subject)
    told: dict[str, object] = {"step": "located", "effects": [effect.name for effect in effects]}
    story = begin(subject, seed=0, workers=workers, progress=progress, journal=journal, settings=told)
    base, current = _with(story, effects)
    return answered(
        story, current.at, *decided(story, base, current, why_none="no effect was tried"), _missing(story, current)
    )


def _next_test(story: Story) -> NextTest | None:
    """What would separate the last two that were tied; None where none were, or no test would."""
    if story.tied is None:
        return None
    story.now("looking for a test that separates the tied")
    try:
        found = next_test(story.subject, *story.tied, workers=story.ruler.workers)
    except BadInput as error:
        story.note(f"no next test could be looked for: {error}")
        found = None
    story.stage("next test")
    if found is not None:
        story.say(f"next test: {found.about}")
    return found


def _missing(story: Story, current: Settled) -> tuple[Missing, ...]:
    """Terms at the places of a fitted model; at its inputs and outputs where it cannot be looked into."""
    story.now("looking where a term is missing")
    inside = story.subject.inside
    slots, probed = ((), None) if inside is None else (inside.slots, inside.probed)
    found = locate(story.subject, current.lean, current.at, slots=slots, probed=probed, progress=story.say)
    story.stage("locate")
    return found


def _with(story: Story, effects: Sequence[Effect]) -> tuple[Settled, Settled]:
    """The refitted base model, and with effects added one after the other."""
    nominal = _prior(story)
    current = base = _refit(story, nominal)
    for number, effect in enumerate(effects):
        story.now(f"adding {effect.name}")
        end = _added(story, current.whole, nominal if number == 0 else None, effect)
        if end is None:
            raise BadInput(f"the model cannot be simulated with {effect.name}; leave it out, or check its bounds")
        current = settle(story, end, end.name)
        story.stage("add")
        story.enter(effect.name, current.at)
    return base, current


def _prior(story: Story) -> Fitted:
    """The base model as it is, counted without nuisances."""
    what = extended(story.subject, ())
    story.now("comparing the model as it is")
    first = story.allow(what, what.space.to_search(what.space.start))
    for line in story.counting():
        story.note(line)
    if not first.good:
        why = story.ruler.failure(what, first.x) or str(first.failure or "") or "a number in its answer is not finite"
        raise BadInput(
            f"{what.model.label} cannot be simulated through the tests at its own parameters, {why}; set others with "
            "--set, or leave that test out"
        )
    nominal = recounted(story.ruler, story.ruler.plain, Fitted(what, first))
    story.stage("compare")
    story.enter("prior", nominal)
    return nominal


def _refit(story: Story, nominal: Fitted) -> Settled:
    """The base model refitted."""
    story.now("refitting the model")
    start = recounted(story.ruler.plain, story.ruler, nominal)
    base = story.fitted(nominal.what, "base", lambda: refit_from(story.ruler, nominal.what, start.point))
    assert base is not None  # the start was good, so the end is
    end = settle(story, plausible(story, base, "base", nominal), "base")
    story.stage("refit")
    story.enter("refit", end.at)
    return end


def _added(story: Story, current: Fitted, nominal: Fitted | None, effect: Effect) -> Fitted | None:
    """The model refitted with an effect, whether that is any use or not."""
    contender = story.extended(current, effect)
    footprints = screen(current, [contender])
    ruler = story.ruler_of(current.what)
    tried = Tried(current, ruler, {effect.name: contender}, footprints, {}, 0.0, story.blame(current).cost)
    found = refitted(story, tried, nominal, least=-1.0)
    if effect.name in found:
        return found[effect.name]
    space, values = (
        contender.what.space,
        setting(current.what, contender.what, effect, current.point.x, declared(effect)),
    )
    point = contender.ruler.evaluation(contender.what, space.to_search(np.array([values[n] for n in space.keys])))
    return Fitted(contender.what, point) if point.good else None


def _needs_class(subject: Subject) -> None:
    if subject.build_variant is None:
        raise BadInput(f"{_NOT_AT_HAND}; name its library")
