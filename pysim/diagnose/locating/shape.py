"""From a fitted table to what is shown: the term over its argument, with a band, as far as the data tell it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.locating.fit import Estimate, bends, lines
from pysim.diagnose.locating.laws import KNOTS, Law
from pysim.diagnose.screen import across, column_space
from pysim.identify import HALF_95
from pysim.types import Model
from pysim.types.diagnosis import Shape

Array = NDArray[np.float64]

_POINTS = 81
# A level or slope known no better than to this share of the term is taken as one that refitting absorbs.
_ABSORBED = 0.5
# Curvature at an end, over that at the next knot, at most.
_GROWS = 4.0
# The band's doubt is that of a table held smooth with this share of the weight that fits best.
_UNDER = 0.1


@dataclass(frozen=True)
class Told:
    """What the data tell of a table.

    Args:
        knots: (m,). values: (m,) without what refitting absorbs. covariance: (m, m) of them, straight lines between
            the knots taken for granted. bent: (m - 1,) what these may miss in each interval.
        absorbed: (m, k) orthonormal directions, k = 0, 1 or 2, in which the values could be anything.
    """

    knots: Array
    values: Array
    covariance: Array
    absorbed: Array

    @property
    def bent(self) -> Array:
        """An eighth of the curvature times the interval squared."""
        k, slope = self.knots, np.diff(self.values) / np.diff(self.knots)
        curvature = np.zeros(k.size)
        curvature[1:-1] = np.abs(2 * np.diff(slope) / (k[2:] - k[:-2]))
        ends = curvature[1:3], curvature[-2:-4:-1]  # where it grows towards an end, it goes on to do so
        curvature[0], curvature[-1] = (c[0] * np.clip(c[0] / max(c[1], 1e-300), 1.0, _GROWS) for c in ends)
        return np.asarray(np.maximum(curvature[1:], curvature[:-1]) * np.diff(k) ** 2 / 8)

    @property
    def doubt(self) -> Array:
        """(m, m) covariance of the values with what straight lines miss beside each knot."""
        sides = np.maximum(np.append(self.bent, 0.0), np.append(0.0, self.bent))
        return self.covariance + np.diag((sides / HALF_95) ** 2)


def told(estimate: Estimate) -> Told:
    """Split off level or slope where the model's own parameters do the same and the data cannot tell them apart.

    The fit holds level and slope near zero by a small weight, so that what nothing determines stays where it is, and
    bends small by the weight that predicts best. What that took of what the data do determine is given back to first
    order where it is level or slope; of bends, the band counts what a tenth of the weight would give back, and the
    doubt of a table held by that tenth: around the smoothest table that fits it would be one of something smoother.

    Source: Hall 1992, Annals of Statistics 20:675, on bias and undersmoothing.
    """
    k, unit, solution = estimate.table.knots, estimate.table.unit, estimate.solution
    slopes, values = estimate.point.jacobian, estimate.point.x[-KNOTS:]
    columns = across(column_space(slopes[:, :-KNOTS]), slopes[:, -KNOTS:])
    rows = columns.shape[0]
    scale = max(1.0, solution.left / max(rows - solution.freedom, 1.0))
    rough = bends(k).T @ bends(k) * math.exp(solution.smoothing[0])
    precision = (columns.T @ columns + _UNDER * rough) / scale
    floor = 1e-12 * float(np.trace(precision)) / KNOTS
    covariance = np.linalg.inv(precision + floor * np.eye(KNOTS))
    line = lines(k)
    spread, ways = np.linalg.eigh(line.T @ covariance @ line)
    size = float(np.linalg.norm(values))
    absorbed = line @ ways[:, np.sqrt(spread) > _ABSORBED * size]
    known = line @ (line.T @ values) - absorbed @ (absorbed.T @ values)
    values = values + covariance @ known * math.exp(solution.smoothing[1]) / scale
    bias = covariance @ (rough @ values) * (1 - _UNDER) / scale
    covariance = covariance + np.outer(bias, bias) / HALF_95**2
    keep = np.eye(KNOTS) - absorbed @ absorbed.T
    return Told(k, unit * (keep @ values), unit**2 * (keep @ covariance @ keep), absorbed)


def shape(of: Told, law: Law, model: Model, along: Array, spread: Array | None = None) -> Shape:
    """The term over its argument.

    Args:
        along: (k,) amounts of the absorbed directions to show it with.
        spread: (k, k) their covariance, where a formula gives them; exact where None.
    """
    grid = np.linspace(of.knots[0], of.knots[-1], _POINTS)
    weights = np.stack([np.interp(grid, of.knots, row) for row in np.eye(KNOTS)], axis=1)
    value = weights @ (of.values + of.absorbed @ along)
    covariance = of.covariance if spread is None else of.covariance + of.absorbed @ spread @ of.absorbed.T
    half = HALF_95 * np.sqrt(np.maximum(np.einsum("gi,ij,gj->g", weights, covariance, weights), 0.0))
    inside = np.clip(np.searchsorted(of.knots, grid, side="right") - 1, 0, KNOTS - 2)
    half = np.hypot(half, of.bent[inside])
    unit_in, unit_out = units(law, model)
    return Shape(grid, value, value - half, value + half, unit_in, unit_out, weights @ of.absorbed)


def units(law: Law, model: Model) -> tuple[str, str]:
    """Of argument and term."""
    copy = law.copies[0]
    unit_in = _unit(model, copy.argument)
    unit_out = _unit(model, copy.output)
    states = model.abilities.states
    return per_second(unit_in) if law.of_rate else unit_in, per_second(unit_out) if copy.output in states else unit_out


def per_second(unit: str) -> str:
    """The unit of a rate: "m" -> "m/s" -> "m/s2", "N/m" -> "N/(m.s)"."""
    above, _, below = unit.partition("/")
    if below == "s":
        return f"{above}/s2"
    if below.startswith("s") and below[1:].isdigit():
        return f"{above}/s{int(below[1:]) + 1}"
    return f"{above}/({below.strip('()')}.s)" if below else f"{above}/s"


def _unit(model: Model, name: str) -> str:
    return next((v.unit for v in model.variables if v.name == name), "") or "1"
