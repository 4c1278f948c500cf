"""A model with parameters less, refitted from where one with more has led."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose import decide
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.refit import chord_refit, refit_from
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# A cheap refit has to end no more of this many prices of the parameters lost, and of this share of what losing them has
# cost at first, above the larger model.
_PRICES, _SHARE = 5.0, 0.5


def reduced(ruler: Ruler, larger: Fitted, what: Extended, columns: Sequence[int]) -> tuple[Point, Array] | None:
    """Refit from the larger model's numbers.

    Args:
        ruler: that counts what is refitted, and the larger model's point.
        columns: (n,) of the larger model's space, those that the other has.
    Returns:
        the best point, and where its slopes were run; None where a cheap refit is far from the larger model, or the
        model could not be simulated.
    """
    x = larger.point.x[list(columns)]
    residual = ruler.at(what, x)
    if residual is None:
        return None
    start = Point(x, float(residual @ residual), residual, larger.point.jacobian[:, list(columns)])
    end = chord_refit(ruler, what, start, steps=6)
    price = decide.price(larger.point.x.size - x.size, larger.point.residual.size)
    if end.cost - larger.point.cost > _PRICES * price + _SHARE * (start.cost - larger.point.cost):
        return None
    first = ruler.evaluation(what, end.x)
    return refit_from(ruler, what, first, rounds=2) if first.good else None
