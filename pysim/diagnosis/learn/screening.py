"""Screening of all laws at all places of a fitted model: one penalised regression each, with parameters refitted."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Candidate
from pysim.diagnosis.learn.basis import Curve, knots, solve
from pysim.diagnosis.learn.products import Products
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.settings import LearnSettings
from pysim.effects.learned import LESS, TIME, Law, Place, laws_at
from pysim.identify.greybox import Problem
from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.observation import Run
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.problem import beside
from pysim.identify.greybox.residuals import Carried, Channel
from pysim.simulate import Rodas, simulate_many
from pysim.types import Model, Outcome
from pysim.types.factor import Form

Array = NDArray[np.float64]

# Runs whose signals place the knots (the longest ones), and samples of each, at most.
_RUNS, _SAMPLES = 24, 4000
# Two arguments count as the same, up to scale and offset, if their correlation is nearer to 1 or -1 than this.
_SAME = 1e-4
_BOTH = 0.05  # share of the samples that must have each sign
# First scale of coefficients, so small that the response of any model is proportional.
_LITTLE = 1e-12
_REWEIGHTED = 3  # rounds of reweighting by the levels that a law leaves


@dataclass(frozen=True)
class Ranked:
    """One law as it was screened, to first order.

    Args:
        law: place, argument and factor.
        knots: (m,) of its curve.
        unit: scale of its coefficients, in the model's units.
        curve: best coefficients, over `unit`.
        gain: nats that the law promises, with the parameters refitted.
        score: gain less the BIC penalty of the effective number of coefficients.
        share: share of the avoidable sum of squares that it explains, 0 ... 1.
    """

    law: Law
    knots: Array = field(repr=False)
    unit: float
    curve: Curve = field(repr=False)
    gain: float
    score: float
    share: float

    @property
    def size(self) -> float:
        """Root mean square of the coefficients, in the model's units."""
        return self.unit * float(np.sqrt(np.mean(self.curve.values**2)))


@dataclass(frozen=True)
class LawModel:
    """A model compiled with the term of a law at one place, and the fitted model without the term.

    Args:
        place: where the term is.
        count: number of knots of its curve.
        present: refit of the model without the term.
        model: the compiled model.
        memory: whether the term may have a bristle or a tone.
    """

    place: Place
    count: int
    present: FinalFit = field(repr=False)
    model: Model = field(repr=False)
    memory: bool = False

    @cached_property
    def problem(self) -> Problem:
        """The compiled model and the measurements. A bristle is not deflected when a log begins."""
        before = self.present.candidate
        own = beside(before.problem, self.model, [])
        is_new = np.array([name not in before.model.abilities.states for name in self.model.abilities.states])

        def held(run: Run) -> Run:
            return replace(run, initial=np.where(is_new, 0.0, run.initial)) if run.initial.size else run

        held_still = [one.with_runs([held(run) for run in one.runs]) for one in own.observations]
        return replace(own, observations=tuple(held_still))

    def slopes(self, law: Law, k: Array, by: Array) -> tuple[float, Array] | None:
        """Scale of a law's coefficients, and the Jacobian (n_r, m) by them at 0; None if the run fails.

        Args:
            k, by: (m,) knots, and (n,) samples of its factor.
        """
        unit = _LITTLE / max(float(np.sqrt(np.mean(by**2))), 1e-300)
        candidate = self.candidate(law, k, unit, free=False)
        point = candidate.residuals(self.present.simulation.rough()).evaluate(
            candidate.model, candidate.space, np.zeros(k.size), self.carried(candidate)
        )
        return (unit, point.jacobian) if point.good and np.isfinite(point.jacobian).all() else None

    def carried(self, candidate: Candidate) -> Carried:
        """Initial states and sensor errors of the model without the term, for one with it."""
        return candidate.carried(self.present.candidate, self.present.point)

    def candidate(self, law: Law, k: Array, unit: float, *, free: bool) -> Candidate:
        """A candidate whose free variables are the law's coefficients (m,), and if `free` the model's parameters and
        the number of the law's factor before them.

        Args:
            k, unit: (m,) knots, and scale of the coefficients.
        """
        own = self.present.candidate
        base = own.space if free else own.held(self.present.values)
        space = with_law(base, law, law.free if free else (), k, unit)
        return replace(own, problem=replace(self.problem, space=space))


