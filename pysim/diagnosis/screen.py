"""Where the refits of candidates begin: what each does to the residual at some sizes, refitting allowed for.

It is a start for the refit and no judgement: at biased parameters the gain it promises errs by orders of magnitude.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.candidate import Candidate, Key, Models, Values
from pysim.diagnosis.refit import FinalFit, begin, begun, exact
from pysim.diagnosis.rivals import Rows, of, rows
from pysim.identify.greybox import Point, Simulation
from pysim.identify.greybox.identifiability import EXACT
from pysim.simulate import Rodas, simulate_many
from pysim.types import BadInput, Effect, EffectParameter, Outcome

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Screened:
    """One effect at one size in the present model.

    Args:
        candidate: the present model with the effect.
        values: where a refit may begin.
        tried: values of the effect's parameters that `change` is for.
        gain: nats that it promises, refitting allowed for, to first order.
        change: (n_r,) by which it changes the residual, in the units of the channels, refitting allowed for.
        start: the refit at its beginning, as good as off; None where that is still to be simulated.
        before: cost of the present model, simulated as the start is, nats.
    """

    candidate: Candidate
    values: Values
    tried: Mapping[str, float]
    gain: float
    change: Array = field(repr=False)
    start: FinalFit | None = field(default=None, repr=False)
    before: float = math.nan

    @property
    def effect(self) -> Effect:
        """The one that is new."""
        return self.candidate.effects[-1]

    def leaves(self, present: Rows) -> Rows:
        """What the present model leaves with the effect at its best size, to first order: an effect that is missing
        colours the residual, which must not argue against it.
        """
        change, residual = self.change / present.level, present.residual / present.level
        amount = -float(change @ residual) / float(change @ change) if self.gain > 0 else 0.0
        return replace(present, residual=present.residual + amount * self.change)


@dataclass(frozen=True)
class Sizes:
    """At which sizes an effect is tried, over its usual one.

    Args:
        off: of an amount as good as none, where slopes are those beside none: at none a Stribeck friction has none, and
            a hundred times more of air in a chamber that runs empty already costs 30 nats.
        kept: of the same with a state of its own: smaller ones no step control sees, and slopes err.
        usual: of an amount.
        limits: of a limit, over the largest value that the limited variable reaches.
        limits_unknown: of a limit of which that is not known, over its usual value.
        moved: what initial states may still take, as a share of what the effect does, above which they move along.
    """

    off: float = 1e-7
    kept: float = 0.02
    usual: tuple[float, ...] = (0.3, 1.0)
    limits: tuple[float, ...] = (0.92, 0.75, 0.55, 0.35, 0.2, 0.1)
    limits_unknown: tuple[float, ...] = (0.25, 0.6, 1.0, 2.0)
    moved: float = 0.02


def screen(
    models: Models,
    beside: Callable[[bool], FinalFit],
    simulation: Simulation,
    sizes: Sizes | None = None,
    *,
    fits: Simulation | None = None,
) -> list[Screened]:
    """Every effect of the catalogue in the present model, the best gain first.

    Of amounts one run gives the slopes where all are as good as off; other effects are simulated at each size. Effects
    that cannot be built or simulated are left out, and `models.refused` says which.

    Args:
        beside: the present model, compared by orbits (False) or by transients (True).
        simulation: of an effect at a size.
        fits: of refits, which begin at the slopes; as `simulation` where None.
    """
    sizes, before = sizes or Sizes(), cache(lambda transient: _Before.of(beside(transient)))
    own = before(False).present.candidate
    found = list(_by_slopes(models, before, fits or simulation, sizes))
    have = {effect.name for effect in own.effects} | {one.effect.name for one in found}
    for effect in models.session.catalogue:
        if effect.name in have:
            continue
        try:
            candidate = models.of((*own.effects, effect), own.nuisances)
        except BadInput as error:
            models.refused.setdefault(effect.name, str(error))
            continue
        tried = list(_screened(candidate, effect, before(candidate.transient), simulation, sizes))
        if not tried:
            models.refused.setdefault(effect.name, "the model could not be simulated with it")
        found += tried
    return sorted(found, key=lambda one: -one.gain)


def screened(
    candidate: Candidate, effect: Effect, present: FinalFit, simulation: Simulation, sizes: Sizes | None = None
) -> list[Screened]:
    """One effect at each of its sizes; none where the model cannot be simulated with it."""
    return list(_screened(candidate, effect, _Before.of(present), simulation, sizes or Sizes()))


def best_of_each(screened: Sequence[Screened]) -> list[Screened]:
    """The best size of each effect."""
    best: dict[str, Screened] = {}
    for one in screened:
        best.setdefault(one.effect.name, one)
    return list(best.values())


@dataclass(frozen=True)
class _Before:
    """The present model as effects change it.

    Args:
        rows: of its point.
        span: (n_r, rank) what refitting can reach, over the levels.
    """

    present: FinalFit
    rows: Rows
    span: Array

    @classmethod
    def of(cls, present: FinalFit) -> _Before:
        found = of(present)
        return cls(present, found, _span(found))

    def beyond(self, change: Array) -> Array:
        """What of a change of the residual over its levels (n_r,) refitting leaves."""
        return np.asarray(change - self.span @ (self.span.T @ change))

    def best(self, effect: Effect, change: Array, left: Array) -> tuple[float, float] | None:
        """By how many times a change the effect is best, and the nats that this promises; None where refitting does as
        much as the effect."""
        size = float(left @ left)
        if not size > EXACT * float(change @ change):
            return None
        amount = -float(left @ (self.rows.residual / self.rows.level)) / size
        amount = amount if amount > 0 or _signed(effect) else 0.0
        return amount, 0.5 * amount**2 * size


def _by_slopes(
    models: Models, befores: Callable[[bool], _Before], simulation: Simulation, sizes: Sizes
) -> Iterator[Screened]:
    """Effects that are amounts, with the beginnings of their refits."""
    first = befores(False).present.candidate
    for own in models.amounts(first.effects, first.nuisances):
        before, more = befores(own.transient), own.effects[len(first.effects) :]
        present = before.present
        keeps = own.keeps_state(more[0].name)
        off = {k: v for effect in more for k, v in _at_share(effect, sizes.kept if keeps else sizes.off).items()}
        there = begin(own, {**present.values, **off}, simulation, present)
        if not there.good:
            continue
        after, level = of(there), before.rows.level
        for effect in more:
            candidate, usual = models.of((*first.effects, effect), first.nuisances), _at_share(effect, 1.0)
            apart = own.at({**present.values, **off, **usual}) - there.point.x
            change = after.jacobian @ apart * (after.level / level)
            left = before.beyond(change)
            best = before.best(effect, change, left)
            if best is None:
                continue
            columns = [own.keys.index(key) for key in candidate.keys]
            start = begun(candidate, there.point.with_columns(columns), simulation, exact(candidate, simulation))
            tried = {p.name: usual.get((effect.name, p.name), p.default) for p in effect.parameters}
            cost = (present if keeps else there).point.cost
            yield Screened(candidate, start.values, tried, best[1], left * level, start, cost)


def _at_share(effect: Effect, share: float) -> dict[Key, float]:
    """Its strengths at a share of the way from off to their usual values."""
    return {(effect.name, p.name): _share_of(p, share) for p in effect.strengths}


def _share_of(p: EffectParameter, share: float) -> float:
    return _within(p, (p.off or 0.0) + share * p.nominal)


def _screened(
    candidate: Candidate, effect: Effect, before: _Before, simulation: Simulation, sizes: Sizes
) -> Iterator[Screened]:
    present, level = before.present, before.rows.level
    milder: tuple[float, float] | None = None  # cost and gain of the size before
    carried = candidate.carried(present.candidate, present.point)
    residuals = candidate.residuals(simulation)

    def changed(point: Point) -> tuple[Array, Array]:
        """What the effect does to the residual over its levels (n_r,), and what of it refitting leaves."""
        change = (rows(candidate, residuals, point).residual - before.rows.residual) / level
        return change, before.beyond(change)

    for tried in _values(effect, _largest(candidate, effect, present, simulation), sizes):
        values = with_effect(present.values, effect, tried)
        space = candidate.held(values)
        free = not candidate.has_events
        point = residuals.evaluate(candidate.model, space, np.zeros(0), carried, jacobian=False, states=free)
        if not point.good:
            continue
        change, left = changed(point)
        if 2 * point.gain > sizes.moved * float(left @ left):
            moved = point.carried_to(np.zeros(0))
            again = residuals.evaluate(candidate.model, space, np.zeros(0), moved, jacobian=False, states=False)
            if again.good and again.cost < point.cost:
                change, left = changed(again)
        best = before.best(effect, change, left)
        if best is None:
            continue
        amount, gain = best
        start = with_effect(present.values, effect, _amounted(effect, tried, amount))
        yield Screened(candidate, start, tried, gain, left * level)
        if effect.limit and milder is not None and point.cost > milder[0] and gain <= milder[1]:
            return  # what limits more is farther from the measurements
        milder = point.cost, gain


def own_values(one: Screened) -> Values:
    """A start at the model's own parameters, the new effect at its usual size; a limit as it was screened."""
    usual = {
        p.name: one.values[one.effect.name, p.name] if p.inverse else _within(p, p.nominal)
        for p in one.effect.strengths
    }
    return {(one.effect.name, name): value for name, value in usual.items()}


