"""Learn a law that no catalogue has: screen all laws, refit the best ones, keep the winner if it passes its test."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pysim.diagnosis import rivals
from pysim.diagnosis.floors import Floors
from pysim.diagnosis.learn.basis import Array, closer
from pysim.diagnosis.learn.fit import LawFit, begun, ended, moved, raced, settled, started
from pysim.diagnosis.learn.screening import (
    LawModel,
    Ranked,
    distinct,
    over_all,
    remembering,
    screen,
    seen,
    with_moved,
)
from pysim.diagnosis.left import tone_rate
from pysim.diagnosis.refit import FinalFit, Pairs, converged, left_out
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import LearnSettings
from pysim.effects.learned import TIME, Law, Place, Term, curve_basis, places
from pysim.identify.greybox import Simulation
from pysim.types import BadInput
from pysim.types.answer import GainTest, Verdict
from pysim.types.factor import Form

Say = Callable[[str], None]
# A smaller model, a larger one and the test of its gain -> the test with vetoes by validation logs and left-out blocks.
# Pairs of both that were refitted without some logs are validated by these logs.
Veto = Callable[[FinalFit, FinalFit, GainTest, Pairs], GainTest]


@dataclass(frozen=True)
class Learning:
    """The result of learning a law beside one model.

    Args:
        present: the model that lacks something.
        ranked: every law as it was screened to first order, the best first.
        fits: refitted laws, the best first.
        test: of the best one; None if none was refitted.
        shares: share of each refitted law in the avoidable sum of squares, 0 ... 1.
        alternatives: other places whose laws the data do not separate from the best one.
        inflated: lambda of the best law's gain.
        refused: place -> why no law could be tried there.
        signals: samples of the model's variables in the fitted logs, see `seen`.
    """

    present: FinalFit
    ranked: tuple[Ranked, ...]
    fits: tuple[LawFit, ...] = ()
    test: GainTest | None = None
    shares: tuple[float, ...] = ()
    alternatives: tuple[str, ...] = ()
    inflated: float = 1.0
    refused: Mapping[str, str] = field(default_factory=dict)
    signals: Mapping[str, Array] = field(default_factory=dict, repr=False)

    @property
    def law(self) -> LawFit | None:
        """The best law if it passed its test; else None."""
        return self.fits[0] if self.test is not None and self.test.verdict is Verdict.BETTER else None


class Learner:
    """Learns laws beside one model.

    Args:
        session: gives the places and compiles the laws (`build_law`).
        present: the refitted model that lacks something; only if it is transient, laws over time are tried.
        floors: noise floor of each channel.
        tried: number of effects tried before, for the Bonferroni correction.
        veto: see Veto.
        say: called with what is being done.
        beside: laws that the model has already, held; a slot takes one.
        only: name of the one place where a law may be; "" for all.
    """

    def __init__(
        self,
        session: Session,
        present: FinalFit,
        floors: Floors,
        tried: int,
        veto: Veto,
        say: Say,
        settings: LearnSettings | None = None,
        beside: Sequence[LawFit] = (),
        only: str = "",
    ) -> None:
        assert session.build_law is not None
        self._compile = session.build_law
        self._session, self._present, self._floors, self._tried = session, present, floors.sd, tried
        self._veto, self._say, self._settings = veto, say, settings or LearnSettings()
        self._beside, self._only = tuple(beside), only
        self._refused: dict[str, str] = {}
        self._rough = floors.roughest(present, session.settings.fine)

    def learn(self) -> Learning:
        """Screen all laws, refit the best ones, and test the winner."""
        if not self._rough.good:
            return Learning(self._present, ())
        taken = {one.law.place.name for one in self._beside}
        every = places(self._session.slots, self._session.model)
        where = [one for one in every if one.name not in taken and self._only in ("", one.name)]
        signals, choosing = (seen(self._present, where, use) for use in ("fit", "validate"))
        if not signals:
            return Learning(self._present, ())
        states = self._present.candidate.model.abilities.states
        self._say("compiling laws")
        where = [with_moved(place, signals, states) for place in where]
        models = {place.key: model for place in where if (model := self._model(place, self._settings.knots))}
        if not models:
            return Learning(self._present, (), refused=self._refused)
        laws = distinct([one.place for one in models.values()], signals)
        clock = self._session.has_clock and self._present.candidate.transient
        laws = [law for law in laws if clock or law.argument != TIME]
        self._say(f"trying {len(laws)} laws at {len(models)} places")
        ranked = screen(self._rough, models, laws, signals, choosing, self._floors)
        fits = self._raced(models, ranked, ranked)
        if not fits or self._share(fits[0]) < 1 - self._settings.least:
            others, more = self._with_memory(
                [law for law in laws if not law.place.sides[0].output_rate], signals, choosing
            )
            ranked, laws = sorted([*ranked, *more], key=lambda one: -one.score), [*laws, *(one.law for one in more)]
            fits = self._ordered([*fits, *self._raced(others, more, ranked)])
        if not fits:
            return Learning(self._present, tuple(ranked), refused=self._refused, signals=signals)
        self._say(f"refitting {fits[0].law.label}")
        best = self._finished(fits[0])
        test, end = self._tested(best, len(laws)), (best, *fits[1:])
        return Learning(
            self._present,
            tuple(ranked),
            end,
            test,
            tuple(map(self._share, end)),
            self._ties(fits),
            self._colour(best, self._present),
            self._refused,
            signals,
        )

    def _model(self, place: Place, count: int, *, memory: bool = False) -> LawModel | None:
        terms = [*(one.term for one in self._beside), Term(place, count, memory)]
        try:
            model = self._compile(self._present.candidate.effects, terms)
        except BadInput as error:
            self._refused[place.name] = str(error)
            return None
        return LawModel(place, count, self._rough, model, memory)

    def _with_memory(
        self, laws: Sequence[Law], signals: Mapping[str, Array], choosing: Mapping[str, Array]
    ) -> tuple[dict[str, LawModel], list[Ranked]]:
        """Compiled models and screened laws with bristles and tones: for each place and form the best number of the
        factor over one argument, then that number over the other arguments."""
        session = self._session
        clock = session.has_clock and self._present.candidate.transient
        rate = tone_rate(self._rough, session.dataset, session.settings.false_alarm) if clock else None
        starts = remembering(laws, signals, rate)
        where = dict.fromkeys(law.place for law in starts)
        models = {one.key: model for one in where if (model := self._model(one, self._settings.knots, memory=True))}
        starts = [law for law in starts if law.place.key in models]
        self._say(f"trying bristles and tones at {len(models)} places")
        best: dict[tuple[Place, Form, int | None], Ranked] = {}
        for one in screen(self._rough, models, starts, signals, choosing, self._floors):
            best.setdefault((one.law.place, one.law.form, one.law.by), one)
        others = over_all([one.law for one in best.values()], laws)
        more = screen(self._rough, models, others, signals, choosing, self._floors)
        return models, sorted([*best.values(), *more], key=lambda one: -one.score)

    def _raced(self, models: Mapping[str, LawModel], some: Sequence[Ranked], ranked: Sequence[Ranked]) -> list[LawFit]:
        """Refit some laws for some iterations, those near the best of all that are ranked, and the finalists as long as
        they gain more than they lack to the best; the best first."""
        chosen = [one for one in some if one.score > 0 and one.score >= self._settings.near * ranked[0].score]
        running: list[LawFit] = []
        for one in chosen[: self._settings.most]:
            self._say(f"refitting {one.law.label}")
            fit = moved(begun(models[one.law.place.key], one, self._rough.simulation), self._settings.heat)
            if fit.fit.good and fit.cost < self._rough.point.cost:
                running.append(fit)
        running, finalists = self._ordered(running), self._session.settings.finalists
        further = raced(running[:finalists], lambda fit: moved(fit, self._settings.heat))
        return self._ordered([*further, *running[finalists:]])

    def _ordered(self, fits: Sequence[LawFit]) -> list[LawFit]:
        """The laws, the lowest penalised cost first; all count with one lambda, as effects do in `Search`."""
        inflated = self._inflated(fits) if fits else 1.0
        return sorted(fits, key=lambda one: self._scored(one, inflated))

    def _inflated(self, fits: Sequence[LawFit]) -> float:
        """Median lambda of the laws that gain much."""
        gains = [self._rough.point.cost - one.cost for one in fits]
        much = self._session.settings.promising * max(gains)
        return float(np.median([self._colour(a, self._rough) for a, b in zip(fits, gains, strict=True) if b >= much]))

    def _scored(self, one: LawFit, inflated: float) -> float:
        """Penalised cost relative to the present model, nats; the lowest is best."""
        gain, count = self._rough.point.cost - one.cost, rivals.samples(self._rough)
        return -rivals.penalised(gain, one.df, inflated, count)

    @staticmethod
    def _colour(one: LawFit, present: FinalFit) -> float:
        left = rivals.of(one.fit)
        return rivals.effective(left, rivals.of(present).residual - left.residual)

    def _finished(self, one: LawFit) -> LawFit:
        """Refit a law to the end; double its knots as long as the data resolve the corners and the law gets better.

        Only the last refit has the solver settings of models that are kept; those before are rougher and cheaper.
        """
        settings, rough = self._settings, self._rough.simulation
        best = settled(one, settings.heat, self._session.settings.least_gain)
        while best.fit.good and best.coarse and 2 * best.knots.size - 1 <= settings.most_knots:
            finer = self._model(best.law.place, 2 * best.knots.size - 1, memory=best.model.memory)
            if finer is None:
                break
            k = closer(best.knots, best.values)
            x = np.append(best.fit.point.x[: -best.knots.size], curve_basis(k, best.knots) @ best.values)
            smooth = replace(best.smoothness, knots=k)
            again = started(finer, best.law, k, best.unit, smooth, x, rough, best.fit.point.carried)
            again = settled(again, settings.heat, self._session.settings.least_gain)
            inflated = self._inflated([best])
            if not again.fit.good or self._scored(again, inflated) >= self._scored(best, inflated):
                break
            best = again
        for simulation in self._finer(rough):
            own, point = (best.law, best.knots, best.unit, best.smoothness), best.fit.point
            again = started(best.model, *own, point.x, simulation, point.carried)
            if not again.fit.good:
                return one
            best = ended(settled(again, settings.heat, self._session.settings.least_gain))
        return best

    def _finer(self, rough: Simulation) -> list[Simulation]:
        """Solver settings, ten times finer each, up to those of models that are kept; so most iterations are cheap."""
        found = [self._present.simulation]
        while found[0].solver.rtol < 0.1 * rough.solver.rtol:
            found.insert(0, found[0].finer(10.0).searching())
        return found

    def _share(self, one: LawFit) -> float:
        """Share of the avoidable sum of squares that a law explains, 0 ... 1."""
        residuals = one.fit.candidate.residuals(one.fit.simulation)
        floors = np.array([self._floors[channel] ** 2 for channel in residuals.channels])
        before, after = (fit.point.squares / floors for fit in (self._present, one.fit))
        most = float(np.sum(np.maximum(before - residuals.samples, 0.0)))
        return float(np.clip(float(np.sum(before - after)) / max(most, 1e-9), 0.0, 1.0))

    def _ties(self, fits: Sequence[LawFit]) -> tuple[str, ...]:
        """Other places with a law that the data do not separate from the best one, after the rule of `Search`."""
        best, own, found = fits[0], rivals.of(fits[0].fit), dict[str, None]()
        inflated = self._inflated(fits)
        for one in fits[1:]:
            reach = rivals.reach(own, rivals.of(one.fit), self._session.settings.tie)
            if one.law.place != best.law.place and self._scored(one, inflated) - self._scored(best, inflated) < reach:
                found[one.law.place.name] = None
        return tuple(found)

    def _tested(self, one: LawFit, laws: int) -> GainTest:
        """F test with the curve's effective number of coefficients, then the least share, then the vetoes."""
        present, gain = self._present, self._present.point.cost - one.cost
        size, choices = present.candidate.size + math.ceil(one.df), laws + self._tried
        test = rivals.gain_test(present, one.fit, gain, one.df, size, choices, self._session.settings)
        if test.verdict is not Verdict.BETTER:
            return test
        if self._share(one) <= self._settings.least:
            return replace(test, verdict=Verdict.NO_BETTER)
        return self._veto(present, one.fit, test, self._refitted_without(one))

    def _refitted_without(self, one: LawFit) -> Pairs:
        """The present model and the law, refitted without some of the logs each time, if no log may choose.

        Source: Stone 1974, Journal of the Royal Statistical Society B 36:111: cross-validation.
        """
        logs = self._present.candidate.problem.observations
        if len(logs) < 2 or any(log.use != "fit" for log in logs):
            return []
        self._say(f"refitting {one.law.label} without some of the logs")
        count = min(len(logs), self._settings.folds)
        folds = [{source for log in logs[k::count] for source in log.sources} for k in range(count)]
        return [(converged(left_out(self._present, fold)), one.without(fold).fit) for fold in folds]
