"""Screening: what each effect changes in the residual at some sizes, beyond what other parameters can imitate.

It gives the starts of refits and no judgement: at biased parameters its first-order gains are wrong by far.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.candidate import Candidate, Key, Models, Refused, Values
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
        values: starting values for a refit.
        tried: values of the effect's parameters at which `change` was computed.
        gain: nats that the effect promises, to first order, with all parameters refitted.
        change: (n_r,) change of the residual that parameters cannot imitate, in the units of the channels.
        start: first state of the refit, the effect practically off; None if it must still be simulated.
        before: cost of the present model, simulated as the start is, nats.
        nonlinear: whether it is an amount that changes other samples at this size than practically off, as air does
            where a chamber would run empty without it: the derivative says nothing of this size.
    """

    candidate: Candidate
    values: Values
    tried: Mapping[str, float]
    gain: float
    change: Array = field(repr=False)
    start: FinalFit | None = field(default=None, repr=False)
    before: float = math.nan
    nonlinear: bool = False

    @property
    def effect(self) -> Effect:
        """The effect that was added."""
        return self.candidate.effects[-1]

    def leaves(self, present: Rows) -> Rows:
        """The present model's rows with the effect at its best size, to first order.
        A missing effect colours the residual, and this colour must not count against the effect itself.
        """
        change, residual = self.change / present.level, present.residual / present.level
        amount = -float(change @ residual) / float(change @ change) if self.gain > 0 else 0.0
        return replace(present, residual=present.residual + amount * self.change)


@dataclass(frozen=True)
class Sizes:
    """Sizes at which an effect is tried, over its usual (nominal) size. An amount is an effect that is no limit.

    Args:
        off: of an amount that is practically off, where its derivative is taken. At exactly 0, a Stribeck friction has
            none; at 1e-5, air in a chamber that runs empty already costs 30 nats.
        kept: the same for an amount whose law has a state, since the step control overlooks smaller ones.
        usual: of an amount that is simulated at some sizes.
        limits: of a limit (end stop, saturation), over the largest value that the limited variable reaches.
        limits_unknown: of a limit if that largest value is not known, over its usual value.
        moved: share of the effect's change that initial states may imitate before they are estimated again.
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
    wrong_by: float | None = None,
) -> list[Screened]:
    """Screen every effect of the catalogue in the present model; the largest gain first.

    For amounts, one run with all of them practically off gives the derivatives. Other effects, and nonlinear
    amounts, are simulated at each size. Effects that cannot be compiled or simulated are left out and listed in
    `models.refused`.

    Args:
        beside: returns the present fit, its stepped sines as orbits (False) or simulated over time (True).
        simulation: solver settings of an effect at a size.
        fits: solver settings of the starts of refits; `simulation` if None.
        wrong_by: factor by which a first-order gain may be wrong before an amount counts as nonlinear; None: none does.
    """
    sizes, before = sizes or Sizes(), cache(lambda transient: _Before.of(beside(transient)))
    own = before(False).present.candidate
    found = list(_by_slopes(models, before, fits or simulation, sizes))
    have, slopes = {effect.name for effect in own.effects}, {one.effect.name: one for one in found}
    for effect in models.session.catalogue:
        if effect.name in have or (effect.name in slopes and wrong_by is None):
            continue
        try:
            candidate = models.of((*own.effects, effect), own.nuisances)
        except BadInput as error:
            models.refused.setdefault(effect.name, Refused(str(error), own.labels))
            continue
        there, slope = before(candidate.transient), slopes.get(effect.name)
        tried = list(_screened(candidate, effect, there, simulation, sizes))
        if slope is not None and wrong_by is not None:
            pairs = [(slope.change / there.rows.level, one.change / there.rows.level) for one in tried]
            alike = any(a @ b > np.linalg.norm(a) * np.linalg.norm(b) / math.sqrt(wrong_by) for a, b in pairs)
            tried = [] if alike else [replace(one, nonlinear=True) for one in tried]
        elif not tried:
            models.refused.setdefault(effect.name, Refused("the model could not be simulated with it", own.labels))
        found += tried
    return sorted(found, key=lambda one: -one.gain)


def screened(
    candidate: Candidate, effect: Effect, present: FinalFit, simulation: Simulation, sizes: Sizes | None = None
) -> list[Screened]:
    """Screen one effect at each of its sizes; empty if the model cannot be simulated with it."""
    return list(_screened(candidate, effect, _Before.of(present), simulation, sizes or Sizes()))


def best_of_each(screened: Sequence[Screened]) -> list[Screened]:
    """The first entry of each effect, which is its best size in a list with the largest gain first."""
    best: dict[str, Screened] = {}
    for one in screened:
        best.setdefault(one.effect.name, one)
    return list(best.values())


@dataclass(frozen=True)
class _Before:
    """The present model, to which effects are added.

    Args:
        rows: measured rows of its best point.
        span: (n_r, rank) orthonormal basis of what parameters can change in the residual over its levels.
    """

    present: FinalFit
    rows: Rows
    span: Array

    @classmethod
    def of(cls, present: FinalFit) -> _Before:
        found = of(present)
        return cls(present, found, _span(found))

    def beyond(self, change: Array) -> Array:
        """The part of a change of the residual over its levels (n_r,) that parameters cannot imitate."""
        return np.asarray(change - self.span @ (self.span.T @ change))

    def best(self, effect: Effect, change: Array, left: Array) -> tuple[float, float] | None:
        """The best multiple of an effect's change (n_r,) and the gain there, nats, to first order.
        None if parameters imitate the change, that is, if nothing is `left` of it."""
        size = float(left @ left)
        if not size > EXACT * float(change @ change):
            return None
        amount = -float(left @ (self.rows.residual / self.rows.level)) / size
        amount = amount if amount > 0 or _signed(effect) else 0.0
        return amount, 0.5 * amount**2 * size


def _by_slopes(
    models: Models, befores: Callable[[bool], _Before], simulation: Simulation, sizes: Sizes
) -> Iterator[Screened]:
    """Screen the amounts by their derivatives where all are practically off; their refits start there."""
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
    """The effect's strengths at a share of the way from off to their usual values."""
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
        """Change of the residual over its levels (n_r,), and the part that parameters cannot imitate."""
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
        if 2 * point.own_gain() > sizes.moved * float(left @ left):
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
            return  # a tighter limit is even farther from the measurements
        milder = point.cost, gain


