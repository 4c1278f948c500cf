"""Tests of a larger model against a smaller one: its gain in nats (log-likelihood), and the chance of such a gain.

Autocorrelated residuals inflate the variance of a gain by lambda, so that n samples are worth n / lambda.
Source: F test at this effective sample size: Bartlett 1946, Supplement to the Journal of the Royal Statistical
Society 8:27; Kish 1965, Survey Sampling, Section 8.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc, fdtri

from pysim.diagnosis.candidate import Candidate
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.settings import Settings
from pysim.identify.greybox import Point, WeightedResiduals
from pysim.identify.greybox.effective_size import inflation
from pysim.types.answer import GainTest, Verdict

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rows:
    """The measured rows of a point, without the rows of priors: these rows are the same for all rivals.

    Args:
        residual: (n_r,) in the units of the channels.
        jacobian: (n_r, n) of the residual over its level, initial states eliminated.
        level: (n_r,) standard deviation of the residual in the row's channel.
        series, blocks: (n_r,) numbers of the log and channel, and of the block.
        ordered: numbers of the series whose rows follow each other in time.
        precision: (n, n) precision matrix of a prior of the free parameters; None without one.
    """

    residual: Array
    jacobian: Array
    level: Array
    series: NDArray[np.intp]
    blocks: NDArray[np.intp]
    ordered: frozenset[int]
    precision: Array | None = None


def rows(candidate: Candidate, residuals: WeightedResiduals, point: Point) -> Rows:
    """The measured rows of a point that could be simulated."""
    own = point.series >= 0
    ordered = frozenset(number for number, (one, _) in enumerate(residuals.series) if one.domain == "time")
    level = candidate.levels(residuals, point)[own]
    jacobian = point.jacobian[own] if point.jacobian.size else np.zeros((int(own.sum()), 0))
    numbers = point.series[own], point.blocks[own], ordered
    return Rows(point.residual[own] * level, jacobian, level, *numbers, candidate.precision)


def of(fit: FinalFit) -> Rows:
    """The measured rows of a refit at its best point."""
    return rows(fit.candidate, fit.candidate.residuals(fit.simulation), fit.point)


def effective(left: Rows, changed: Array) -> float:
    """lambda, at least 1: by how much the colour of the residual inflates the variance of what an effect gains.

    Samples of a log count by their autocorrelations. The harmonics of a steady sine, or the points of a table, count
    as a cluster, by the square of the sum of their products.

    Args:
        left: rows of the larger model.
        changed: (n_r,) by which the effect changes the residual, in the units of the channels.
    """
    rest, change = left.residual / left.level, changed / left.level
    total = float(change @ change)
    if not total > 0:
        return 1.0
    found = 0.0
    for number in np.unique(left.series).tolist():
        own = left.series == number
        e, d = rest[own], change[own]
        if number in left.ordered:
            found += float(np.mean(e**2)) * float(d @ d) * inflation([e[:, None]], [d[:, None]])
    cluster = ~np.isin(left.series, list(left.ordered))
    if cluster.any():
        found += _clustered(rest[cluster], change[cluster], left, cluster)
    return max(found / total, 1.0)


def _clustered(rest: Array, change: Array, left: Rows, own: NDArray[np.bool_]) -> float:
    """Sum over clusters of the square of sum(rest * change); at least its value for independent rows."""
    edges = np.flatnonzero(np.diff(left.blocks[own]) != 0) + 1
    scores = [float(e @ d) for e, d in zip(np.split(rest, edges), np.split(change, edges), strict=True)]
    return max(float(np.sum(np.square(scores))), float(np.sum((rest * change) ** 2)))


def p_value(gain: float, df: float, samples: float, size: int, inflated: float) -> float:
    """p-value of the F test: chance of such a gain (nats) by `df` further parameters if the smaller model is true.

    Args:
        samples: number of samples of all channels.
        size, inflated: number of free parameters, and lambda, of the larger model.
    """
    freedom = samples / inflated - size
    if freedom < 1:
        return 1.0
    ratio = math.expm1(min(2 * max(gain, 0.0) / samples, 600.0)) * freedom / df
    return float(fdtrc(df, freedom, ratio))


def least_gain(chance: float, df: int, samples: float, size: int, inflated: float) -> float:
    """Gain in nats whose `p_value` is `chance`; infinite if there are too few samples for a test."""
    freedom = samples / inflated - size
    if freedom < 1:
        return math.inf
    return 0.5 * samples * math.log1p(float(fdtri(df, freedom, 1.0 - chance)) * df / freedom)


def samples(fit: FinalFit) -> float:
    """Number of fitted samples of all channels, and of rows whose level is known."""
    residuals = fit.candidate.residuals(fit.simulation)
    return float(residuals.samples.sum()) + residuals.known_rows


def penalised(gain: float, df: float, inflated: float, samples: float) -> float:
    """Penalised gain, nats: half the difference in BIC (Schwarz 1978) at the effective sample size, times lambda."""
    return gain - 0.5 * df * inflated * math.log(max(samples / inflated, 3.0))


def tolerance(inflated: float, changed: Array, level: Array, factor: float) -> float:
    """`factor` standard deviations of the difference of two gains by chance, nats.

    Args:
        changed, level: (n_r,) difference of the two models' residuals, and the level of each row.
    """
    return factor * math.sqrt(inflated * float(np.sum((changed / level) ** 2)))


def reach(own: Rows, other: Rows, factor: float) -> float:
    """`tolerance` of the gains of two models, in the levels of the first: models with closer gains are tied."""
    apart = other.residual - own.residual
    return tolerance(effective(own, apart), apart, own.level, factor)


def gain_test(
    smaller: FinalFit, larger: FinalFit, gain: float, df: float, size: int, choices: int, settings: Settings
) -> GainTest:
    """F test of the gain of a larger model at the effective sample size, Bonferroni-corrected.

    Args:
        gain, df: nats, and number of further parameters; for a curve its effective number of coefficients.
        size: number of free parameters of the larger model.
        choices: number of comparisons by which the p-value is multiplied.
    """
    left, count = of(larger), samples(larger)
    inflated = effective(left, of(smaller).residual - left.residual)
    chance = min(p_value(gain, df, count, size, inflated) * choices, 1.0)
    verdict = (
        Verdict.UNDECIDABLE if count / inflated - size < settings.decidable
        else Verdict.BETTER if chance < settings.false_alarm
        else Verdict.NO_BETTER
    )  # fmt: skip
    worth = penalised(gain, df, inflated, count)
    return GainTest(gain, math.ceil(df), count / inflated, chance, worth, None, verdict)


def left_out_error(found: Rows, blocks: NDArray[np.intp], level: Array) -> Array:
    """Leave-one-block-out error: of each block, the cost once only the other blocks are fitted, to first order.

    Args:
        blocks, level: (n_r,) number of each row's block, and standard deviation in which errors are counted.
    Returns:
        (n_b,) half sums of squares, nats.
    Source: Allen 1974, Technometrics 16:125; Giordano and others 2019, AISTATS.
    """
    residual = found.residual / found.level
    slopes = found.jacobian
    whole = slopes.T @ slopes
    ridge = 1e-9 * float(np.trace(whole)) * np.eye(len(whole))
    ridge += 0.0 if found.precision is None else found.precision
    errors = np.zeros(int(blocks.max()) + 1 if blocks.size else 0)
    for b in range(errors.size):
        own = blocks == b
        part, rest = slopes[own], residual[own]
        moved = rest + part @ np.linalg.solve(whole - part.T @ part + ridge, part.T @ rest) if len(whole) else rest
        errors[b] = 0.5 * float(np.sum((moved * found.level[own] / level[own]) ** 2))
    return errors


def shares_of_blocks(changed: Array, level: Array, blocks: NDArray[np.intp]) -> Array:
    """(n_b,) share of each block in the sum of squares of what an effect changes, over the levels."""
    size = np.bincount(blocks, (changed / level) ** 2)
    return np.asarray(size / max(float(size.sum()), np.finfo(float).tiny))
