"""Fitted and screened laws in the form of the answer: with units, uncertainty of the curve, and other places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.learn.basis import Smoothness, bends, lines, missed
from pysim.diagnosis.learn.learn import Learning
from pysim.diagnosis.learn.screening import samples
from pysim.effects.law_units import quotient
from pysim.effects.learned import LESS, TIME, Law
from pysim.types import Model
from pysim.types.answer import LearnedLaw
from pysim.types.factor import Form
from pysim.types.fit import HALF_95

Array = NDArray[np.float64]

# A level or slope whose standard deviation exceeds this share of the curve counts as absorbed by the parameters.
_ABSORBED = 0.5
# The band is that of an undersmoothed curve, with this share of the best penalty weight, plus the bias of the rest. At
# the full weight it would be a band of the smoothed law instead of the law (Hall 1992, Annals of Statistics 20:675).
_UNDER = 0.1
SHOWN = 0.01  # share of the avoidable sum of squares below which a place is left out


@dataclass(frozen=True)
class Known:
    """Covariance of a curve's coefficients (m, m), and its components (m, k) that the model's parameters absorb."""

    covariance: Array
    absorbed: Array


def answered(
    learning: Learning, held_out: tuple[float | None, float | None]
) -> tuple[tuple[LearnedLaw, ...], tuple[LearnedLaw, ...]]:
    """The law that was kept, if any, and the best law of each place, the place that explains most first.

    Args:
        held_out: error on validation logs without the law that was kept, and with it.
    """
    model, keys = learning.present.candidate.model, learning.present.candidate.space.keys
    laws: list[LearnedLaw] = []
    for k, fit in enumerate(learning.fits):
        law = _law(fit.found, model, fit.knots, fit.unit * fit.values, learning.signals)
        known = covariance_of(fit.gram, fit.smoothness, fit.values, learning.inflated)
        numbers = fit.fit.candidate.space.to_model(fit.fit.point.x).tolist()
        law = replace(law, share=learning.shares[k], edf=fit.edf, parameters=dict(zip(keys, numbers, strict=False)))
        laws.append(_with(law, known, fit.unit))
    if laws:
        laws[0] = replace(laws[0], test=learning.test, alternatives=learning.alternatives)
    if learning.law is not None:
        laws[0] = replace(laws[0], held_out=held_out)
    for one in learning.ranked:
        law = _law(one.law, model, one.knots, one.curve.values * one.unit, learning.signals)
        known = covariance_of(one.curve.gram, one.curve.smoothness, one.curve.values, 1.0)
        laws.append(_with(replace(law, share=one.share, edf=one.curve.edf), known, one.unit))
    best: dict[str, LearnedLaw] = {}
    for law in (*laws[:1], *sorted(laws[1:], key=lambda law: -law.share)):
        best.setdefault(law.slot, law)
    kept = laws[0] if learning.law is not None else None
    places = sorted(best.values(), key=lambda law: (law is not kept, -law.share))
    return (() if kept is None else (kept,)), tuple(law for law in places if law.share > SHOWN)


def _law(law: Law, model: Model, knots: Array, values: Array, signals: Mapping[str, Array]) -> LearnedLaw:
    z, _ = samples(law, signals)
    side = law.place.sides[0]
    argument, factor = law.seen(side)
    unit = model[side.output].unit or "1"
    if side.output in model.abilities.states:
        unit = quotient(unit, "s")
    if law.form is Form.VARIABLE:
        unit = quotient(unit, model[factor].unit or "1")
    empty = np.zeros((knots.size, knots.size))
    argument_unit = "s" if argument == TIME else model[argument.split(LESS)[0]].unit or "1"
    found = LearnedLaw(law.place.name, law.factor, argument, knots, values, empty, 0.0, argument_unit, unit)
    return replace(found, reach=(float(z.min()), float(z.max())))


def _with(law: LearnedLaw, known: Known, unit: float) -> LearnedLaw:
    return replace(law, covariance=unit**2 * known.covariance, absorbed=known.absorbed)


def covariance_of(gram: Array, smooth: Smoothness, values: Array, inflated: float) -> Known:
    """Covariance of a curve's coefficients, without a level or slope that other parameter values replace (absorbed)."""
    k, m = smooth.knots, values.size
    rough = smooth.bending * bends(k).T @ bends(k)
    precision = gram + _UNDER * rough
    precision += 1e-12 * float(np.trace(precision)) / m * np.eye(m)
    covariance = np.linalg.inv(precision) * inflated
    line = lines(k)
    spread, ways = np.linalg.eigh(line.T @ covariance @ line)
    absorbed = line @ ways[:, np.sqrt(np.maximum(spread, 0.0)) > _ABSORBED * float(np.linalg.norm(values))]
    bias = np.linalg.solve(precision, rough @ values) * (1 - _UNDER)
    keep = np.eye(m) - absorbed @ absorbed.T
    beside = missed(k, values)
    beside = np.maximum(np.append(beside, 0.0), np.append(0.0, beside))
    whole = covariance + np.outer(bias, bias) / HALF_95**2 + np.diag((beside / HALF_95) ** 2)
    return Known(keep @ whole @ keep, absorbed)
