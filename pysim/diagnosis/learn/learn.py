"""Learn a law that no catalogue has: screen all of them, refit the best, keep the winner if it stands the test."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pysim.diagnosis import rivals
from pysim.diagnosis.learn.basis import closer
from pysim.diagnosis.learn.curve import curve_basis
from pysim.diagnosis.learn.fit import LawFit, begun, ended, moved, settled, started
from pysim.diagnosis.learn.laws import TIME, Place, Terms, places
from pysim.diagnosis.learn.screening import LawModel, Ranked, distinct, screen, seen
from pysim.diagnosis.left import Floors
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import LearnSettings
from pysim.identify.greybox import Simulation
from pysim.types import BadInput
from pysim.types.answer import GainTest, Verdict

Say = Callable[[str], None]
# A smaller model, a larger one and the test of its gain -> the test as logs and blocks that were not fitted see it.
Veto = Callable[[FinalFit, FinalFit, GainTest], GainTest]


@dataclass(frozen=True)
class Learning:
    """What learning beside one model came to.

    Args:
        present: the model that lacked something.
        ranked: every law to first order, the best first.
        fits: laws that were refitted, the best first.
        test: of the best of them; None where none was refitted.
        shares: of each of these fits, of the sum of squares over the floors that could be avoided, 0 ... 1.
        alternatives: other places whose laws the data do not tell from the best.
        inflated: lambda of the best.
        refused: place -> why no law could be tried there.
    """

    present: FinalFit
    ranked: tuple[Ranked, ...]
    fits: tuple[LawFit, ...] = ()
    test: GainTest | None = None
    shares: tuple[float, ...] = ()
    alternatives: tuple[str, ...] = ()
    inflated: float = 1.0
    refused: Mapping[str, str] = field(default_factory=dict)

    @property
    def law(self) -> LawFit | None:
        """The one that stood the test; None where nothing is added."""
        return self.fits[0] if self.test is not None and self.test.verdict is Verdict.BETTER else None

    @property
    def worth(self) -> float:
        """Penalised gain of that law, nats; minus infinity without one."""
        return self.test.penalised if self.test is not None and self.law is not None else -math.inf


class Learner:
    """Learns laws beside one model.

    Args:
        session: whose model; it must be able to compile laws.
        present: the model that lacks something, refitted; laws over time are tried where it is compared by transients.
        floors: noise of each channel.
        tried: effects that were tried before, which count as choices.
        veto: see Veto.
        say: gets what is being done.
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
    ) -> None:
        assert session.build_law is not None
        self._compile = session.build_law
        self._session, self._present, self._floors, self._tried = session, present, floors.sd, tried
        self._veto, self._say, self._settings = veto, say, settings or LearnSettings()
        self._refused: dict[str, str] = {}
        self._rough = floors.roughest(present, session.settings.fine)

    def learn(self) -> Learning:
        """The best law and whether it is kept."""
        if not self._rough.good:
            return Learning(self._present, ())
        where = places(self._session.slots, self._session.model)
        self._say("compiling laws")
        models = {place.key: model for place in where if (model := self._model(place, self._settings.knots))}
        signals = seen(self._present, self._present.candidate.model, [one.place for one in models.values()])
        laws = distinct([one.place for one in models.values()], signals) if signals else []
        clock = self._session.has_clock and self._present.candidate.transient
        laws = [law for law in laws if clock or law.argument != TIME]
        self._say(f"trying {len(laws)} laws at {len(models)} places")
        ranked = screen(self._rough, models, laws, signals, self._floors)
        chosen = [one for one in ranked if one.score > 0 and one.score >= self._settings.near * ranked[0].score]
        fits = self._raced([(models[one.law.place.key], one) for one in chosen[: self._settings.most]])
        if not fits:
            return Learning(self._present, tuple(ranked), refused=self._refused)
        self._say(f"refitting {fits[0].law.label}")
        best = self._finished(fits[0], models[fits[0].law.place.key])
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
        )

    def _model(self, place: Place, count: int) -> LawModel | None:
        try:
            model = self._compile(self._present.candidate.effects, Terms((place,), count))
        except BadInput as error:
            self._refused[place.name] = str(error)
            return None
        return LawModel(place, count, self._rough, model)

    def _raced(self, chosen: Sequence[tuple[LawModel, Ranked]]) -> list[LawFit]:
        """The laws some points on with every parameter, those that promise most some more; the best first."""
        running: list[tuple[LawModel, LawFit]] = []
        for model, one in chosen:
            self._say(f"refitting {one.law.label}")
            fit = moved(begun(model, one, self._rough.simulation), self._settings.heat)
            if fit.fit.good and fit.cost < self._rough.point.cost:
                running.append((model, fit))
        running.sort(key=lambda one: self._scored(one[1]))
        finalists = self._session.settings.finalists
        further = [moved(fit, self._settings.heat) for _, fit in running[:finalists]]
        fits = [*(fit for fit in further if fit.fit.good), *(fit for _, fit in running[finalists:])]
        return sorted(fits, key=self._scored)

    def _scored(self, one: LawFit) -> float:
        """Cost with the penalty of the effective coefficients, nats."""
        inflated, count = self._colour(one, self._rough), rivals.samples(self._rough)
        return -rivals.penalised(self._rough.point.cost - one.cost, one.edf, inflated, count)

    @staticmethod
    def _colour(one: LawFit, present: FinalFit) -> float:
        left = rivals.of(one.fit)
        return rivals.effective(left, rivals.of(present).residual - left.residual)

    def _finished(self, one: LawFit, model: LawModel) -> LawFit:
        """To the end, with twice the knots as long as the data see the corners and the law gets better by it.

        The last search alone takes the runs of what is kept.
        """
        settings, rough = self._settings, self._rough.simulation
        best = settled(one, settings.heat)
        while best.fit.good and best.coarse and 2 * best.knots.size - 1 <= settings.most_knots:
            finer = self._model(model.place, 2 * best.knots.size - 1)
            if finer is None:
                break
            k = closer(best.knots, best.values)
            x = np.append(best.fit.point.x[: -best.knots.size], curve_basis(k, best.knots) @ best.values)
            smooth = replace(best.smoothness, knots=k)
            again = started(finer, best.law, k, best.unit, smooth, x, rough, best.fit.point.carried)
            again = settled(again, settings.heat)
            if not again.fit.good or self._scored(again) >= self._scored(best):
                break
            best, model = again, finer
        for simulation in self._finer(rough):
            point = best.fit.point
            again = started(model, best.law, best.knots, best.unit, best.smoothness, point.x, simulation, point.carried)
            if not again.fit.good:
                return one
            best = ended(settled(again, settings.heat))
        return best

    def _finer(self, rough: Simulation) -> list[Simulation]:
        """Ten times finer each, up to the runs of what is kept: a search that crawls does so by cheap ones."""
        found = [self._present.simulation]
        while found[0].solver.rtol < 0.1 * rough.solver.rtol:
            found.insert(0, found[0].finer(10.0).searching())
        return found

    def _share(self, one: LawFit) -> float:
        """What a law takes of the sum of squares over the floors that could be avoided."""
        residuals = one.fit.candidate.residuals(one.fit.simulation)
        floors = np.array([self._floors[channel] ** 2 for channel in residuals.channels])
        before, after = (fit.point.squares / floors for fit in (self._present, one.fit))
        most = float(np.sum(np.maximum(before - residuals.samples, 0.0)))
        return float(np.clip(float(np.sum(before - after)) / max(most, 1e-9), 0.0, 1.0))

    def _ties(self, fits: Sequence[LawFit]) -> tuple[str, ...]:
        """Other places of which the data do not tell a law from the best (rule of `Search`), in the race."""
        best, own, found = fits[0], rivals.of(fits[0].fit), dict[str, None]()
        for one in fits[1:]:
            reach = rivals.reach(own, rivals.of(one.fit), self._session.settings.tie)
            if one.law.place != best.law.place and self._scored(one) - self._scored(best) < reach:
                found[one.law.place.name] = None
        return tuple(found)

    def _tested(self, one: LawFit, laws: int) -> GainTest:
        """The F test at the effective size, a curve counting by its effective coefficients; then the vetoes."""
        present, gain = self._present, self._present.point.cost - one.cost
        size, choices = present.candidate.size + math.ceil(one.edf), laws + self._tried
        test = rivals.gain_test(present, one.fit, gain, one.edf, size, choices, self._session.settings)
        if test.verdict is not Verdict.BETTER:
            return test
        if self._share(one) <= self._settings.least:
            return replace(test, verdict=Verdict.NO_BETTER)
        return self._veto(present, one.fit, test)
