"""What a run records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from pysim.cosim._layout import Layout, view_of
from pysim.cosim.member import Array
from pysim.cosim.system import System
from pysim.types import Experiment, Outcome, Record

# All slots from the first to the last in one piece take less time than each by itself, and up to so many times the
# memory.
_WIDE = 4


class Trace:
    """A row per time of the experiment, taken from the run's row of numbers.

    Args:
        ticks: the communication point of each time.
    """

    def __init__(
        self, system: System, experiment: Experiment, ticks: Sequence[int], layout: Layout, row: Array
    ) -> None:
        self._experiment, self._row = experiment, row
        bonds = [f"{name}.{column}" for name in layout.bonds for column in ("power", "residual")]
        slots = [layout.outputs.get(name, layout.inputs.get(name, -1)) for name in experiment.record]
        slots += [slot + i for slot in layout.bonds.values() for i in (0, 1)]
        self._slots = np.array(slots, dtype=np.intp)
        self._names = (*experiment.record, *bonds)
        ports = [system.outputs.get(name) or system.inputs[name] for name in experiment.record]
        self._units = (*(port.unit for port in ports), *("W", "J") * len(layout.bonds))
        self._origin = f"simulated, {', '.join(member.name for member in system.members)}"
        first, last = min(slots), max(slots) + 1
        self._piece = view_of(row)[first:last] if last - first <= _WIDE * len(slots) else None
        self._columns = np.arange(len(slots)) if self._piece is None else self._slots - first
        self._width = len(slots) if self._piece is None else last - first
        self._values = np.empty((experiment.times.size, self._width))
        self._memory = view_of(self._values.reshape(-1))
        self._ticks = [*ticks, -1]
        self._count = 0

    def due(self) -> int:
        """The communication point of the next row; -1 if there is none."""
        return self._ticks[self._count]

    def take(self, tick: int) -> int:
        """Take a row if it is due; the point of the next."""
        count = self._count
        if self._ticks[count] == tick:
            if self._piece is None:
                self._row.take(self._slots, out=self._values[count], mode="clip")
            else:
                place = count * self._width
                self._memory[place : place + self._width] = self._piece
            self._count = count = count + 1
        return self._ticks[count]

    def rewind(self, tick: int) -> None:
        """Forget rows after a point."""
        self._count = sum(1 for t in self._ticks[:-1] if t <= tick)

    def record(self, outcome: Outcome, message: str, statistics: Mapping[str, int]) -> Record:
        """All rows so far."""
        count = self._count
        return Record(
            time=self._experiment.times[:count],
            values=self._values[:count, self._columns],
            names=self._names,
            units=self._units,
            outcome=outcome,
            message=message,
            origin=self._origin,
            statistics=statistics,
        )
