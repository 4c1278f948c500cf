"""Refit of a law together with all parameters of the model; a prior with an estimated weight keeps the curve smooth."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis import refit
from pysim.diagnosis.candidate import Candidate
from pysim.diagnosis.learn.basis import Smoothness, lines, missed
from pysim.diagnosis.learn.products import Products
from pysim.diagnosis.learn.screening import LawModel, Ranked, with_law
from pysim.diagnosis.refit import FinalFit, advance, exact
from pysim.effects.learned import Law, Term
from pysim.identify.greybox import GaussNewton, Point, Simulation
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import Carried, with_rows

Array = NDArray[np.float64]

# Updates of the smoothness and heats of a race at most, and the change of the effective number of coefficients that
# ends the former.
_ROUNDS, _SETTLED = 8, 0.1


@dataclass(frozen=True)
class LawFit:
    """The refit of a law and the model's parameters, ended or not.

    Args:
        model: compiled with the law's term.
        law: place, argument and factor of the law.
        knots: (m,).
        unit: scale of the coefficients, in the model's units.
        smoothness: prior of the coefficients.
        fit: refit of the model; the last m search variables are the coefficients over `unit`.
    """

    model: LawModel = field(repr=False)
    law: Law
    knots: Array = field(repr=False)
    unit: float
    smoothness: Smoothness = field(repr=False)
    fit: FinalFit = field(repr=False)

    @property
    def values(self) -> Array:
        """(m,) coefficients over `unit`."""
        return self.fit.point.x[-self.knots.size :]

    @property
    def cost(self) -> float:
        """Cost without the curve's prior, nats."""
        return self.fit.point.cost - 0.5 * float(np.sum((self.smoothness.rows @ self.values) ** 2))

    @property
    def found(self) -> Law:
        """The law with the refitted number of its factor."""
        return replace(self.law, number=self.fit.values[self.law.free[0]]) if self.law.free else self.law

    @property
    def term(self) -> Term:
        """What the model is compiled with for this law."""
        return Term(self.law.place, self.knots.size, bool(self.law.free))

    @property
    def numbers(self) -> dict[str, float]:
        """The parameters that make the term this law, with the refitted values."""
        return self.law.settings(self.knots, self.unit) | {name: self.fit.values[name] for name in self.own}

    @property
    def held(self) -> FinalFit:
        """The fitted model with the law's numbers held, so that another law may be learned beside it."""
        own, space = self.fit.candidate, self.model.present.candidate.space
        problem = replace(own.problem, space=replace(space, fixed={**space.fixed, **self.numbers}))
        x, carried = self.fit.point.x[: -len(self.own)], self.fit.point.carried
        return refit.again(replace(own, problem=problem, precision=None), x, carried, self.fit.simulation)

    @property
    def own(self) -> tuple[str, ...]:
        """Names of the law's free parameters: the factor's number, if it is refitted, then the coefficients."""
        return (*self.law.free, *self.law.place.coefficients(self.knots.size))

    def without(self, sources: Collection[str]) -> LawFit:
        """Refitted with the smoothness held, without the observations of these sources."""
        own = refit.left_out(self.fit, sources)
        numbers = self.model, self.law, self.knots, self.unit, self.smoothness
        return ended(_beginning(*numbers, own.candidate, own.point, own.simulation))

    @property
    def bare(self) -> Point:
        """The best point without the rows of the curve's prior."""
        point, rows = self.fit.point, self.fit.point.residual.size - len(self.smoothness.rows)
        return replace(
            point, cost=self.cost, residual=point.residual[:rows], jacobian=point.jacobian[:rows],
            series=point.series[:rows], blocks=point.blocks[:rows],
        )  # fmt: skip

    @property
    def gram(self) -> Array:
        """(m, m) information of the data on the coefficients, projected off the model's parameters."""
        bare, m = self.bare, self.knots.size
        without = replace(bare, x=bare.x[:-m], jacobian=bare.jacobian[:, :-m])
        table = Products.at(without, self.fit.candidate.residuals(self.fit.simulation))
        table = table.with_(bare.jacobian[:, -m:], scaled=False)
        return table.across(np.ones(table.samples.size + 1))[0]

    @property
    def edf(self) -> float:
        """Effective number of coefficients (effective degrees of freedom)."""
        return self.smoothness.edf(self.gram)

    @property
    def df(self) -> float:
        """Effective number of free parameters of the law."""
        return self.edf + len(self.law.free)

    @property
    def coarse(self) -> bool:
        """Whether straight lines between the knots miss more than a standard deviation of the coefficients.

        Level and slope do not count: the model's parameters may absorb them, and straight lines represent them exactly.
        """
        line = lines(self.knots)
        keep = np.eye(self.knots.size) - line @ line.T
        sd = np.sqrt(np.diag(keep @ np.linalg.inv(self.gram + self.smoothness.precision) @ keep))
        return bool(np.any(missed(self.knots, self.values) > np.maximum(sd[1:], sd[:-1])))