def with_effect(values: Values, effect: Effect, own: Mapping[str, float]) -> dict[Key, float]:
    """Parameters of a model and of an effect that is new in it."""
    found: dict[Key, float] = dict(values)
    found.update({(effect.name, name): value for name, value in own.items()})
    return found


def _span(found: Rows) -> Array:
    """Orthonormal columns (n_r, rank) that span what refitting can reach, to first order."""
    size = np.linalg.norm(found.jacobian, axis=0)
    used = found.jacobian[:, size > 0] / size[size > 0]
    if not used.shape[1]:
        return np.zeros((found.residual.size, 0))
    u, sigma, _ = np.linalg.svd(used, full_matrices=False)
    return np.asarray(u[:, sigma > EXACT * sigma[0]])


def _signed(effect: Effect) -> bool:
    return any(p.min < (p.off or 0.0) for p in effect.strengths)


def _values(effect: Effect, largest: float | None, sizes: Sizes) -> Iterator[dict[str, float]]:
    """Values of all its parameters: its strengths at each size, its shapes as declared."""
    declared = {p.name: p.default for p in effect.parameters}
    limit = effect.limit
    if limit and largest:
        for share in sizes.limits:
            yield {**declared, limit.name: _within(limit, 1 / (share * largest))}
        return
    shares = sizes.limits_unknown if limit else sizes.usual
    for share in shares:
        yield {**declared, **{p.name: _share_of(p, share) for p in effect.strengths}}


