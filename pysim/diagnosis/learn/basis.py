"""The curve of a law as a penalised spline: its knots, its smoothness penalty, and the weight of the penalty.

Source: weight by restricted maximum likelihood (REML): Wood 2011, Journal of the Royal Statistical Society B 73:3;
its update near an optimum (Fellner-Schall): Wood and Fasiolo 2017, Biometrics 73:1071.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.effects.learned.curve import ROUND

Array = NDArray[np.float64]

# Quantiles of the argument between which all knots but the outermost lie, and the share of samples on each side of zero
# above which these become denser around zero.
_RANGE, _BOTH = (0.002, 0.998), 0.05
# Width of the arcsinh scale over the largest value, and ratio of the ends above which equal ratios are mixed in.
_ARCSINH, _DECADE = 0.05, 10.0
# First penalty weight of level and slope, over the data's mean information on a value, so that they are determined.
_LEVEL = 1e-4
# Smallest and largest penalty weights that are tried, over the same: from free to a straight line, or to zero.
_LEAST, _MOST = 1e-12, 1e3


def knots(z: Array, count: int, others: Array | None = None) -> Array:
    """Knots (count,), increasing, of a curve over a variable with samples z (n,), and in further logs `others` (k,).

    If z has both signs, the knots are dense around zero (arcsinh scale), since most abrupt laws change there. If z is
    positive and spans a decade or more, the knots are the mean of even steps and equal ratios. The outermost knots lie
    beyond all samples by the width of a rounded corner, since a model with the law goes elsewhere than one without.
    """
    low, high = (float(end) for end in np.quantile(z, _RANGE))
    if not high - low > 1e-9 * max(abs(low), abs(high)):
        low, high = low - 1e-9 - 1e-3 * abs(low), high + 1e-9 + 1e-3 * abs(high)
    reach = max(-low, high)
    inner = np.linspace(low, high, count - 2)
    if np.mean(z < -0.02 * reach) > _BOTH and np.mean(z > 0.02 * reach) > _BOTH:
        scale = _ARCSINH * reach
        inner = scale * np.sinh(np.linspace(math.asinh(low / scale), math.asinh(high / scale), count - 2))
    elif 0 < _DECADE * low < high:
        inner = (inner + np.geomspace(low, high, count - 2)) / 2
    every = np.concatenate([[low, high], z, [] if others is None else others])
    first, last = every.min() - ROUND * (inner[1] - inner[0]), every.max() + ROUND * (inner[-1] - inner[-2])
    return np.array([first, *inner, last])


def missed(k: Array, c: Array) -> Array:
    """Interpolation error of straight lines in each interval (m - 1,): curvature times interval squared over 8.

    Args:
        k: (m,) knots; c: (m,) values there.
    """
    slope = np.diff(c) / np.diff(k)
    curvature = np.zeros(k.size)
    curvature[1:-1] = np.abs(2 * np.diff(slope) / (k[2:] - k[:-2]))
    curvature[0], curvature[-1] = curvature[1], curvature[-2]
    return np.asarray(np.maximum(curvature[1:], curvature[:-1]) * np.diff(k) ** 2 / 8)


def closer(k: Array, c: Array) -> Array:
    """Knots (2m - 1,): the given ones (m,), and one more per interval, but where the interpolation error is largest.

    Each new knot halves an interval, which leaves a quarter of the error in each half.
    """
    edges, scores = k.tolist(), missed(k, c).tolist()
    for _ in range(k.size - 1):
        i = int(np.argmax(scores))
        edges.insert(i + 1, 0.5 * (edges[i] + edges[i + 1]))
        scores[i : i + 1] = [scores[i] / 4, scores[i] / 4]
    return np.array(edges)


def bends(k: Array) -> Array:
    """Rows (m - 2, m) of second differences: the change of slope at each inner knot, times the mean interval there."""
    h = np.diff(k)
    rows, width = np.zeros((k.size - 2, k.size)), (h[1:] + h[:-1]) / 2
    inner = np.arange(k.size - 2)
    rows[inner, inner], rows[inner, inner + 2] = width / h[:-1], width / h[1:]
    rows[inner, inner + 1] = -width / h[:-1] - width / h[1:]
    return rows


def lines(k: Array) -> Array:
    """Orthonormal columns (m, 2) that span the straight lines: level and slope."""
    return np.asarray(np.linalg.qr(np.column_stack([np.ones(k.size), (k - k.mean()) / np.ptp(k)]))[0])


@dataclass(frozen=True)
class Smoothness:
    """Smoothness penalty: a Gaussian prior of a curve's coefficients with precision `bending * B'B + level * L L'`.

    Args:
        knots: (m,).
        bending, level: weights of the second differences B (`bends`), and of level and slope L (`lines`).
    """

    knots: Array = field(repr=False)
    bending: float
    level: float

    @property
    def rows(self) -> Array:
        """(m, m) matrix R, so that |R c|^2 is the penalty of coefficients c."""
        own = math.sqrt(self.bending) * bends(self.knots), math.sqrt(self.level) * lines(self.knots).T
        return np.vstack(own)

    @property
    def precision(self) -> Array:
        """(m, m) precision matrix of the prior."""
        return np.asarray(self.rows.T @ self.rows)

    def moved(self, gram: Array, c: Array) -> Smoothness:
        """The penalty with both weights updated at an optimum with coefficients c (m,) (Fellner-Schall step).

        Args:
            gram: (m, m) information of the data on the coefficients: J'J of the residual over its level, projected
                off the model's parameters. Where these imitate the whole curve, rounding is left of it, of either sign,
                and the penalty stays.
        """
        typical = float(np.trace(gram)) / c.size
        if typical <= 0:
            return self
        inverse = np.linalg.inv(gram + self.precision)

        def updated(weight: float, rows: Array) -> float:
            taken, size = weight * float(np.sum(rows @ inverse * rows)), float(np.sum((rows @ c) ** 2))
            found = max(len(rows) - taken, 1e-3) / max(size, 1e-300)
            return float(np.clip(found, _LEAST * typical, _MOST * typical))

        return replace(
            self,
            bending=updated(self.bending, bends(self.knots)),
            level=updated(self.level, lines(self.knots).T),
        )

    def edf(self, gram: Array) -> float:
        """Effective number of coefficients (effective degrees of freedom)."""
        return float(np.trace(np.linalg.solve(gram + self.precision, gram)))


@dataclass(frozen=True)
class Curve:
    """The best curve of a linear regression.

    Args:
        values: (m,) coefficients.
        smoothness: the penalty, its weight by REML.
        edf: effective number of coefficients.
        gram: (m, m) information of the data on the coefficients.
    """

    values: Array
    smoothness: Smoothness
    edf: float
    gram: Array


def solve(gram: Array, right: Array, whole: float, n: float, k: Array) -> Curve:
    """Coefficients c that minimise |r + A c|^2 plus a smoothness penalty, whose weight REML chooses.

    Args:
        gram, right, whole: A'A (m, m), A'r (m,) and r'r of n rows, projected off the model's parameters.
        k: (m,) knots.
    """
    from scipy.optimize import minimize_scalar  # 0.3 s to import, where a law is learned

    rough, level = bends(k).T @ bends(k), lines(k) @ lines(k).T
    typical = float(np.trace(gram)) / k.size or 1.0
    flat = _LEVEL * typical

    def loss(bending: float) -> float:
        prior = math.exp(bending) * rough + flat * level
        penalised = max(whole - float(right @ np.linalg.solve(gram + prior, right)), 1e-12 * whole)
        volume = float(np.linalg.slogdet(gram + prior)[1]) - float(np.linalg.slogdet(prior)[1])
        return 0.5 * n * math.log(penalised / n) + 0.5 * volume

    grid = np.linspace(math.log(_LEAST * typical), math.log(_MOST * typical), 25)
    near = int(np.argmin([loss(one) for one in grid.tolist()]))
    ends = (grid[max(near - 1, 0)], grid[min(near + 1, grid.size - 1)])
    bending = math.exp(float(minimize_scalar(loss, bounds=ends, method="bounded").x))
    smooth = Smoothness(k, bending, flat)
    first = np.asarray(-np.linalg.solve(gram + smooth.precision, right))
    smooth = replace(smooth, level=smooth.moved(gram, first).level)
    values = np.asarray(-np.linalg.solve(gram + smooth.precision, right))
    return Curve(values, smooth, smooth.edf(gram), gram)
