"""The experiment's signals at communication points and between them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pysim.cosim._layout import Layout, view_of
from pysim.cosim.member import Array
from pysim.types import Experiment

# So many communication points are evaluated at once.
_PART = 1024


class Signals:
    """Values of all signals, (n_s) in the layout's order; whole communication points come from a table."""

    def __init__(self, experiment: Experiment, layout: Layout, step: float) -> None:
        self._start, self._step = experiment.start, step
        self._functions = [_function(experiment, name) for name in layout.signals]
        self._tick = 0
        self._rows: list[memoryview[float]] = []

    def at(self, tick: int) -> memoryview[float]:
        """Values at start + tick * step."""
        line = tick - self._tick
        if not 0 <= line < len(self._rows):
            self._tick, line = tick, 0
            times = _after(self._start + np.arange(tick, tick + _PART) * self._step)
            table = np.column_stack([of(times) for of in self._functions])
            self._rows = [view_of(row) for row in table]
        return self._rows[line]

    def between(self, time: float) -> memoryview[float]:
        """Values at any time, s."""
        times = _after(np.array([time]))
        return view_of(np.array([of(times)[0] for of in self._functions], dtype=np.float64))


def _after(times: NDArray[np.floating]) -> Array:
    """The same times, to the right of a jump that rounding would put behind them."""
    return np.asarray(times + 4 * np.spacing(np.abs(times)), dtype=np.float64)


def _function(experiment: Experiment, name: str) -> Callable[[Array], Array]:
    if name in experiment.rates:
        return experiment.inputs[experiment.rates[name]].derivative
    return experiment.inputs[name].value
