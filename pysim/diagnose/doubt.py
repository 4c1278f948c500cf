"""Intervals of a fitted model."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from pysim.diagnose import decide
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.subject import Subject
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.settings import NoiseSettings
from pysim.identify.greybox.uncertainty import Uncertainty, uncertainty
from pysim.types import Direction, Estimate


def doubt(subject: Subject, fitted: Fitted) -> Uncertainty:
    """Intervals, widened where more than noise is left."""
    return uncertainty(fitted.what.space, _widened(fitted))


def held_still(subject: Subject, fitted: Fitted) -> tuple[tuple[Estimate, ...], tuple[Direction, ...]]:
    """Estimates with one parameter of each exactly undetermined direction held where it stands, and those directions.

    A direction that scales every force leaves no force an interval of its own, though an effect is there for certain.
    """
    found, point = doubt(subject, fitted), _widened(fitted)
    space, slopes, held = fitted.what.space, point.jacobian.copy(), []
    for direction in found.known.directions:
        name = next((name for name in subject.free if name in direction.exponents), "")
        if math.isinf(direction.spread) and name:
            slopes[:, space.keys.index(name)] = 0.0
            order = dict(sorted(direction.exponents.items(), key=lambda item: item[0] != name))
            held.append(replace(direction, exponents=order))
    if not held:
        return found.estimates, ()
    again = uncertainty(space, replace(point, jacobian=slopes))
    return again.estimates, tuple(held)


def _widened(fitted: Fitted) -> Point:
    """The point over what is left, in blocks of neighbouring rows.

    Where the smallest change moves the residuals by a length d, their sum of squares differs by some 2d from point to
    point, and the least of it may lie where the smooth part is higher by as much.
    """
    point = fitted.point
    size = math.sqrt(decide.inflation(point) * (1 + 2 * fitted.rough))
    rows, count = point.residual.size, NoiseSettings().blocks
    blocks = np.arange(rows) * count // max(rows, 1)
    return replace(point, residual=point.residual / size, jacobian=point.jacobian / size, blocks=blocks)
