"""What power bonds transfer, and the energy that only the coupling makes."""

from __future__ import annotations

import numpy as np

from pysim.cosim._layout import Layout, Row
from pysim.cosim.system import System


class Balance:
    """Energy given and taken over each bond, from outputs by the trapezoidal rule and inputs as they were held.

    The side that gives the effort e gets the flow as its input f: it gives the mean of e, times f. The other takes its
    held effort times the mean of its flow; both with the factors of the wires undone, in the first side's sign.
    """

    def __init__(self, system: System, layout: Layout, row: Row) -> None:
        def row_of(slots: list[int]) -> np.ndarray:
            return np.array(slots, dtype=np.intp)

        effort = [system.drivers[bond.effort] for bond in system.bonds]
        flow = [system.drivers[bond.flow] for bond in system.bonds]
        self._out = row_of([layout.outputs[c.source] for c in (*effort, *flow)])
        self._in = row_of([layout.inputs[c.target] for c in (*flow, *effort)])
        self._factor = np.array([1.0] * len(flow) + [f.gain / e.gain for e, f in zip(effort, flow, strict=True)])
        self._columns = slice(layout.size - 2 * len(effort), layout.size)
        self._row, self._rates = row.array, len(layout.inputs)
        self._before = np.zeros(self._out.size)
        self._held = np.zeros(self._in.size)
        self._size = 0.0

    def begin(self) -> None:
        """A step begins: keep the outputs."""
        self._before = self._row[self._out]

    def hold(self, size: float) -> None:
        """A step of `size` s was made, perhaps not for the last time: keep the inputs' means."""
        self._held = self._row[self._in] + 0.5 * size * self._row[self._in + self._rates]
        self._size = size

    def accept(self) -> None:
        """The step made last counts, with the outputs as they are now."""
        energy = self._size * self._factor * 0.5 * (self._before + self._row[self._out]) * self._held
        given, taken = energy.reshape(2, -1)
        columns = self._row[self._columns].reshape(-1, 2)
        columns[:, 0] = given / self._size
        columns[:, 1] += given - taken