def with_law(base: ParameterSpace, law: Law, first: Sequence[str], k: Array, unit: float) -> ParameterSpace:
    """The space with a law's numbers behind: those named `first`, and the coefficients over `unit` at the knots k."""
    names, settings = law.place.coefficients(k.size), law.settings(k, unit)
    own, far, is_length = (*first, *names), np.full(len(names), math.inf), law.is_bristle
    low = 0.0 if is_length else -math.inf
    return ParameterSpace(
        keys=(*base.keys, *own),
        variables=(*base.variables, *own),
        records=(*base.records, *(None,) * len(own)),
        units=(*base.units, *("1",) * len(own)),
        start=np.concatenate([base.start, [law.number] * len(first), np.zeros(len(names))]),
        lower=np.concatenate([base.lower, [low] * len(first), -far]),
        upper=np.concatenate([base.upper, [math.inf] * len(first), far]),
        scale=np.append(base.scale, np.ones(len(own))),
        log=np.concatenate([base.log, [is_length] * len(first), np.zeros(len(names), dtype=bool)]),
        ties=base.ties,
        fixed={**base.fixed, **{key: value for key, value in settings.items() if key not in own}},
    )


def seen(present: FinalFit, places: Sequence[Place], use: str = "fit") -> dict[str, Array]:
    """Samples (n,) of every variable that a law may depend on, from the fitted model's runs of the logs with this use;
    empty if there are none, all fail, or the model is unstable, so that the squares of a variable overflow."""
    wanted = {name for place in places for side in place.sides for name in (*side.own, *place.outside)} - {TIME}
    model = present.candidate.model
    names = {name for one in wanted for name in one.split(LESS)} | set(model.abilities.states)
    residuals = present.candidate.residuals(present.simulation, use)
    overrides = present.candidate.held(present.values).fixed
    known = present.point.carried.states if use == "fit" else ()
    states = known or (None,) * len(residuals.runs)
    offsets = [None if run.orbit is not None else s for run, s in zip(residuals.runs, states, strict=True)]
    runs = [run.over_time(overrides, offset) for run, offset in zip(residuals.runs, offsets, strict=True)]
    runs = sorted(runs, key=lambda run: float(run.times[-1]) - run.start, reverse=True)[:_RUNS]
    looked = [
        replace(r, times=r.times[:: math.ceil(r.times.size / _SAMPLES)], record=tuple(sorted(names))) for r in runs
    ]
    records = [r for r in simulate_many(model, looked, solver=Rodas(1e-3, 1e-3)) if r.outcome is Outcome.DONE]
    with np.errstate(over="ignore"):
        bounded = all(np.isfinite(np.square(r.values)).all() for r in records)
    if not records or not bounded:
        return {}
    found = {name: np.concatenate([r[name] for r in records]) for name in names}
    found |= {one: found[one.split(LESS)[0]] - found[one.split(LESS)[1]] for one in wanted if LESS in one}
    return {**found, TIME: np.concatenate([r.time for r in records])}


def with_moved(place: Place, signals: Mapping[str, Array], states: Sequence[str]) -> Place:
    """The place with the first of its variables that is one of the model's states, if it has no speeds."""
    if place.speeds or len(place.sides) > 1 or place.sides[0].output_rate:
        return place
    own = [signals[name] for name in place.sides[0].own]
    alike = (i for i, z in enumerate(own) if any(np.allclose(z, signals[one], rtol=1e-9, atol=0) for one in states))
    return replace(place, moved=tuple(islice(alike, 1)))


def distinct(places: Sequence[Place], signals: Mapping[str, Array]) -> list[Law]:
    """The laws at these places without duplicates and without signs of variables that hardly change their sign.
    Signals that differ only by scale and offset are duplicates, since a curve over one is a curve over the other."""
    found: list[Law] = []
    for place in places:
        shapes = [_scaled(samples(Law(place, i), signals)[0]) for i in range(len(place.arguments))]
        first = [next(j for j, other in enumerate(shapes) if _alike(one, other)) for one in shapes]
        for law in laws_at(place):
            if law.form is Form.SIGN:
                own = samples(replace(law, form=Form.VARIABLE), signals)[1]
                width = LearnSettings().sign_width * float(np.sqrt(np.mean(own**2)))
                law = replace(law, number=float(f"{width:.2g}") or 1.0)
            by = samples(law, signals)[1]
            if first[law.chosen] != law.chosen or not np.ptp(shapes[law.chosen]) > 0 or law.by == law.chosen:
                continue
            if law.by is not None and (first[law.by] != law.by or not np.ptp(by) > _SAME * float(np.abs(by).max())):
                continue
            if law.form is not Form.SIGN or min(np.mean(by > 0.5), np.mean(by < -0.5)) > _BOTH:
                found.append(law)
    return found


def samples(law: Law, seen: Mapping[str, Array]) -> tuple[Array, Array]:
    """Samples (n,) of a law's argument and factor, all sides concatenated, from those of the model's variables.
    A bristle and a tone count as 1, which is the most that they reach."""
    z, by = [], []
    for side in law.place.sides:
        argument, factor = law.seen(side)
        z.append(seen[argument])
        value = seen[factor] if factor and not law.free else np.ones(z[-1].size)
        by.append(np.tanh(value / law.number) if law.form is Form.SIGN else value)
    return np.concatenate(z), np.concatenate(by)


