"""A larger model against a smaller one: what it gains, whether chance could do that, and what argues against it.

Source: the F test with the number of samples that coloured residuals are worth: Bartlett 1946, Supplement to the
Journal of the Royal Statistical Society 8:27; Kish 1965, Survey Sampling, Section 8.2.
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
    """The measurements' rows of a point: what rivals with other states and sensors have in common.

    Args:
        residual: (n_r,) in the units of the channels.
        jacobian: (n_r, n) over their levels, initial states eliminated.
        level: (n_r,) of the row's channel.
        series, blocks: (n_r,) numbers of the log and channel, and of the block.
        ordered: numbers of the series whose rows follow each other in time.
        precision: (n, n) of a prior of the free parameters; none where None.
    """

    residual: Array
    jacobian: Array
    level: Array
    series: NDArray[np.intp]
    blocks: NDArray[np.intp]
    ordered: frozenset[int]
    precision: Array | None = None


def rows(candidate: Candidate, residuals: WeightedResiduals, point: Point) -> Rows:
    """Of a good point."""
    own = point.series >= 0
    ordered = frozenset(number for number, (one, _) in enumerate(residuals.series) if one.domain == "time")
    level = candidate.levels(residuals, point)[own]
    jacobian = point.jacobian[own] if point.jacobian.size else np.zeros((int(own.sum()), 0))
    numbers = point.series[own], point.blocks[own], ordered
    return Rows(point.residual[own] * level, jacobian, level, *numbers, candidate.precision)


def of(fit: FinalFit) -> Rows:
    """The rows of what was fitted."""
    return rows(fit.candidate, fit.candidate.residuals(fit.simulation), fit.point)


def effective(left: Rows, changed: Array) -> float:
    """lambda: by how much the residual's colour inflates the variance of what an effect gains.

    Neighbours in a log count by their autocorrelation, the harmonics of a steady sine, or the points of a table, as a
    cluster whose rows are as large as they are.

    Args:
        left: of the larger model.
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
    """Sum over clusters of the squares of their scores; at least as large as if their rows were independent."""
    edges = np.flatnonzero(np.diff(left.blocks[own]) != 0) + 1
    scores = [float(e @ d) for e, d in zip(np.split(rest, edges), np.split(change, edges), strict=True)]
    return max(float(np.sum(np.square(scores))), float(np.sum((rest * change) ** 2)))


def p_value(gain: float, df: float, samples: float, size: int, inflated: float) -> float:
    """Chance of a gain (nats) by so many parameters more where there is nothing to gain.

    Args:
        samples: of all channels.
        size: free numbers of the larger model.
        inflated: lambda.
    """
    freedom = samples / inflated - size
    if freedom < 1:
        return 1.0
    ratio = math.expm1(min(2 * max(gain, 0.0) / samples, 600.0)) * freedom / df
    return float(fdtrc(df, freedom, ratio))


def least_gain(chance: float, df: int, samples: float, size: int, inflated: float) -> float:
    """nats whose `p_value` is this chance; infinite where too few samples are there to tell."""
    freedom = samples / inflated - size
    if freedom < 1:
        return math.inf
    return 0.5 * samples * math.log1p(float(fdtri(df, freedom, 1.0 - chance)) * df / freedom)


def samples(fit: FinalFit) -> float:
    """Independent numbers of all channels, and of what has a known level."""
    residuals = fit.candidate.residuals(fit.simulation)
    return float(residuals.samples.sum()) + residuals.known_rows


def penalised(gain: float, df: float, inflated: float, samples: float) -> float:
    """Gain less the penalty of its parameters, nats (Schwarz 1978 at the effective size)."""
    return gain - 0.5 * df * inflated * math.log(max(samples / inflated, 3.0))


def tolerance(inflated: float, changed: Array, level: Array, factor: float) -> float:
    """What chance makes of the difference of two gains, nats: `factor` standard deviations.

    Args:
        changed: (n_r,) difference of the two residuals; level: (n_r,).
    """
    return factor * math.sqrt(inflated * float(np.sum((changed / level) ** 2)))


def reach(own: Rows, other: Rows, factor: float) -> float:
    """The same of the gains of two models whose rows stand for the same measurements, in the levels of the first."""
    apart = other.residual - own.residual
    return tolerance(effective(own, apart), apart, own.level, factor)


def gain_test(
    smaller: FinalFit, larger: FinalFit, gain: float, df: float, size: int, choices: int, settings: Settings
) -> GainTest:
    """The F test of what a larger model gains, at the number of samples that its residual is worth.

    Args:
        gain: nats; df: numbers that the larger model has more, of a curve its effective coefficients.
        size: free numbers of the larger model.
        choices: ways to have come to the larger model by chance.
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
    return GainTest(gain, math.ceil(df), count / inflated, chance, worth, None, None, verdict)


def left_out_error(found: Rows, blocks: NDArray[np.intp], level: Array) -> Array:
    """Half the sum of squares over `level` (n_r,) of each block once the others alone were fitted, to first order.

    Args:
        blocks: (n_r,) number of each row's block.
    Returns:
        (n_b,) nats.
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
    """(n_b,) share of what an effect does that lies in each block."""
    size = np.bincount(blocks, (changed / level) ** 2)
    return np.asarray(size / max(float(size.sum()), np.finfo(float).tiny))
