"""What gains are worth: against chance, against each other, and against what is left."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# Below this difference of scores two effects are not told apart: odds of 150 to 1.
TIE = 10.0
# An effect has to take this share of the avoidable misfit to be added.
FAIR = 0.25
# An effect is not added where records held out speak against it by more standard deviations than this.
AGAINST = 2.5
# A model is complete where noise alone leaves as much with at least this chance and less than so many times the noise's
# variance is left, whatever its pattern,
SURE, LEVEL = 1e-4, 2.0
# or where so little of the base model's misfit is left that errors of integration and a term's exact form explain it.
WHOLE = 0.998


def inflation(point: Point, cost: float | None = None) -> float:
    """Variance of what noise leaves, in units of that stated: never below 1.

    Args:
        cost: sum of squares of another model, in place of the point's own.
    """
    return max(1.0, (point.cost if cost is None else cost) / max(point.residual.size - point.x.size, 1))


def price(extra: int, count: int) -> float:
    """What parameters cost, as a fall of the sum of squares (Schwarz 1978, Annals of Statistics 6:461).

    Args:
        extra: parameters.
        count: residuals.
    """
    return extra * math.log(max(count, 2))


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
