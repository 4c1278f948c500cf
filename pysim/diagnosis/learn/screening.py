"""Screening of all laws at all places of a fitted model: one penalised regression each, with parameters refitted."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Candidate
from pysim.diagnosis.learn.basis import Curve, knots, solve
from pysim.diagnosis.learn.laws import TIME, Law, Place, samples
from pysim.diagnosis.learn.products import Products
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.settings import LearnSettings
from pysim.identify.greybox import Problem
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.problem import beside
from pysim.identify.greybox.residuals import Channel
from pysim.simulate import Rodas, simulate_many
from pysim.types import Model, Outcome

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
    """

    place: Place
    count: int
    present: FinalFit = field(repr=False)
    model: Model = field(repr=False)

    @cached_property
    def problem(self) -> Problem:
        """The compiled model and the measurements."""
        return beside(self.present.candidate.problem, self.model, [])

    def slopes(self, law: Law, k: Array, by: Array) -> tuple[float, Array] | None:
        """Scale of a law's coefficients, and the Jacobian (n_r, m) by them at 0; None if the run fails.

        Args:
            k, by: (m,) knots, and (n,) samples of its factor.
        """
        unit = _LITTLE / max(float(np.sqrt(np.mean(by**2))), 1e-300)
        names = self.place.coefficients(k.size)
        candidate = self.candidate(law.settings(k, unit), names, np.ones(k.size), free=False)
        point = candidate.residuals(self.present.simulation.rough()).evaluate(
            candidate.model, candidate.space, np.zeros(k.size), self.present.point.carried
        )
        return (unit, point.jacobian) if point.good and np.isfinite(point.jacobian).all() else None

    def candidate(self, settings: Mapping[str, float], names: Sequence[str], scale: Array, *, free: bool) -> Candidate:
        """A candidate whose free variables are the parameters of the model, if `free`, and these coefficients (m,).

        Args:
            settings, scale: parameters that choose the law, and (m,) scale of the coefficients in the search.
        """
        own = self.present.candidate
        held = own.held(self.present.values) if not free else own.space
        space = _with_coefficients(held, settings, names, scale)
        return replace(own, problem=replace(self.problem, space=space))


def _with_coefficients(
    base: ParameterSpace, settings: Mapping[str, float], names: Sequence[str], scale: Array
) -> ParameterSpace:
    count, far = len(names), np.full(len(names), math.inf)
    return ParameterSpace(
        keys=(*base.keys, *names),
        variables=(*base.variables, *names),
        records=(*base.records, *(None,) * count),
        units=(*base.units, *("1",) * count),
        start=np.append(base.start, np.zeros(count)),
        lower=np.append(base.lower, -far),
        upper=np.append(base.upper, far),
        scale=np.append(base.scale, scale),
        log=np.append(base.log, np.zeros(count, dtype=bool)),
        ties=base.ties,
        fixed={**base.fixed, **settings},
    )


def seen(present: FinalFit, model: Model, places: Sequence[Place]) -> dict[str, Array]:
    """Samples (n,) of every variable that a law may depend on, from the fitted model's runs; empty if all runs fail."""
    names = {name for place in places for side in place.sides for name in (*side.own, *place.outside)} - {TIME}
    residuals = present.candidate.residuals(present.simulation)
    overrides = present.candidate.held(present.values).fixed
    states = present.point.carried.states or (None,) * len(residuals.runs)
    offsets = [None if run.orbit is not None else s for run, s in zip(residuals.runs, states, strict=True)]
    runs = [run.over_time(overrides, offset) for run, offset in zip(residuals.runs, offsets, strict=True)]
    runs = sorted(runs, key=lambda run: float(run.times[-1]) - run.start, reverse=True)[:_RUNS]
    looked = [
        replace(r, times=r.times[:: math.ceil(r.times.size / _SAMPLES)], record=tuple(sorted(names))) for r in runs
    ]
    records = [r for r in simulate_many(model, looked, solver=Rodas(1e-3, 1e-3)) if r.outcome is Outcome.DONE]
    if not records:
        return {}
    found = {name: np.concatenate([r[name] for r in records]) for name in names}
    return {**found, TIME: np.concatenate([r.time for r in records])}


def distinct(places: Sequence[Place], signals: Mapping[str, Array]) -> list[Law]:
    """The laws at these places without duplicates and without signs of variables that hardly change their sign.
    Signals that differ only by scale and offset are duplicates, since a curve over one is a curve over the other."""
    found: list[Law] = []
    for place in places:
        shapes = [_scaled(samples(Law(place, i), signals)[0]) for i in range(len(place.arguments))]
        first = [next(j for j, other in enumerate(shapes) if _alike(one, other)) for one in shapes]
        for law in place.laws():
            if law.is_sign:
                own = samples(replace(law, is_sign=False), signals)[1]
                width = LearnSettings().sign_width * float(np.sqrt(np.mean(own**2)))
                law = replace(law, width=float(f"{width:.2g}") or 1.0)
            by = samples(law, signals)[1]
            if first[law.chosen] != law.chosen or not np.ptp(shapes[law.chosen]) > 0 or law.by == law.chosen:
                continue
            if law.by is not None and (first[law.by] != law.by or not np.ptp(by) > _SAME * float(np.abs(by).max())):
                continue
            if not law.is_sign or min(np.mean(by > 0.5), np.mean(by < -0.5)) > _BOTH:
                found.append(law)
    return found


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
    floors: Mapping[Channel, float],
) -> list[Ranked]:
    """Screen every law to first order; the best score first. Laws that cannot be simulated are left out.

    Args:
        present: the fitted model that lacks something.
        models: key of a place -> model compiled with a term there.
        floors: standard deviation of the noise of each channel.
    """
    table = Products.at(present.point, present.candidate.residuals(present.simulation), floors)
    found: list[Ranked] = []
    for law in laws:
        z, by = samples(law, signals)
        model = models[law.place.key]
        k = knots(z, model.count)
        slopes = model.slopes(law, k, by)
        if slopes is not None and np.linalg.norm(slopes[1]) > 0:
            found.append(_ranked(law, k, slopes[0], table.with_(slopes[1])))
    count = max(rivals.samples(present), 3.0)
    scored = [replace(one, score=one.gain - 0.5 * one.curve.edf * math.log(count)) for one in found]
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
