"""A law that was fitted, or screened, as the answer has it: units, what the data tell of its curve, and where else."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.learn.basis import Smoothness, bends, lines, missed
from pysim.diagnosis.learn.laws import TIME, Law
from pysim.diagnosis.learn.learn import Learning
from pysim.types import Model
from pysim.types.answer import LearnedLaw
from pysim.types.fit import HALF_95

Array = NDArray[np.float64]

# A level or slope known no better than to this share of the curve is taken as one that the parameters absorb.
_ABSORBED = 0.5
# The band is that of a curve held smooth with this share of the weight that fits best, and counts what the rest may
# have flattened: around the smoothest curve that fits it would be one of something smoother (Hall 1992, Annals of
# Statistics 20:675).
_UNDER = 0.1
_SHOWN = 0.01  # share of what is missing below which a place is not worth a row


@dataclass(frozen=True)
class Known:
    """What the data tell of a curve: covariance of its coefficients (m, m), and ways (m, k) that they leave open."""

    covariance: Array
    absorbed: Array


def answered(
    learning: Learning, held_out: tuple[float | None, float | None]
) -> tuple[tuple[LearnedLaw, ...], tuple[LearnedLaw, ...]]:
    """The law that was kept, if one was, and of each place its best law, the likeliest place first.

    Args:
        held_out: error of the logs that may choose before the last step and after it, which was the law that was kept.
    """
    model, keys = learning.present.candidate.model, learning.present.candidate.space.keys
    laws: list[LearnedLaw] = []
    for k, fit in enumerate(learning.fits):
        law = _law(fit.law, model, fit.knots, fit.unit * fit.values)
        known = covariance_of(fit.gram, fit.smoothness, fit.values, learning.inflated)
        numbers = fit.fit.candidate.space.to_model(fit.fit.point.x).tolist()
        law = replace(law, share=learning.shares[k], edf=fit.edf, parameters=dict(zip(keys, numbers, strict=False)))
        laws.append(_with(law, known, fit.unit))
    if laws:
        laws[0] = replace(laws[0], test=learning.test, alternatives=learning.alternatives)
    if learning.law is not None:
        laws[0] = replace(laws[0], held_out=held_out)
    for one in learning.ranked:
        law = _law(one.law, model, one.knots, one.curve.values * one.unit)
        known = covariance_of(one.curve.gram, one.curve.smoothness, one.curve.values, 1.0)
        laws.append(_with(replace(law, share=one.share, edf=one.curve.edf), known, one.unit))
    best: dict[str, LearnedLaw] = {}
    for law in (*laws[:1], *sorted(laws[1:], key=lambda law: -law.share)):
        best.setdefault(law.slot, law)
    kept = laws[0] if learning.law is not None else None
    places = sorted(best.values(), key=lambda law: (law is not kept, -law.share))
    return (() if kept is None else (kept,)), tuple(law for law in places if law.share > _SHOWN)


def _law(law: Law, model: Model, knots: Array, values: Array) -> LearnedLaw:
    side = law.place.sides[0]
    argument, factor = law.seen(side)
    unit = model[side.output].unit or "1"
    if side.output in model.abilities.states:
        unit = quotient(unit, "s")
    if factor and not law.is_sign:
        unit = quotient(unit, model[factor].unit or "1")
    empty = np.zeros((knots.size, knots.size))
    argument_unit = "s" if argument == TIME else model[argument].unit or "1"
    return LearnedLaw(
        law.place.name, law.factor, argument, knots, values, empty, 0.0, argument_unit, unit, sign_width=law.width
    )


def _with(law: LearnedLaw, known: Known, unit: float) -> LearnedLaw:
    return replace(law, covariance=unit**2 * known.covariance, absorbed=known.absorbed)


def covariance_of(gram: Array, smooth: Smoothness, values: Array, inflated: float) -> Known:
    """Covariance of a curve's coefficients, without the level or slope that the model's own parameters absorb."""
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


def quotient(unit: str, by: str) -> str:
    """A unit over another, as Modelica writes it: "N" over "m/s" is "N.s/m"."""
    powers: dict[str, int] = {}
    for text, sign in ((unit, 1), (by, -1)):
        above, _, below = text.replace(" ", "").partition("/")
        for part, side in ((above, sign), (below.strip("()"), -sign)):
            for factor in filter(None, part.split(".")):
                symbol = factor.rstrip("-0123456789")
                if symbol:
                    powers[symbol] = powers.get(symbol, 0) + side * int(factor[len(symbol) :] or 1)
    over = [_power(symbol, n) for symbol, n in powers.items() if n > 0]
    under = [_power(symbol, -n) for symbol, n in powers.items() if n < 0]
    whole = ".".join(over) or "1"
    if not under:
        return whole
    return f"{whole}/{under[0]}" if len(under) == 1 else f"{whole}/({'.'.join(under)})"


def _power(symbol: str, n: int) -> str:
    return symbol if n == 1 else f"{symbol}{n}"
