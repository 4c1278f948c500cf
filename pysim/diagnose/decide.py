"""What gains are worth: against chance, against each other, and against what is left."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pysim.diagnose.screen import Footprint
from pysim.identify.greybox.evaluation import Evaluation

Array = NDArray[np.float64]

# Chance of naming something where nothing is missing, over the whole catalogue.
ALARM = 0.005
# Below this difference of scores two effects are not told apart: odds of 150 to 1.
TIE = 10.0
# An effect has to take this share of the avoidable misfit to be added.
FAIR = 0.25
# An effect is not added where records held out speak against it by more standard deviations than this.
AGAINST = 2.5
# Misfit (sum of squares over its number) up to which a model counts as complete.
COMPLETE = 1.05
# Share of the avoidable misfit that the added effects have to take together where the misfit stays above that.
WHOLE = 0.95


@dataclass(frozen=True)
class Chance:
    """What the best gain of the whole catalogue would be where nothing is missing.

    Args:
        limit: exceeded with the probability ALARM.
        p_value: of the best gain seen.
    """

    limit: float
    p_value: float


def inflation(point: Evaluation, cost: float | None = None) -> float:
    """Variance of what noise leaves, in units of that stated: never below 1.

    Args:
        cost: sum of squares of another model, in place of the point's own.
    """
    return max(1.0, (point.cost if cost is None else cost) / max(point.residual.size - point.x.size, 1))


def chance(footprints: Sequence[Footprint], *, scale: float, seed: int, draws: int = 4000) -> Chance:
    """Parametric bootstrap on the projected footprints: noise is drawn along them, and the best gain is taken.

    The gains depend on the noise through its products with the footprints only, which are normal with the footprints'
    own products as covariance; nothing has to be simulated.

    Args:
        scale: variance of the noise in units of that stated.
    """
    if not footprints:
        return Chance(0.0, 1.0)
    columns = np.array([f.left / math.sqrt(f.size) for f in footprints])
    values, vectors = np.linalg.eigh(columns @ columns.T)
    root = vectors * np.sqrt(np.clip(values, 0.0, None))
    drawn = np.random.default_rng(seed).standard_normal((draws, values.size)) @ root.T
    signed = np.array([any(p.min < (p.off or 0.0) for p in f.effect.strengths) for f in footprints])
    gains = np.where(signed | (drawn < 0), drawn, 0.0) ** 2
    best = scale * gains.max(axis=1)
    limit = float(np.quantile(best, 1 - ALARM))
    beyond = int(np.sum(best >= max(f.gain for f in footprints)))
    return Chance(limit, (beyond + 1) / (draws + 1))


def score(before: float, after: float, extra: int, count: int) -> float:
    """Fall of the sum of squares less the cost of the parameters it took (Schwarz 1978, Annals of Statistics 6:461)."""
    return before - after - extra * math.log(max(count, 2))


def p_value(gain: float, extra: int, *, scale: float) -> float:
    """Chance of a gain by noise alone, for one effect of `extra` parameters."""
    return float(stats.chi2.sf(max(gain, 0.0) / scale, extra))


def explained(gain: float, before: float, freedom: int) -> float:
    """Share of the misfit beyond noise, 0 ... 1."""
    avoidable = before - freedom
    return float(np.clip(gain / avoidable, 0.0, 1.0)) if avoidable > 0 else 0.0


def disagreement(before: Array, after: Array) -> float:
    """How far what is held out speaks for the former model, in standard deviations: negative where for the latter.

    Where one of two models is true, the difference of the sums of squares is normal with twice the distance of the
    models' answers as standard deviation and its square as mean, for the former or for the latter.

    Args:
        before, after: (n,) residuals of what is held out.
    """
    distance = float(np.linalg.norm(before - after))
    return float(after @ after - before @ before) / (2 * distance) if distance > 0 else 0.0


def excess(point: Evaluation) -> float:
    """The sum of squares above its expectation, in its standard deviations."""
    freedom = max(point.residual.size - point.x.size, 1)
    return (point.cost - freedom) / math.sqrt(2 * freedom)
