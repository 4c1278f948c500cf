"""The experiment's signals at communication points and between them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.cosim._layout import Layout
from pysim.cosim.member import Array
from pysim.types import Experiment

# So many communication points are evaluated at once.
_PART = 1024


class Signals:
    """Values of all signals, (n_s) in the layout's order; whole communication points come from a table."""

    def __init__(self, experiment: Experiment, layout: Layout, step: float) -> None:
        self._start, self._step = experiment.start, step
        self._functions = [_function(experiment, name) for name in layout.signals]
        self._first = len(layout.outputs)
        self._part, self._table = -1, [[0.0]]

    def at(self, tick: int) -> Sequence[float]:
        """Values at start + tick * step."""
        part, line = divmod(tick, _PART)
        if part != self._part:
            times = _after(self._start + np.arange(part * _PART, (part + 1) * _PART) * self._step)
            self._table = np.column_stack([of(times) for of in self._functions]).tolist()
            self._part = part
        return self._table[line]

    def between(self, time: float) -> Sequence[float]:
        """Values at any time, s."""
        times = _after(np.array([time]))
        return [float(of(times)[0]) for of in self._functions]

    def writer(self, view: memoryview[float]) -> Callable[[Sequence[float]], None]:
        """A function that writes values to their slots."""
        first = self._first

        def write(values: Sequence[float]) -> None:
            slot = first
            for value in values:
                view[slot] = value
                slot += 1

        return write


def _after(times: NDArray[np.floating]) -> Array:
    """The same times, to the right of a jump that rounding would put behind them."""
    return np.asarray(times + 4 * np.spacing(np.abs(times)), dtype=np.float64)


def _function(experiment: Experiment, name: str) -> Callable[[Array], Array]:
    if name in experiment.rates:
        return experiment.inputs[experiment.rates[name]].derivative
    return experiment.inputs[name].value
