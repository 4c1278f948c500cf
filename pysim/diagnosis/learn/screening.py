"""All laws at all places to first order at a fitted model: one penalised regression each, parameters refitted."""

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

# Runs over time whose signals are looked at for the knots, and samples of each at most.
_RUNS, _SAMPLES = 24, 4000
# What two arguments may differ by, over their range, to count as the same up to scale and offset.
_SAME = 1e-4
_BOTH = 0.05  # share of the samples that a sign must have on either side
# Unit of coefficients before anything is known of them, so small that any model answers to it in proportion.
_LITTLE = 1e-12
_REWEIGHTED = 3  # times that levels follow what a law leaves


@dataclass(frozen=True)
class Ranked:
    """One law to first order.

    Args:
        law: which.
        knots: (m,) of its curve.
        unit: of its coefficients.
        curve: its coefficients, in that unit.
        gain: nats that it promises, parameters refitted.
        score: gain less the penalty of its effective coefficients.
        share: of the sum of squares over the floors that could be avoided, 0 ... 1.
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
    """A compiled model with terms, beside the measurements that a fitted model without them is held against.

    Args:
        place: with the term.
        count: knots of its curve.
        present: the model without.
        model: the compiled one.
    """

    place: Place
    count: int
    present: FinalFit = field(repr=False)
    model: Model = field(repr=False)

    @cached_property
    def problem(self) -> Problem:
        """The measurements beside the compiled model."""
        return beside(self.present.candidate.problem, self.model, [])

    def slopes(self, law: Law, k: Array, by: Array) -> tuple[float, Array] | None:
        """Unit of a law's coefficients, and slopes (n_r, m) by them where all are 0; None where it does not run.

        Args:
            k: (m,) knots; by: (n,) samples of its factor.
        """
        unit = _LITTLE / max(float(np.sqrt(np.mean(by**2))), 1e-300)
        names = self.place.coefficients(k.size)
        candidate = self.candidate(law.settings(k, unit), names, np.ones(k.size), free=False)
        point = candidate.residuals(self.present.simulation).evaluate(
            candidate.model, candidate.space, np.zeros(k.size), self.present.point.carried
        )
        return (unit, point.jacobian) if point.good and np.isfinite(point.jacobian).all() else None

    def candidate(self, settings: Mapping[str, float], names: Sequence[str], scale: Array, *, free: bool) -> Candidate:
        """The model with laws: its parameters free (or held where they stand), then these coefficients (m,).

        Args:
            settings: of the laws' terms; scale: (m,) of the coefficients in the search.
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
    """Samples (n,) of every variable that a law may depend on, along the fitted model's runs; none that failed."""
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
    """The laws at these places without those that say the same: signals that are others, scaled and shifted, and signs
    of what never changes its sign."""
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
    """Mean 0 and standard deviation 1; 0 of what never moves."""
    spread = float(z.std())
    return (z - z.mean()) / spread if spread > 1e-12 * float(np.abs(z).max()) else np.zeros(z.size)


def _alike(one: Array, other: Array) -> bool:
    """Whether two scaled signals (n,) are the same but for their sign."""
    return one is other or (one.size == other.size and abs(abs(float(np.mean(one * other))) - 1) < _SAME)


def screen(
    present: FinalFit,
    models: Mapping[str, LawModel],
    laws: Sequence[Law],
    signals: Mapping[str, Array],
    floors: Mapping[Channel, float],
) -> list[Ranked]:
    """Every law to first order, the best first; those that do not run are left out.

    Args:
        present: the model that lacks something.
        models: of each place's key, with a term there.
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
    """The best curve of a law, the nats that it promises, and its share of what could be avoided.

    Levels follow what the law leaves: where misfit outweighs noise, those of the model without it say little.

    Args:
        table: with the law's slopes (n_r, m).
        k: (m,) knots.
    """
    weights = np.ones(table.samples.size + 1)
    for _ in range(_REWEIGHTED):
        gram, right, whole = table.across(weights)
        curve = solve(gram, right, whole, table.rows, k)
        left = table.left(weights, curve.values)
        weights = table.weights(left)
    return curve, table.gain(left), table.share(left)