def penalised(point: Point, smoothness: Smoothness, end: int | None = None) -> Point:
    """The point with the prior of the coefficients, its variables up to `end`, as further rows of the residual."""
    if not point.good:
        return point
    rows, end = smoothness.rows, point.x.size if end is None else end
    own, slopes = slice(end - rows.shape[1], end), np.zeros((len(rows), point.x.size))
    slopes[:, own] = rows
    return with_rows(point, rows @ point.x[own], slopes, 0)


def begun(model: LawModel, ranked: Ranked, simulation: Simulation) -> LawFit:
    """Begin the refit of a law at the curve of the screening, or at zero if the screened curve raises the cost."""
    unit = ranked.size or ranked.unit
    ratio = ranked.unit / unit  # of the old scale to the new one
    smooth = ranked.curve.smoothness
    smooth = replace(smooth, bending=smooth.bending / ratio**2, level=smooth.level / ratio**2)
    x, values = np.append(model.present.point.x, ranked.law.start), ranked.curve.values * ratio
    first = started(model, ranked.law, ranked.knots, unit, smooth, np.append(x, values), simulation)
    if first.fit.point.cost < model.present.point.cost:
        return first
    return started(model, ranked.law, ranked.knots, unit, smooth, np.append(x, 0 * values), simulation)


def started(
    model: LawModel,
    law: Law,
    knots: Array,
    unit: float,
    smoothness: Smoothness,
    x: Array,
    simulation: Simulation,
    carried: Carried | None = None,
) -> LawFit:
    """Begin the refit of a law at x: search variables of the model (n,), the factor's number if it is refitted, and
    the coefficients (m,) over `unit`."""
    candidate = model.candidate(law, knots, unit, free=True)
    point = exact(candidate, simulation)(x, carried or model.carried(candidate))
    return _beginning(model, law, knots, unit, smoothness, candidate, point, simulation)


def _beginning(
    model: LawModel,
    law: Law,
    knots: Array,
    unit: float,
    smoothness: Smoothness,
    candidate: Candidate,
    bare: Point,
    simulation: Simulation,
) -> LawFit:
    """Begin a search at a point that was evaluated without the curve's prior."""
    precision = np.zeros((bare.x.size, bare.x.size))
    precision[-knots.size :, -knots.size :] = smoothness.precision
    candidate = replace(candidate, precision=precision, law=law.label)
    without = exact(candidate, simulation)

    def evaluate(x: Array, carried: Carried) -> Point:
        return penalised(without(x, carried), smoothness)

    return LawFit(
        model, law, knots, unit, smoothness, refit.begun(candidate, penalised(bare, smoothness), simulation, evaluate)
    )


def moved(one: LawFit, points: int) -> LawFit:
    """Continue by at most `points` iterations, then update the smoothness."""
    if not one.fit.good:
        return one
    one = replace(one, fit=advance(one.fit, points))
    smooth, own = one.smoothness.moved(one.gram, one.values), one.fit
    found = _beginning(one.model, one.law, one.knots, one.unit, smooth, own.candidate, one.bare, own.simulation)
    if own.state.outcome is not None or found.fit.state.outcome is not None:
        return found
    memory = {**own.state.memory, "expected": found.fit.state.memory["expected"]}  # keeps the trust radius
    return replace(found, fit=replace(found.fit, state=replace(found.fit.state, memory=memory)))


