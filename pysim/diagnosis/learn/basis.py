"""The curve of a law: where its knots stand, how smooth it is held, and how smooth the data want it.

Source: penalised splines with the weight of the penalty by restricted maximum likelihood: Wood 2011, Journal of the
Royal Statistical Society B 73:3; its steps near an optimum Wood and Fasiolo 2017, Biometrics 73:1071.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Quantiles of an argument between which a curve is drawn, and the share of the samples that has to lie on either side
# of zero for zero to matter.
_RANGE, _BOTH = (0.002, 0.998), 0.05
# Width of the arcsinh scale over the reach, and ratio of the ends from which on a scale of ratios is mixed in.
_ARCSINH, _DECADE = 0.05, 10.0
# Weight of level and slope, in shares of what the data give a value: too little to matter where they tell something.
_LEVEL = 1e-4
# Weights of bends that are tried, in the same shares: from none to a straight line.
_LEAST, _MOST = 1e-9, 1e3


def knots(z: Array, count: int) -> Array:
    """Places (count,) for the knots of a curve over a variable's samples z (n,), increasing.

    Dense around zero by an arcsinh scale where z goes through it, since laws that change abruptly mostly do so there.
    Over a variable that spans a decade or more they stand half way between even steps and equal ratios.
    """
    low, high = (float(end) for end in np.quantile(z, _RANGE))
    if not high - low > 1e-9 * max(abs(low), abs(high)):
        low, high = low - 1e-9 - 1e-3 * abs(low), high + 1e-9 + 1e-3 * abs(high)
    reach = max(-low, high)
    if np.mean(z < -0.02 * reach) > _BOTH and np.mean(z > 0.02 * reach) > _BOTH:
        scale = _ARCSINH * reach
        return np.asarray(scale * np.sinh(np.linspace(math.asinh(low / scale), math.asinh(high / scale), count)))
    even = np.linspace(low, high, count)
    return np.asarray((even + np.geomspace(low, high, count)) / 2 if 0 < _DECADE * low < high else even)


def missed(k: Array, c: Array) -> Array:
    """What straight lines may miss in each interval (m - 1,): an eighth of the curvature times the interval squared.

    Args:
        k: (m,) knots; c: (m,) values there.
    """
    slope = np.diff(c) / np.diff(k)
    curvature = np.zeros(k.size)
    curvature[1:-1] = np.abs(2 * np.diff(slope) / (k[2:] - k[:-2]))
    curvature[0], curvature[-1] = curvature[1], curvature[-2]
    return np.asarray(np.maximum(curvature[1:], curvature[:-1]) * np.diff(k) ** 2 / 8)


def closer(k: Array, c: Array) -> Array:
    """Knots (2m - 1,): these (m,) and as many more as there are intervals, where straight lines miss most.

    An interval that is halved misses a quarter in each half.
    """
    edges, scores = k.tolist(), missed(k, c).tolist()
    for _ in range(k.size - 1):
        i = int(np.argmax(scores))
        edges.insert(i + 1, 0.5 * (edges[i] + edges[i + 1]))
        scores[i : i + 1] = [scores[i] / 4, scores[i] / 4]
    return np.array(edges)


def bends(k: Array) -> Array:
    """Rows (m - 2, m): change of slope at each inner knot, over its neighbourhood; none for a straight line."""
    h = np.diff(k)
    rows, width = np.zeros((k.size - 2, k.size)), (h[1:] + h[:-1]) / 2
    inner = np.arange(k.size - 2)
    rows[inner, inner], rows[inner, inner + 2] = width / h[:-1], width / h[1:]
    rows[inner, inner + 1] = -width / h[:-1] - width / h[1:]
    return rows


def lines(k: Array) -> Array:
    """Orthonormal columns (m, 2): level and slope."""
    return np.asarray(np.linalg.qr(np.column_stack([np.ones(k.size), (k - k.mean()) / np.ptp(k)]))[0])


@dataclass(frozen=True)
class Smoothness:
    """The prior of a curve's coefficients, precision `bending * B'B + level * L L'`, in residuals over their level.

    Args:
        knots: (m,).
        bending, level: weights, of the bends and of level and slope.
    """

    knots: Array = field(repr=False)
    bending: float
    level: float

    @property
    def rows(self) -> Array:
        """(m, m) whose squares times coefficients are the penalty."""
        own = math.sqrt(self.bending) * bends(self.knots), math.sqrt(self.level) * lines(self.knots).T
        return np.vstack(own)

    @property
    def precision(self) -> Array:
        """(m, m)."""
        return np.asarray(self.rows.T @ self.rows)

    def moved(self, gram: Array, c: Array) -> Smoothness:
        """The weight of bends that suits the coefficients c (m,) at an optimum (Fellner-Schall step).

        Args:
            gram: (m, m) products of the slopes, by the coefficients, of the residual over its level, across what
                parameters explain.
        """
        rough = bends(self.knots).T @ bends(self.knots)
        taken = self.bending * float(np.trace(np.linalg.solve(gram + self.precision, rough)))
        bent, typical = max(float(c @ rough @ c), 1e-300), float(np.trace(gram)) / c.size
        weight = max(self.knots.size - 2 - taken, 1e-3) / bent
        return replace(self, bending=float(np.clip(weight, _LEAST * typical, _MOST * typical)))

    def edf(self, gram: Array) -> float:
        """How many coefficients the data determine."""
        return float(np.trace(np.linalg.solve(gram + self.precision, gram)))


@dataclass(frozen=True)
class Curve:
    """The best curve to first order.

    Args:
        values: (m,) coefficients.
        smoothness: that the data want.
        edf: effective number of coefficients.
        gram: (m, m) products of the columns that gave it.
    """

    values: Array
    smoothness: Smoothness
    edf: float
    gram: Array


def solve(gram: Array, right: Array, whole: float, n: float, k: Array) -> Curve:
    """Coefficients c that minimise |r + A c|^2, smooth as far as the data do not say otherwise.

    Args:
        gram, right, whole: A'A (m, m), A'r (m,) and r'r, of n rows across what refitting takes.
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
    values = -np.linalg.solve(gram + smooth.precision, right)
    return Curve(np.asarray(values), smooth, smooth.edf(gram), gram)
