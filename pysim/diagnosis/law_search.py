"""Search for laws that no catalogue has: the first takes the place of the effects or stands beside them, further ones
stand beside the first."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from pysim.diagnosis.floors import Floors
from pysim.diagnosis.learn.described import answered
from pysim.diagnosis.learn.fit import LawFit, together
from pysim.diagnosis.learn.learn import Learner, Learning
from pysim.diagnosis.learn.names import refines, without_the_unseated
from pysim.diagnosis.refit import FinalFit, begin, converged
from pysim.diagnosis.search import Found, Search
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import LearnSettings
from pysim.types.answer import ErrorStep, LearnedLaw

Laws = list[Learning]  # of one model, in the order in which they were learned


class LawSearch:
    """Searches laws beside the result of a search for effects."""

    def __init__(self, session: Session, search: Search) -> None:
        self._session, self._search, self._settings = session, search, LearnSettings()

    def first(self, found: Found) -> Learning:
        """Learn the best law beside the base model and, if it cannot take the place of the effects, beside these.

        It takes their place if it explains clearly more than they do ("unseats"), refines none of them, and a law
        beside them explains little more. Of the effects beside a law those are dropped that it makes needless.
        """
        floors, settings = found.floors, self._settings
        alone = self._beside(found.base, floors)
        if found.final is found.base:
            return alone
        base, final, left = floors.avoidable(found.base), floors.avoidable(found.final), math.inf
        if alone.law is not None and not any(refines(alone.law.law, one) for one in found.final.candidate.effects):
            own = floors.avoidable(alone.law.fit)
            left = own if final - own > settings.unseats * base else math.inf
        if left <= settings.least * base:
            return alone
        learning, best = self._beside(found.final, floors), final
        if learning.law is not None:
            tried, one = self._search.models.alone, learning.law
            law = without_the_unseated(
                self._session, one, learning.present, found.base, found.losses, tried, floors, self._search.tried
            )
            learning, best = replace(learning, fits=(law, *learning.fits[1:])), floors.avoidable(law.fit)
        return alone if left - best < settings.least * base else learning

    def another(self, found: Found, laws: Laws) -> Laws:
        """The laws and one more that is learned beside them, all refitted; the same laws if no more is found or
        allowed. Where a single log is all there is, another law could not be contradicted.

        The last law may only have stood in for the new one. It is left out if the best law at the new one's place,
        learned without it, leaves as little of the avoidable sum of squares, but for a small share.
        """
        many = len(laws) + len(found.final.names) >= self._session.settings.max_effects
        if many or len(self._session.dataset.logs()) < 2:
            return laws
        fits, floors = [one.fits[0] for one in laws], found.floors
        more = self._learner(fits[-1].held, floors, fits).learn()
        if more.law is None:
            return laws
        both = self._refitted([*laws, more], floors)
        fewer = self._instead_of_the_last(found, laws, more.law.law.place.name)
        lost = floors.avoidable(fewer[-1].fits[0].fit) - floors.avoidable(both[-1].fits[0].fit) if fewer else math.inf
        return fewer if lost < self._settings.least * floors.avoidable(found.base) else both

    def _beside(self, present: FinalFit, floors: Floors) -> Learning:
        """The best law beside a model."""
        if self._session.has_clock and not present.candidate.transient:
            present = self._search.in_true_form(present, transient=True)
        return self._learner(present, floors).learn()

    def _learner(self, present: FinalFit, floors: Floors, beside: Sequence[LawFit] = (), only: str = "") -> Learner:
        search = self._search
        return Learner(
            self._session, present, floors, search.tried, search.vetoed, search.say.doing, beside=beside, only=only
        )

    def _instead_of_the_last(self, found: Found, laws: Laws, place: str) -> Laws:
        """The laws with the best one at a place instead of the last, all refitted; empty if none passes its test."""
        present, kept = laws[-1].present, found.final.candidate
        if present.candidate.labels != kept.labels:  # the last law has made effects needless
            if len(laws) > 1:
                return []
            transient = present.candidate.transient
            candidate = self._search.models.alone(kept.effects, kept.nuisances, transient=transient)
            present = converged(begin(candidate, present.values, present.simulation, present))
            if not present.good:
                return []
        beside, floors = [one.fits[0] for one in laws[:-1]], found.floors
        new = self._learner(present, floors, beside, only=place).learn()
        return [] if new.law is None else self._refitted([*laws[:-1], new], floors)

    def _refitted(self, laws: Laws, floors: Floors) -> Laws:
        """The laws refitted at once; the last one was learned beside the others. Its shares are then of what the first
        one could explain."""
        *others, last = laws
        if not others:
            return laws
        scale = floors.avoidable(last.present) / max(floors.avoidable(others[0].present), 1e-9)
        last = replace(last, shares=tuple(scale * share for share in last.shares))
        self._search.say.doing("refitting all laws")
        fits = together([one.fits[0] for one in laws], self._session.settings.least_gain)
        return [replace(one, fits=(fit, *one.fits[1:])) for one, fit in zip([*others, last], fits, strict=True)]


def of_each_place(laws: Laws, history: Sequence[ErrorStep]) -> tuple[tuple[LearnedLaw, ...], tuple[LearnedLaw, ...]]:
    """The laws that were kept, and the best law of each place, as `Diagnosis` has them."""
    steps = range(-len(laws), 0)
    answers = [
        answered(one, (history[k - 1].validate, history[k].validate)) for k, one in zip(steps, laws, strict=True)
    ]
    learned = tuple(law for kept, _ in answers for law in kept)
    taken = {law.slot for law in learned}
    return learned, (*learned, *(law for _, places in answers[:1] for law in places if law.slot not in taken))
