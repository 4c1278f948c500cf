"""At which place of a model a term is missing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pysim.diagnose.answer import answered, decided
from pysim.diagnose.corrections import Settled, recounted
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.locate import locate
from pysim.diagnose.refit import refit_from
from pysim.diagnose.rounds import Tried
from pysim.diagnose.screen import screen
from pysim.diagnose.settling import plausible, settle
from pysim.diagnose.story import Say, Story, begin
from pysim.diagnose.strengths import declared, setting
from pysim.diagnose.subject import Subject, extended
from pysim.diagnose.trials import refitted
from pysim.types import BadInput, Diagnosis, Effect, Missing

_NOT_AT_HAND = "the model's Modelica class is not at hand, so no effect of the catalogue could be tried"


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
        with the missing terms, the most likely place first.
    Raises:
        BadInput: the base model cannot be simulated at its own parameters, an effect that the model has no place for or
            that cannot be simulated, or a model whose class is not at hand where there are effects.
    """
    if effects:
        _needs_class(subject)
    told: dict[str, object] = {"step": "located", "effects": [effect.name for effect in effects]}
    story = begin(subject, seed=0, workers=workers, progress=progress, journal=journal, settings=told)
    base, current = _with(story, effects)
    return answered(
        story, current.at, *decided(story, base, current, why_none="no effect was tried"), _missing(story, current)
    )


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
