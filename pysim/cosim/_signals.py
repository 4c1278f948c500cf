"""The experiment's signals at communication points, between them, and over a step."""

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
        followed = [_followed(experiment, name) for name in layout.signals]
        self._functions, self._jumps = [one for one, _ in followed], [jumps for _, jumps in followed]
        self._tick = self._end_tick = 0
        self._table: memoryview[float] = view_of(np.zeros(0))
        self._end_rows: list[list[float]] = []

    def at(self, tick: int) -> memoryview[float]:
        """Values at start + tick * step."""
        count = len(self._functions)
        place = (tick - self._tick) * count
        if not 0 <= place < len(self._table):
            self._tick, place = tick, 0
            self._table = view_of(self._values(self._after(self._times(tick))).ravel())
        return self._table[place : place + count]

    def between(self, time: float) -> memoryview[float]:
        """Values at any time, s."""
        return view_of(self._values(self._after(np.array([time])))[0])

    def toward(self, time: float, end: float, tick: int | None) -> list[float]:
        """Where lines that leave the values at `time` arrive at `end` (s), to the left of a jump there.

        A signal that jumps on the way keeps its value: a step stays a step, and comes with the next point.

        Args:
            tick: number of the communication point at `end`, if it is one.
        """
        if tick is None or time != self._start + (tick - 1) * self._step:
            return self._ends(np.array([time]), np.array([end]))[0]
        line = tick - self._end_tick
        if not 0 <= line < len(self._end_rows):
            self._end_tick, line = tick, 0
            self._end_rows = self._ends(self._times(tick - 1), self._times(tick))
        return self._end_rows[line]

    def _times(self, tick: int) -> Array:
        return np.asarray(self._start + np.arange(tick, tick + _PART) * self._step)

    def _after(self, times: Array) -> Array:
        return after(times, self._start)

    def _values(self, times: Array) -> Array:
        return np.column_stack([of(times) for of in self._functions])

    def _ends(self, times: Array, ends: Array) -> list[list[float]]:
        first, last = self._after(times), before(ends, self._start)
        latest = np.column_stack([jumps[np.searchsorted(jumps, last, side="right") - 1] for jumps in self._jumps])
        found, jumped = self._values(last), latest > first[:, None]
        rows = jumped.any(axis=1)
        found[rows] = np.where(jumped[rows], self._values(first[rows]), found[rows])
        kept: list[list[float]] = found.tolist()
        return kept


def after(times: NDArray[np.floating], start: float = 0.0) -> Array:
    """The same times, to the right of a jump that rounding would put behind them; counted from `start`, s."""
    return np.asarray(times + 4 * np.spacing(np.maximum(np.abs(times), abs(start))), dtype=np.float64)


def before(times: NDArray[np.floating], start: float = 0.0) -> Array:
    """The same times, to the left of a jump that rounding would put ahead of them; counted from `start`, s."""
    return -after(-times, start)


def _followed(experiment: Experiment, name: str) -> tuple[Callable[[Array], Array], Array]:
    """A signal, or the rate of one, and the times at which it jumps (s), behind one long ago."""
    is_rate = name in experiment.rates
    signal = experiment.inputs[experiment.rates.get(name, name)]
    jumps = signal.starts[signal.breaks()[is_rate]]  # a rate jumps where its signal has a kink
    return signal.derivative if is_rate else signal.value, np.append(-np.inf, jumps)