def raced(running: Sequence[LawFit], heat: Callable[[LawFit], LawFit]) -> list[LawFit]:
    """Laws after a further heat each, and more for the best one and those that gained more in the last than they lack
    to it; what could not go on is left out."""
    done, ahead = list[LawFit](), list(running)
    for _ in range(_ROUNDS):
        moves = [(fit.cost, heat(fit)) for fit in ahead]
        moves, ahead = [(before, fit) for before, fit in moves if fit.fit.good], []
        best = min((fit.cost for _, fit in moves), default=0.0)
        for before, fit in moves:
            may_win = fit.cost == best or before - fit.cost > fit.cost - best
            (ahead if may_win else done).append(fit)
        if len(ahead) < 2:
            break
    return [*ahead, *done]


def settled(one: LawFit, points: int, enough: float) -> LawFit:
    """Alternate `points` iterations and an update of the smoothness until both gain less than `enough` nats."""
    for _ in range(_ROUNDS):
        edf, cost = one.edf, one.fit.point.cost
        one = moved(one, points)
        if not one.fit.good:
            break
        stands = one.fit.state.outcome is not None or cost - one.fit.point.cost < enough
        if stands and abs(one.edf - edf) < _SETTLED:
            break
    return one


def ended(one: LawFit) -> LawFit:
    """Continue to the end of the search with the smoothness held."""
    return replace(one, fit=advance(one.fit, GaussNewton().max_iterations))


def together(laws: Sequence[LawFit], enough: float) -> list[LawFit]:
    """Laws at different places, refitted at once; each of the answer holds the others.

    Args:
        laws: the last one was learned beside the others, so its model has the terms of all.
        enough: nats; the search ends where a round with another smoothness gains less.
    """
    model, space, cost = laws[-1].model, laws[0].model.present.candidate.space, math.inf
    fits, smooth = list(laws), [one.smoothness for one in laws]
    for _ in range(_ROUNDS):
        joint = advance(_joint(fits, smooth, model, space), GaussNewton().max_iterations)
        if not joint.good:
            break
        values = joint.candidate.values(joint.point.x)
        numbers = [one.law.settings(one.knots, one.unit) | {name: values[name] for name in one.own} for one in fits]
        others = [[own for own in numbers if own is not mine] for mine in numbers]
        fits = [_beside(one, s, held, joint, model, space) for one, s, held in zip(fits, smooth, others, strict=True)]
        smooth = [one.smoothness.moved(one.gram, one.values) for one in fits]
        change = [abs(after.edf(one.gram) - one.edf) for one, after in zip(fits, smooth, strict=True)]
        if cost - joint.point.cost < enough and max(change) < _SETTLED:
            break
        cost = joint.point.cost
    return fits


def _joint(laws: Sequence[LawFit], smooth: Sequence[Smoothness], model: LawModel, space: ParameterSpace) -> FinalFit:
    """Begin a search for the numbers of all laws, behind the model's free parameters `space`, at the last law's fit."""
    start, ends = laws[-1].fit, list[int]()
    x, wide = start.point.x[: space.size], space
    for one in laws:
        x = np.append(x, one.fit.point.x[space.size :])
        wide, ends = with_law(wide, one.found, one.law.free, one.knots, one.unit), [*ends, x.size]
    candidate = replace(start.candidate, problem=replace(model.problem, space=wide), precision=None)
    without = exact(candidate, start.simulation)

    def evaluate(x: Array, carried: Carried) -> Point:
        point = without(x, carried)
        for own, end in zip(smooth, ends, strict=True):
            point = penalised(point, own, end)
        return point

    return refit.begun(candidate, evaluate(x, start.point.carried), start.simulation, evaluate)


def _beside(
    one: LawFit,
    smooth: Smoothness,
    others: Sequence[Mapping[str, float]],
    joint: FinalFit,
    model: LawModel,
    space: ParameterSpace,
) -> LawFit:
    """A law at the values that a joint search found, the numbers of the others held."""
    fixed = dict(space.fixed)
    for own in others:
        fixed |= own
    candidate = replace(joint.candidate, problem=replace(model.problem, space=replace(space, fixed=fixed)))
    values, m = joint.candidate.values(joint.point.x), one.knots.size
    own_model = LawModel(one.law.place, m, replace(joint, candidate=candidate), model.model, one.term.memory)
    law = replace(one.law, number=values[one.law.free[0]]) if one.law.free else one.law
    at = own_model.candidate(law, one.knots, one.unit, free=True).at(values)
    return started(own_model, law, one.knots, one.unit, smooth, at, joint.simulation, joint.point.carried)
