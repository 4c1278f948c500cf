"""Search for the effects that the data demand: forward selection, then backward elimination from the richest model.

An effect may join without being significant (on trial). In the end each effect has to pass an F test, and neither
validation logs (use "validate") nor left-out blocks of the data may get worse with it.
Source: general to specific: Hendry and Krolzig 2005, The Economic Journal 115:C32; Mallows 1973, Technometrics 15:661.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Candidate, Models, Values
from pysim.diagnosis.checkpoint import Checkpoint
from pysim.diagnosis.floors import Floors
from pysim.diagnosis.progress import Progress
from pysim.diagnosis.refit import FinalFit, Pairs, advance, begin, begin_anywhere, brought_near, converged, finest, race
from pysim.diagnosis.screen import Screened, best_of_each, screen, screened
from pysim.diagnosis.settings import Settings
from pysim.diagnosis.starts import Starts, with_sensor_errors
from pysim.identify.greybox import Simulation
from pysim.identify.greybox.beginning import settled_initial_states
from pysim.simulate import simulate_many
from pysim.types import BadInput, Effect, Trial
from pysim.types.answer import Detectable, GainTest, Verdict


@dataclass(frozen=True)
class Compared:
    """A candidate of one forward step, tested against the model that it extends.

    Args:
        fit: the refitted candidate.
        added: label of the effect or sensor error that it adds.
        test: F test of its gain.
        ties: labels of the step's other candidates that the data do not separate from it.
    """

    fit: FinalFit
    added: str
    test: GainTest
    ties: tuple[str, ...] = ()


@dataclass(frozen=True)
class Table:
    """All candidates that were tried as the next step from one model.

    Args:
        names: labels of the effects and sensor errors that the model has already.
        avoidable: nats that a model which leaves only noise would gain.
        rivals: refitted candidates, best first.
        looked: every effect as it was screened, at its best size.
        beyond: labels that pass their test but are no rivals, since their fitted size is not believable.
    """

    names: tuple[str, ...]
    avoidable: float
    rivals: Sequence[Compared]
    looked: Sequence[Screened]
    beyond: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step:
    """One forward step.

    Args:
        model: the refitted model after the step.
        added: label of the effect or sensor error that was added.
        on_trial: whether it was not significant alone, or gains less than `Settings.small` of what is avoidable.
        rivals: all refitted candidates of the step, best first.
    """

    model: FinalFit
    added: str
    test: GainTest
    on_trial: bool
    rivals: tuple[Compared, ...]


@dataclass(frozen=True)
class Found:
    """The result of the search.

    Args:
        base: the refitted base model.
        final: the model that is kept; the base model if no effect is.
        steps: forward steps, in their order.
        losses: label of each part that is kept -> test of what leaving it out costs.
        undecidable: whether some test had too few effective samples.
        more: whether more is missing than is kept: an effect was significant, but vetoed or of a size that is not
            believable; or the limit on the number of effects ended the search.
    """

    base: FinalFit
    final: FinalFit
    steps: tuple[Step, ...]
    floors: Floors
    losses: dict[str, GainTest] = field(default_factory=dict)
    undecidable: bool = False
    more: bool = False


class Search:
    """One search, with a cache of its refits.

    Args:
        models: makes candidates.
        fine: solver settings for models that are kept; candidates get larger tolerances.
        checkpoint: keeps finished refits in a file.
    """

    def __init__(
        self, models: Models, fine: Simulation, settings: Settings, say: Progress, checkpoint: Checkpoint
    ) -> None:
        self.models, self.rough, self.fine, self.settings, self.say = models, fine.rough(), fine, settings, say
        self._checkpoint = checkpoint
        self.floors, self.tried = Floors(), 0
        self._tables: dict[frozenset[str], Table] = {}
        self._fits: dict[tuple[frozenset[str], bool], FinalFit] = {}
        self._unfitted: dict[tuple[frozenset[str], bool, bool], tuple[FinalFit, rivals.Rows | None, float]] = {}
        models.watch = self._tried

    def _tried(self, fit: FinalFit) -> None:
        """Report a point's residual over the noise floors, which are the point's own until the base model is fitted."""
        floors = self.floors if self.floors.floors else self.floors.with_(fit)
        own = fit.candidate
        values = {key if isinstance(key, str) else ".".join(key): value for key, value in fit.values.items()}
        names = (*own.labels, *([own.law] if own.law else []))
        self.say.tried(Trial(names, floors.whole(fit), {} if own.law else values))

    def fit_base(self) -> FinalFit:
        """Refit the base model, and choose the tolerances and step limits of all later runs by it.

        Raises:
            BadInput: it cannot be simulated at its own parameters.
        """
        candidate = self.models.of(())
        self.say.doing("fitting the model")

        def found() -> FinalFit:
            first = begin_anywhere(candidate, self.models.session.begins, self.rough)
            if not first.good:
                failure = first.point.failure
                raise BadInput(f"{candidate.model.label} cannot be simulated at its own parameters: {failure}")
            return converged(first, self.fine)

        base = self._as_measured(self._fine_enough(self._once("base", found, candidate)))
        rough = self.floors.with_(base).roughest(base, self.settings.fine)
        most = self.settings.patience * _steps(rough)
        self.fine, self.rough = (
            replace(own, solver=replace(own.solver, max_steps=most)) for own in (base.simulation, rough.simulation)
        )
        return self._keep(replace(base, simulation=self.fine))

    def _as_measured(self, fit: FinalFit) -> FinalFit:
        """The fit with stepped sines simulated over time instead of as periodic orbits, if that fits clearly better.
        A slow transient may still be there when a log ends. All later models are then simulated over time too."""
        if fit.candidate.transient or all(one.domain == "time" for one in fit.candidate.problem.observations):
            return fit
        candidate = self.models.of(fit.candidate.effects, transient=True)
        other, least = begin(candidate, fit.values, fit.simulation, fit), fit.point.cost - self._hardly(fit)
        if not other.good or other.expected > least:
            return fit
        transient = self._once("base, transient", lambda: converged(other), candidate)
        if transient.point.cost > least:
            return fit
        self.models.all_transient = True
        return transient

    def _hardly(self, fit: FinalFit) -> float:
        """Gain in nats below which another way to simulate is not worth it."""
        return max(self.settings.least_gain, self.settings.small * self.floors.with_(fit).potential(fit))

    def _fine_enough(self, fit: FinalFit, enough: float = 0.0) -> FinalFit:
        """Refine the integration until its error is small beside the noise floor and finer runs gain hardly anything,
        or `enough` nats at most. The gain is asked too: the Jacobian of a sharp law errs before its signals do."""
        for _ in range(self.settings.refinements if fit.good else 0):
            other = begin(fit.candidate, fit.values, fit.simulation.finer(), fit)
            if not other.good:
                break
            hardly = max(self._hardly(fit), enough)
            is_fine = self.floors.with_(fit).between(fit, other) < self.settings.fine
            if is_fine and other.point.cost - other.expected < hardly:
                break
            finer = converged(other, enough=enough)
            if is_fine and other.point.cost - finer.point.cost < hardly:
                break
            fit = finer
        return fit

    def _once(self, part: str, find: Callable[[], FinalFit], candidate: Candidate) -> FinalFit:
        """The refit of a part: from the checkpoint, or found now."""
        return self._checkpoint.once(part, lambda: [find()], [candidate], self.fine)[0]

    @property
    def tables(self) -> tuple[Table, ...]:
        """The tables of all models that were extended, in order."""
        return tuple(self._tables.values())

    def detectable(self, fit: FinalFit) -> tuple[Detectable, ...]:
        """Size from which each effect that a model lacks would almost surely have been found (power of the F test).

        What an effect changes is scaled linearly from the size at which it was screened. Limits are left out, since
        they are not linear in their size. Empty if the model leaves more than noise, which hides effects.
        """
        table = self._tables.get(frozenset(fit.candidate.labels))
        if table is None or not self.floors.within(fit, self.settings.near):
            return ()
        left, count, found = rivals.of(fit), rivals.samples(fit), list[Detectable]()
        for one in table.looked:
            if one.change.size != left.residual.size or one.effect.limit:
                continue
            df, inflated = len(one.effect.parameters), rivals.effective(left, one.change)
            chance = self.settings.false_alarm / max(self.tried, 1)
            least = rivals.least_gain(chance, df, count, fit.candidate.size + df, inflated)
            sure = math.sqrt(2 * least) + self.settings.sure * math.sqrt(inflated)
            share = sure / float(np.linalg.norm(one.change / left.level))
            sizes = {p.name: share * abs(one.tried[p.name] - (p.off or 0.0)) for p in one.effect.strengths}
            found.append(Detectable(one.effect.name, sizes, {p.name: p.unit for p in one.effect.strengths}))
        return tuple(found)

    def as_it_is(self) -> FinalFit:
        """The nominal base model; only the initial states of the logs are estimated.
        Where it cannot be simulated at its own values, it is taken where the search begins.

        Raises:
            BadInput: it cannot be simulated.
        """
        candidate = replace(self.models.of(()), watch=None)  # it is no point of a search
        first = begin(candidate, {}, self.fine)
        if not first.good:
            first = begin(candidate, self.models.session.begins, self.fine)
        if not first.good:
            raise BadInput(f"{candidate.model.label} cannot be simulated at its own parameters: {first.point.failure}")
        residuals = candidate.residuals(self.fine)
        settled = settled_initial_states(residuals, candidate.model, candidate.space, first.point.x)
        point = first.evaluate(first.point.x, settled.carried)
        return replace(first, state=replace(first.state, best=point)) if point.good else first

    def with_effects(self, present: FinalFit, effects: Sequence[Effect]) -> FinalFit:
        """The model with these effects, refitted; the last one starts at the best of its screened sizes.

        Raises:
            BadInput: an effect cannot be compiled or simulated.
        """
        candidate = self.models.of(effects, present.candidate.nuisances)
        found = screened(candidate, effects[-1], self._beside(present, candidate.transient), self.rough)
        starts = [begin(candidate, one.values, self.rough, self._beside(present, candidate.transient)) for one in found]
        best = min(starts, key=lambda fit: fit.point.cost if fit.good else math.inf, default=None)
        if best is None or not best.good:
            raise BadInput(f"{effects[-1].name}: the model cannot be simulated with it")
        fit = self._fine_enough(converged(best, self.fine))
        self.fine = finest(self.fine, fit.simulation)
        return self._keep(fit)

    def run(self, base: FinalFit, most: int) -> Found:
        """Forward selection of at most `most` parts, then backward elimination."""
        self.floors = self.floors.with_(base)
        steps = self._forward(base, most)
        if not steps:
            return Found(base, base, (), self.floors, more=bool(self.expand(base).beyond))
        end = self._backward(base, steps)
        limited = len(steps) == most and not self.is_done(end.final)
        table = self._tables.get(frozenset(end.final.candidate.labels))
        return replace(end, more=end.more or limited or (table is not None and bool(table.beyond)))

    def is_done(self, fit: FinalFit) -> bool:
        """Whether every residual is so close to its noise floor that no further step on trial is worth it."""
        return self.floors.within(fit, self.settings.held_out)

    def _forward(self, base: FinalFit, most: int) -> list[Step]:
        """Forward steps, to the best rival each; after each step earlier choices may be exchanged for their rivals."""
        steps: list[Step] = []
        present, in_vain, worth = base, 0, self.floors.potential(base)
        while len(steps) < most:
            tried = self.expand(present)
            if not tried.rivals:
                break
            best = tried.rivals[0]
            sure = best.test.verdict is Verdict.BETTER and best.test.gain >= self.settings.small * tried.avoidable
            in_vain = 0 if sure else in_vain + 1
            gained = sum(s.test.gain for s in steps[len(steps) - in_vain + 1 :]) if in_vain > 1 else 0.0
            if in_vain > self.settings.on_trial or (not sure and self.is_done(present)):
                break
            if in_vain == self.settings.on_trial and gained + best.test.gain < self.settings.small * worth:
                break
            present = self._keep(self._fine_enough(converged(best.fit, self.fine)))
            self.fine = finest(self.fine, present.simulation)
            steps.append(Step(present, best.added, best.test, not sure, tuple(tried.rivals)))
            steps = self._exchanged(base, steps)
            present = steps[-1].model
            self.floors = self.floors.with_(present)
            self.say.learned(present, best.test)
        return steps

    def _exchanged(self, base: FinalFit, steps: list[Step]) -> list[Step]:
        """The steps, with a rival in place of an earlier choice if that does better together with the later steps.

        An earlier choice may have won its step only because it also imitated an effect that joined later.
        Source: Miller 2002, Subset Selection in Regression, section 3.7: sequential replacement.
        """
        for k, step in enumerate(steps[:-1]):
            present, first, *others = steps[-1].model, *step.rivals
            least, have = self.settings.promising * first.test.gain, present.candidate.labels
            others = [one for one in others if one.test.gain >= least and one.added not in have]
            fits = {first.added: present} | {one.added: self._in_place(present, first.added, one) for one in others}
            tested = [Compared(fit, name, self.test(base, fit)) for name, fit in fits.items() if fit.good]
            best = next(iter(self._ordered(tested)), first)
            if best is first:  # steps on trial that gain nothing together
                continue
            ranked = sorted(step.rivals, key=lambda one: one.added != best.added)
            untried = [name for name in first.ties if name not in fits and name not in have]
            ranked[0] = replace(ranked[0], ties=(*best.ties, *untried))
            steps[k] = replace(step, added=best.added, test=ranked[0].test, rivals=tuple(ranked))
            model = best.fit if best.fit.ended else converged(best.fit)
            for j in reversed(range(k, len(steps) if best.fit is not present else k)):
                steps[j] = replace(steps[j], model=self._keep(model))
                model = self.without(model, steps[j].added) if j > k else model
        return steps

    def _in_place(self, present: FinalFit, name: str, rival: Compared) -> FinalFit:
        """The present model with a rival in place of its part `name`, refitted to the end if it may do as well."""
        new = rival.fit.candidate.parts[rival.added]
        parts = [new if label == name else part for label, part in present.candidate.parts.items()]
        candidate = self.models.of_parts(parts, transient=present.candidate.transient)
        present = self._beside(present, candidate.transient)
        own = {key: v for key, v in rival.fit.values.items() if isinstance(key, tuple) and key[0] == rival.added}
        values = {key: v for key, v in present.values.items() if isinstance(key, str) or key[0] != name} | own

        def found() -> FinalFit:
            fit = advance(begin(candidate, values, present.simulation, present), self.settings.heat)
            if not fit.good:
                return fit
            reach = rivals.reach(rivals.of(present), rivals.of(fit), self.settings.tie)
            return converged(fit) if fit.expected < present.point.cost + reach else fit

        return self._once(
            f"{rival.added} in place of {name} of {' + '.join(present.candidate.labels)}", found, candidate
        )

    def expand(self, present: FinalFit) -> Table:
        """Screen and refit everything that may be added to a model, and test it; each model is extended once."""
        key = frozenset(present.candidate.labels)
        if key not in self._tables:
            self._tables[key] = self._expanded(present)
        return self._tables[key]

    def _expanded(self, present: FinalFit) -> Table:
        self.say.doing(f"trying effects beside {' + '.join(present.names) or 'the base model'}")
        beside = partial(self._beside, present)
        near = self.floors.within(present, self.settings.near)
        starts = Starts(beside, self.fine if near else self.rough, near, self.floors.potential(present), self.settings)
        wrong_by = self.settings.first_order_error if near and starts.could_pass(starts.potential) else None
        sizes = screen(self.models, beside, self.rough, fits=starts.simulation, wrong_by=wrong_by)
        tried = best_of_each(sizes)
        sensors = with_sensor_errors(starts.here(present.candidate.transient), self.models)
        self.tried = max(self.tried, len(tried) + len(sensors))

        def finish(fit: FinalFit) -> FinalFit:
            gain = starts.here(fit.candidate.transient).point.cost - fit.point.cost
            return self._fine_enough(converged(fit, self.fine), self.settings.small * gain)

        def raced() -> list[FinalFit]:
            return race(starts.runners(sizes, sensors, self.tried), self.settings, finish)

        part = f"beside {' + '.join(present.candidate.labels) or 'the base model'}"
        candidates = [one.candidate for one in tried] + [fit.candidate for fit in sensors]
        fits = self._checkpoint.once(part, raced, candidates, self.fine)
        have, compared, beyond = set(present.candidate.labels), list[Compared](), list[str]()
        for fit in fits:
            added = next(label for label in fit.candidate.labels if label not in have)
            one = Compared(fit, added, self.test(starts.like(fit), fit))
            if fit.believable(added, self.settings):
                compared.append(one)
            elif one.test.verdict is Verdict.BETTER:
                beyond.append(added)
        labels, avoidable = present.candidate.labels, self.floors.potential(present)
        return Table(labels, avoidable, self._ordered(compared), tried, tuple(beyond))

    def _beside(self, fit: FinalFit, transient: bool) -> FinalFit:
        """The fit as a rival is compared with it: if `transient`, refitted with stepped sines simulated over time."""
        if fit.candidate.transient == transient or fit.candidate.transient:
            return fit
        key = frozenset(fit.candidate.labels), True
        if key not in self._fits:
            other = self.models.of(fit.candidate.effects, fit.candidate.nuisances, transient=True)
            part = f"transient {' + '.join(fit.candidate.labels)}"
            find = partial(self._refitted, other, fit.values, fit)
            self._fits[key] = self._once(part, find, other)
        return self._fits[key]

    def in_true_form(self, fit: FinalFit, *, transient: bool = False) -> FinalFit:
        """The model compiled with its own effects only, in their true form, and refitted to the end from the fit's
        values. If this form differs from the search's, runs are ten times finer. Returns `fit` if it does not compile
        or run.
        """
        own = fit.candidate
        try:
            candidate = self.models.alone(own.effects, own.nuisances, transient=transient)
        except BadInput:
            return fit
        alike = candidate.transient == own.transient and not candidate.has_events
        same = alike and not any(effect.smooth for effect in candidate.effects)
        simulation = fit.simulation if same else self.fine.finer()
        again = converged(begin(candidate, fit.values, simulation, fit if alike else None))
        return again if again.good else fit

    def test(self, smaller: FinalFit, larger: FinalFit, choices: int | None = None) -> GainTest:
        """F test of the larger model against the smaller one, on the fitted logs.

        Args:
            choices: number of comparisons, for the Bonferroni correction; all candidates of a step if None.
        """
        smaller = self._beside(smaller, larger.candidate.transient)
        gain, size = smaller.point.cost - larger.point.cost, larger.candidate.size
        df = max(size - smaller.candidate.size, 1)
        return rivals.gain_test(smaller, larger, gain, df, size, choices or max(self.tried, 1), self.settings)

    def _ordered(self, compared: list[Compared]) -> list[Compared]:
        """Candidates with a gain, ordered by penalised gain (BIC at the effective sample size); the first has its ties.

        All count with the median lambda of those that gain much. If several gain nearly the same and leave only noise,
        the one with the fewest parameters is first: the others' further gain lies in the shape of the law.
        """
        good = [one for one in compared if one.test.gain > 0]
        if not good:
            return []
        count, most = rivals.samples(good[0].fit), max(one.test.gain for one in good)
        sizes = [one.test.effective_size for one in good if one.test.gain >= self.settings.promising * most]
        inflated = count / float(np.median(sizes))
        scored = [
            replace(
                one, test=replace(one.test, penalised=rivals.penalised(one.test.gain, one.test.df, inflated, count))
            )
            for one in good
        ]
        scored.sort(key=lambda one: -one.test.penalised)
        alike = (1 - self.settings.small) * scored[0].test.gain
        enough = [one for one in scored if one.test.gain >= alike and self.is_done(one.fit)] or scored[:1]
        first = min(enough, key=lambda one: one.test.df)
        before = [one.added for one in enough if one.test.penalised > first.test.penalised]
        ties = tuple(dict.fromkeys((*before, *self._ties(first, scored))))
        return [replace(first, ties=ties), *(one for one in scored if one is not first)]

    def _ties(self, best: Compared, others: Sequence[Compared]) -> tuple[str, ...]:
        """Labels of the converged candidates that the data do not separate from the best one."""
        own, found = rivals.of(best.fit), []
        for one in others:
            if one is best or not (one.fit.ended and best.fit.ended):
                continue
            if one.fit.candidate.transient != best.fit.candidate.transient:
                continue
            reach = rivals.reach(own, rivals.of(one.fit), self.settings.tie)
            if abs(best.test.penalised - one.test.penalised) < reach and one.test.gain > 0.5 * best.test.gain:
                found.append(one.added)
        return tuple(found)

    def _backward(self, base: FinalFit, steps: Sequence[Step]) -> Found:
        """Backward elimination: the least significant part leaves the model until every part passes its test."""
        richest = steps[-1].model
        on_trial = {step.added for step in steps if step.on_trial}
        final, losses, undecidable, more = richest, dict[str, GainTest](), False, False
        while final.names:
            losses = {label: self._loss(final, label, on_trial) for label in final.candidate.labels}
            undecidable |= any(one.verdict is Verdict.UNDECIDABLE for one in losses.values())
            worst = max(losses, key=lambda name: (losses[name].verdict is not Verdict.BETTER, losses[name].p_value))
            if losses[worst].verdict is Verdict.BETTER:
                break
            more |= losses[worst].verdict is Verdict.VETOED
            final = self.without(final, worst)
        if not final.names:
            return Found(base, base, tuple(steps), self.floors, {}, undecidable, more)
        return Found(base, final, tuple(steps), self.floors, losses, undecidable, more)

    def _loss(self, final: FinalFit, name: str, on_trial: set[str]) -> GainTest:
        """Test of a part by leaving it out: F test, believable size, then validation logs and left-out blocks."""
        chosen = sum(one in on_trial for one in final.candidate.labels)
        choices = math.comb(max(self.tried, 1), chosen + 1) if name in on_trial else max(self.tried, 1)
        labels, transient = _key(final.candidate)
        known = self._fits.get((labels - {name}, transient))
        if known is not None and (test := self.test(known, final, choices)).verdict is not Verdict.BETTER:
            return test  # another refit can only make the loss smaller
        smaller = self.without(final, name)
        test = self.test(smaller, final, choices)
        if test.verdict is not Verdict.BETTER:
            return test
        if not final.believable(name, self.settings):
            return replace(test, verdict=Verdict.VETOED)
        return self.vetoed(smaller, final, test)

    def vetoed(self, smaller: FinalFit, larger: FinalFit, test: GainTest, without: Pairs = ()) -> GainTest:
        """Check a gain on validation logs and left-out blocks: VETOED if either error grows by more than chance.
        What brings a misfit down to the noise is not vetoed by left-out blocks: one of them may alone tell its size.
        A law has to lower the error of the validation logs, as its curve may bend anywhere, and no effect that was
        refitted beside the smaller model may predict them better.

        Args:
            without: both models refitted without some logs, which validate them in place of validation logs.
        """
        smaller = self._beside(smaller, larger.candidate.transient)
        own, other = rivals.of(larger), rivals.of(smaller)
        share = rivals.shares_of_blocks(other.residual - own.residual, own.level, own.blocks)
        seen = int(np.sum(share >= self.settings.seen_share)) >= self.settings.seen_blocks
        after, before = (rivals.left_out_error(one, own.blocks, own.level).sum() for one in (own, other))
        vetoed = seen and after - before > rivals.reach(own, other, self.settings.tie)
        vetoed = vetoed and (self.is_done(smaller) or not self.is_done(larger))
        if held := self._held_out(without or [(smaller, larger)]):
            chance = 0.0 if larger.candidate.law else held[1]
            test, vetoed = replace(test, held_out=held[0]), vetoed or held[0] > chance
        table = self._tables.get(frozenset(smaller.candidate.labels)) if larger.candidate.law else None
        rises = [self._held_out([(one.fit, larger)]) for one in (table.rivals if table else ()) if one.fit.ended]
        vetoed |= any(rise is not None and rise[0] > rise[1] for rise in rises)
        return replace(test, verdict=Verdict.VETOED) if vetoed else test

    def _held_out(self, pairs: Pairs) -> tuple[float, float] | None:
        """Rise of the validation logs' cost with the larger models, and the rise by chance, nats; None without logs."""
        rises, reaches = list[float](), list[float]()
        for smaller, larger in pairs:
            if not larger.candidate.residuals(larger.simulation, "validate").observations:
                continue
            opened = not larger.candidate.has_events
            (own, cost), (other, before) = (self._beside_unfitted(one, opened) for one in (larger, smaller))
            if own is None and other is None:
                continue
            rises.append(cost - before)  # infinite if one cannot be simulated there
            reaches.append(0.0 if own is None or other is None else rivals.reach(own, other, self.settings.tie))
        return (math.inf if math.inf in rises else sum(rises), math.hypot(*reaches)) if rises else None

    def _beside_unfitted(self, fit: FinalFit, opened: bool) -> tuple[rivals.Rows | None, float]:
        """Rows (None if a run fails) and cost in nats of a fit on the validation logs, which it was not fitted to.
        If `opened`, the parameters may move towards these logs within their uncertainty (`brought_near`)."""
        key = (*_key(fit.candidate), opened)
        known = self._unfitted.get(key)
        if known is None or known[0] is not fit:
            residuals = fit.candidate.residuals(fit.simulation, "validate")
            residuals = replace(residuals, nuisances=(), known=fit.sensor_errors)
            model, space = fit.candidate.model, fit.candidate.space
            point = settled_initial_states(residuals, model, space, fit.point.x)
            if point.good and opened:
                point = brought_near(fit, residuals.evaluate(model, space, fit.point.x, point.carried))
            rows = rivals.rows(fit.candidate, residuals, point) if point.good else None
            known = self._unfitted[key] = fit, rows, point.cost
        return known[1:]

    def without(self, fit: FinalFit, label: str) -> FinalFit:
        """The model without one effect or sensor error, refitted from the values of the larger model.
        Returns the better of this refit and an earlier one, which may have ended in another local minimum."""
        parts = [part for own, part in fit.candidate.parts.items() if own != label]
        candidate = self.models.of_parts(parts, transient=fit.candidate.transient)
        values = {key: value for key, value in fit.values.items() if not (isinstance(key, tuple) and key[0] == label)}
        find = partial(self._refitted, candidate, values, fit)
        return self._keep(self._once(f"without {label} of {' + '.join(fit.candidate.labels)}", find, candidate))

    def _refitted(self, candidate: Candidate, values: Values, present: FinalFit) -> FinalFit:
        """Refit a candidate from the values of another model, or of the base model if those cannot be simulated.
        Returns an earlier refit if the new one, after a few iterations, does not promise a clearly lower cost. The
        search ends where a full step promises less than 2 % (`small`) of what the model costs more than the present."""
        start = begin(candidate, values, self.rough, present)
        if not start.good:
            base = self._beside(self._fits[_key(self.models.of(()))], candidate.transient)
            start = begin(candidate, base.values, self.rough, base)
        known, rough, enough = self._fits.get(_key(candidate)), advance(start, self.settings.heat), 0.0
        if candidate.transient == present.candidate.transient:
            enough = self.settings.small * max((known or rough).point.cost - present.point.cost, 0.0)
        if known is not None and (not rough.good or rough.expected > known.point.cost - enough):
            return known
        return converged(rough, self.fine, enough)

    def _keep(self, fit: FinalFit) -> FinalFit:
        key = _key(fit.candidate)
        if key not in self._fits or fit.point.cost < self._fits[key].point.cost:
            self._fits[key] = fit
        return self._fits[key]


def _steps(fit: FinalFit) -> int:
    """Integration steps, rejected ones included, of the longest run of fitted and validation logs."""
    overrides, simulation = fit.candidate.held(fit.values).fixed, fit.simulation
    runs, others = (fit.candidate.residuals(simulation, use).runs for use in ("fit", "validate"))
    states = fit.point.carried.states or (None,) * len(runs)
    every = [run.over_time(overrides, own) for run, own in zip(runs, states, strict=True)]
    every += [run.over_time(overrides, None) for run in others]
    longest = max(every, key=lambda run: float(run.times[-1]) - run.start)
    (record,) = simulate_many(fit.candidate.model, [longest], solver=simulation.solver)
    return record.statistics["steps"] + record.statistics["rejected"]


def _key(candidate: Candidate) -> tuple[frozenset[str], bool]:
    """Key of a model in the caches: the set of its labels, and whether stepped sines are simulated over time."""
    return frozenset(candidate.labels), candidate.transient
