"""How rough a response is over its parameters: one that sticks and slips falls into step with any change of them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler

Array = NDArray[np.float64]

# Length of a step, in standard deviations of what is estimated: a smooth response is straight over it.
_SHORT = 0.1
# No longer and no shorter than this, in units of the search: natural logarithms of most parameters. Slopes of a plant
# without memory have no bound.
_LONGEST, _SHORTEST = 1e-2, 1e-5
# Less than this is left as it is, in standard deviations of the noise: no parameter moves by more of its own.
_SMALL = 1.0
# Length of a second difference of errors that have nothing to do with each other, over the length of one.
_SECOND = math.sqrt(6)


def roughness(ruler: Ruler, at: Fitted) -> float:
    """Length of what a change of parameters too small to matter does to the residuals; 0 where that is a straight line.

    Args:
        at: with slopes (n_r, n).
    """
    x, step = at.point.x, _step(at)
    above, below = (ruler.at(at.what, point) for point in (x + step, x - step))
    if above is None or below is None:
        return 0.0
    length = float(np.linalg.norm(above - 2 * at.point.residual + below)) / _SECOND
    return length if length >= _SMALL else 0.0


def _step(at: Fitted) -> Array:
    """As long in every direction (n,), in units of its standard deviation, and to both sides within the bounds."""
    slopes = np.linalg.qr(at.point.jacobian, mode="r")
    _, sizes, turned = np.linalg.svd(slopes, full_matrices=False)
    lengths = _SHORT / np.clip(sizes, _SHORT / _LONGEST, _SHORT / _SHORTEST)
    step = lengths @ turned / math.sqrt(len(sizes))
    lower, upper = at.what.space.bounds()
    x = at.point.x
    inside = (x - np.abs(step) >= lower) & (x + np.abs(step) <= upper)
    return np.where(inside, step, 0.0)
