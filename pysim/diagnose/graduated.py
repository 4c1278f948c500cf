"""A refit that fits what is slow first: where a model is so far off that its fast motion is out of step.

An oscillation of the plant that the model has at another frequency, or not at all, makes the sum of squares a row of
valleys: every shift by a period is one. What is slow has no such valleys. So logs over time are smoothed, measured and
simulated alike, less and less from stage to stage; each stage starts where the one before ended.

Source: the order from low frequencies to high ones is that of Bunks et al. 1995, Geophysics 60:1457.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from pysim.diagnose.descent import descend, mean_square
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.steps import with_tolerance
from pysim.diagnose.subject import Extended
from pysim.diagnose.whiten import Innovations
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# Mean square residual above which a model counts as far off: ten times the noise.
FAR = 100.0
# Widths of the smoothing, as shares of a log's length, one after the other.
WIDTHS = (1 / 40, 1 / 160, 1 / 640)
# Tolerance of these runs over that of the others: what is far off need not be known well.
_TOLERANCE = 10.0
# How often slopes are run at one width, and the share that the smoothed sum of squares has to fall by to go on.
_ROUNDS, _WORTH = 3, 0.05


@dataclass(frozen=True)
class Smoothing:
    """A Gaussian moving average of the residuals of logs over time; other residuals pass as they are.

    Args:
        logs: first row, samples and signals of each log.
        width: standard deviation, as a share of each log's samples.
    """

    logs: tuple[tuple[int, int, int], ...]
    width: float

    @classmethod
    def of(cls, ruler: Ruler, width: float) -> Smoothing:
        """For the rows of a ruler."""
        logs, row = [], 0
        for made in ruler.whitenings:
            if isinstance(made, Innovations):
                logs.append((row, *made.scale.shape))
            row += made.size
        return cls(tuple((first, samples, signals) for first, samples, signals in logs), width)

    @property
    def size(self) -> int:
        """Rows that are smoothed."""
        return sum(samples * signals for _, samples, signals in self.logs)

    def __call__(self, rows: Array) -> Array:
        """Rows (n_r,) or (n_r, k), scaled so that white noise keeps its variance."""
        found = np.array(rows)
        for first, samples, signals in self.logs:
            deviation = max(self.width * samples, 0.5)
            part = slice(first, first + samples * signals)
            log = rows[part].reshape(samples, signals, -1)
            smooth = gaussian_filter1d(log, deviation, axis=0, mode="nearest") * np.sqrt(2 * np.sqrt(np.pi) * deviation)
            found[part] = smooth.reshape(found[part].shape)
        return found


def is_far(ruler: Ruler, point: Point) -> bool:
    """Whether a point is so far off that smoothing is worth its runs: logs over time are most of what is counted."""
    return mean_square(point) > FAR and 2 * Smoothing.of(ruler, WIDTHS[0]).size > point.residual.size


def graduated(
    ruler: Ruler, what: Extended, first: Point, *, widths: Sequence[float] = WIDTHS, rounds: int = _ROUNDS
) -> Point | None:
    """Refit on smoothed residuals, width by width.

    Args:
        first: where to start.
        widths: of the smoothing, one after the other.
        rounds: how often slopes may be run at each.
    Returns:
        the point where the last width ended, counted without smoothing and with its slopes; None where the model could
        not be simulated on the way.
    """
    bounds, rough = Bounds(*what.space.bounds()), with_tolerance(ruler, _TOLERANCE)
    point = rough.evaluation(what, first.x)
    for width in widths:
        smooth = Smoothing.of(ruler, width)
        for _ in range(rounds):
            if not point.good:
                return None
            residual, slopes = smooth(point.residual), smooth(point.jacobian)
            start = Point(point.x, float(residual @ residual), residual, slopes)
            end = descend(lambda x, smooth=smooth: _smoothed(rough, what, smooth, x), start, bounds, steps=6)  # type: ignore[misc]
            point = rough.evaluation(what, end.x)
            if start.cost - end.cost < _WORTH * start.cost:
                break
    end = ruler.evaluation(what, point.x) if point.good else point
    return end if end.good else None


def _smoothed(ruler: Ruler, what: Extended, smooth: Smoothing, x: Array) -> Array | None:
    residual = ruler.at(what, x)
    return None if residual is None else smooth(residual)
