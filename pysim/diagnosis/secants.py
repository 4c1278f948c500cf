"""Jacobian of a model with events: finite differences and Broyden updates, since sensitivities need smooth laws.

Source: Broyden 1965, Mathematics of Computation 19:577.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.candidate import Candidate, Key
from pysim.identify.greybox import Point, Simulation
from pysim.identify.greybox.residuals import Carried

Array = NDArray[np.float64]

# Steps of a finite difference, in search variables: the first one, the factor to the next, and the longest. A step is
# long enough if it changes the residual by _SEEN of its level, more than integration errors do.
_FIRST, _LONGER, _LONGEST = 3e-3, 6.0, 0.11
_SEEN = 0.1


class Secants:
    """The objective with a Jacobian that is known, or found by differences, at the start and updated at each point.

    Initial states are held, since the Jacobian does not cover them.

    Args:
        candidate: a model with events.
        simulation: solver settings of its runs.
        known: key -> (n_r,) derivative of the measured rows at a point nearby, in the units of the channels; None
            if nothing is known.
    """

    def __init__(self, candidate: Candidate, simulation: Simulation, known: Mapping[Key, Array] | None) -> None:
        self._candidate, self._residuals = candidate, candidate.residuals(simulation)
        self._known = known or {}
        self._slopes: Array | None = None
        self._at: tuple[Array, Array] | None = None  # last point (n,), and its residual (n_r,) in the channels' units

    def evaluate(self, x: Array, carried: Carried) -> Point:
        """The objective at x (n,)."""
        point = self._plain(x, carried)
        if not point.good:
            return point
        size = self._candidate.levels(self._residuals, point)
        residual = point.residual * size
        if self._slopes is None or self._slopes.shape[0] != residual.size:
            self._slopes = self._first(x, carried, residual, point.series >= 0)
        elif self._at is not None:
            step = x - self._at[0]
            square = float(step @ step)
            if square > 0:
                change = residual - self._at[1] - self._slopes @ step
                self._slopes = np.asarray(self._slopes + np.outer(change, step) / square)
        self._at = x, residual
        steps = tuple(s and s._replace(by=np.zeros((len(s.by), x.size))) for s in point.steps)
        return replace(point, jacobian=self._slopes / size[:, None], steps=steps)

    def _plain(self, x: Array, carried: Carried) -> Point:
        candidate = self._candidate
        return self._residuals.evaluate(candidate.model, candidate.space, x, carried, jacobian=False, states=False)

    def _first(self, x: Array, carried: Carried, residual: Array, rows: NDArray[np.bool_]) -> Array:
        """First Jacobian (n_r, n): the known columns, and finite differences for the others."""
        columns = []
        for j, key in enumerate(self._candidate.keys):
            known = self._known.get(key)
            if known is not None and known.size == np.count_nonzero(rows):
                column = np.zeros(residual.size)
                column[rows] = known
                columns.append(column)
                continue
            columns.append(self._difference(x, carried, residual, j))
        return np.column_stack(columns) if columns else np.zeros((residual.size, 0))

    def _difference(self, x: Array, carried: Carried, residual: Array, j: int) -> Array:
        """(n_r,) derivative by the j-th variable, over a step long enough to be seen; 0 if no run succeeds."""
        upper, column, step = self._candidate.space.bounds()[1][j], np.zeros(residual.size), _FIRST
        while step <= _LONGEST:
            moved = x.copy()
            moved[j] += step if x[j] + step <= upper else -step
            there = self._plain(moved, carried)
            if not there.good:
                break
            size = self._candidate.levels(self._residuals, there)
            change = there.residual * size - residual
            column = change / (moved[j] - x[j])
            if float(np.mean((change / size) ** 2)) >= _SEEN**2:
                break
            step *= _LONGER
        return column