def own_values(one: Screened) -> Values:
    """Starting values at the model's nominal parameters, the new effect at its usual size, a limit as screened."""
    usual = {
        p.name: one.values[one.effect.name, p.name] if p.inverse else _within(p, p.nominal)
        for p in one.effect.strengths
    }
    return {(one.effect.name, name): value for name, value in usual.items()}


def with_effect(values: Values, effect: Effect, own: Mapping[str, float]) -> dict[Key, float]:
    """Values of a model's parameters, joined with those of a new effect."""
    found: dict[Key, float] = dict(values)
    found.update({(effect.name, name): value for name, value in own.items()})
    return found


def _span(found: Rows) -> Array:
    """Orthonormal basis (n_r, rank) of what parameters can change in the residual over its levels, to first order."""
    size = np.linalg.norm(found.jacobian, axis=0)
    used = found.jacobian[:, size > 0] / size[size > 0]
    if not used.shape[1]:
        return np.zeros((found.residual.size, 0))
    u, sigma, _ = np.linalg.svd(used, full_matrices=False)
    return np.asarray(u[:, sigma > EXACT * sigma[0]])


def _signed(effect: Effect) -> bool:
    return any(p.min < (p.off or 0.0) for p in effect.strengths)


def _values(effect: Effect, largest: float | None, sizes: Sizes) -> Iterator[dict[str, float]]:
    """Values of the effect's parameters to try: strengths at each size, all others as declared."""
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
    """The tried values times the best multiple, which is clipped to 0.2 ... 3; limits as they were tried."""
    if effect.limit:
        return dict(tried)
    amount = math.copysign(min(max(abs(amount), 0.2), 3.0), amount) if amount else 0.5
    scaled = {p.name: _within(p, (p.off or 0.0) + amount * (tried[p.name] - (p.off or 0.0))) for p in effect.strengths}
    return {**tried, **scaled}


def _largest(candidate: Candidate, effect: Effect, present: FinalFit, simulation: Simulation) -> float | None:
    """Largest size, in the fitted logs, of the variable that the effect limits; None if its class does not name it."""
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