def _amounted(effect: Effect, tried: Mapping[str, float], amount: float) -> dict[str, float]:
    """At the amount that looked best, within what first order can tell; limits as they were tried."""
    if effect.limit:
        return dict(tried)
    amount = math.copysign(min(max(abs(amount), 0.2), 3.0), amount) if amount else 0.5
    scaled = {p.name: _within(p, (p.off or 0.0) + amount * (tried[p.name] - (p.off or 0.0))) for p in effect.strengths}
    return {**tried, **scaled}


def _largest(candidate: Candidate, effect: Effect, present: FinalFit, simulation: Simulation) -> float | None:
    """Size in the fitted tests of the variable that the effect limits; None where it does not say which that is."""
    limit = next((p for p in effect.strengths if p.limits), None)
    if limit is None or len(effect.strengths) > 1:
        return None
    off = {**{p.name: p.default for p in effect.parameters}, limit.name: limit.off or 0.0}
    overrides = candidate.held(with_effect(present.values, effect, off)).fixed
    name = f"{candidate.places[effect.name]}.{limit.limits}"
    runs = [run.experiment.override(**overrides) for run in candidate.residuals(simulation).runs]
    runs = [replace(run, record=(name,)) for run in runs]
    records = simulate_many(candidate.model, runs, solver=Rodas(1e-3, 1e-3))
    done = [float(np.max(np.abs(r.values))) for r in records if r.outcome is Outcome.DONE and r.values.size]
    return max(done, default=None)


def _within(p: EffectParameter, value: float) -> float:
    return float(np.clip(value, p.min, p.max))