def remembering(laws: Sequence[Law], signals: Mapping[str, Array], rate: float | None) -> list[Law]:
    """Each place's laws with bristles of several lengths, and with tones of several phases, all over one argument.

    Args:
        laws: without memory, of places that have no rates, as `distinct` gives them.
        rate: angular frequency of a tone in the residual, rad/s; None without one.
    """
    settings, found = LearnSettings(), list[Law]()
    for place, law in {law.place: law for law in reversed(laws) if law.form is Form.ONE}.items():
        for i in place.pulls:
            form, z = Form.BRISTLE if i in place.speeds else Form.HYSTERESIS, signals[place.sides[0].own[i]]
            step = np.diff(signals[TIME])
            stroke = _stroke((z[1:] * step if form is Form.BRISTLE else np.diff(z))[step > 0])
            found += [Law(place, law.chosen, form, i, share * stroke) for share in settings.bristles if stroke]
        if rate is not None:
            phases = np.arange(settings.phases) * math.pi / settings.phases
            found += [Law(place, law.chosen, Form.TONE, None, phase, rate) for phase in phases.tolist()]
    return found


def over_all(best: Sequence[Law], laws: Sequence[Law]) -> list[Law]:
    """The laws with these factors over every other argument that differs from theirs."""
    arguments = [(law.place, law.chosen) for law in laws if law.form is Form.ONE]
    return [replace(law, chosen=i) for law in best for place, i in arguments if place == law.place and i != law.chosen]


def _stroke(steps: Array) -> float:
    """Mean way between two reversals of what moves in these steps (n,), in their unit; all of it if nothing turns."""
    return float(np.abs(steps).sum()) / max(int(np.count_nonzero(np.diff(np.sign(steps[steps != 0])))), 1)


def _scaled(z: Array) -> Array:
    """The signal with mean 0 and standard deviation 1; zeros if it never moves."""
    spread = float(z.std())
    return (z - z.mean()) / spread if spread > 1e-12 * float(np.abs(z).max()) else np.zeros(z.size)


def _alike(one: Array, other: Array) -> bool:
    """Whether two scaled signals (n,) are the same up to their sign."""
    return one is other or (one.size == other.size and abs(abs(float(np.mean(one * other))) - 1) < _SAME)


def screen(
    present: FinalFit,
    models: Mapping[str, LawModel],
    laws: Sequence[Law],
    signals: Mapping[str, Array],
    choosing: Mapping[str, Array],
    floors: Mapping[Channel, float],
) -> list[Ranked]:
    """Screen every law to first order; the best score first. Laws that cannot be simulated are left out, and those that
    the model's parameters imitate, such as a curve over an input of two values.

    Args:
        present: the fitted model that lacks something.
        models: key of a place -> model compiled with a term there.
        signals, choosing: samples of the model's variables, see `seen`, in the logs that are fitted, that may choose.
        floors: standard deviation of the noise of each channel.
    """
    table = Products.at(present.point, present.candidate.residuals(present.simulation), floors)
    found: list[Ranked] = []
    for law in laws:
        z, by = samples(law, signals)
        model = models[law.place.key]
        k = knots(z, model.count, samples(law, choosing)[0] if choosing else z)
        slopes = model.slopes(law, k, by)
        if slopes is None or not np.linalg.norm(slopes[1]) > 0:
            continue
        own = table.with_(slopes[1])
        if own.beyond_parameters > EXACT:
            found.append(_ranked(law, k, slopes[0], own))
    count = max(rivals.samples(present), 3.0)
    sizes = [one.curve.edf + len(one.law.free) for one in found]
    scored = [
        replace(one, score=one.gain - 0.5 * size * math.log(count)) for one, size in zip(found, sizes, strict=True)
    ]
    return sorted(scored, key=lambda one: -one.score)


def _ranked(law: Law, k: Array, unit: float, table: Products) -> Ranked:
    curve, gain, share = first_order(table, k)
    return Ranked(law, k, unit / table.size, curve, gain, gain, share)


def first_order(table: Products, k: Array) -> tuple[Curve, float, float]:
    """The best curve of a law, its gain in nats, and its share of the avoidable sum of squares.

    The levels are updated to what the law leaves, since before they are those of the misfit and not of the noise.

    Args:
        table: Gram matrices with the law's Jacobian.
        k: (m,) knots.
    """
    weights = np.ones(table.samples.size + 1)
    for _ in range(_REWEIGHTED):
        gram, right, whole = table.across(weights)
        curve = solve(gram, right, whole, table.rows, k)
        left = table.left(weights, curve.values)
        weights = table.weights(left)
    return curve, table.gain(left), table.share(left)
