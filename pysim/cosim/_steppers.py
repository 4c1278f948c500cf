"""Steps in one sweep over the members: with inputs held, or running along lines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pysim.cosim._core import Core
from pysim.cosim._lines import Inputs, Lines
from pysim.cosim._sweep import Prepare, Sweep


class Held:
    """Inputs from other parts are what the communication point left in the row; signals, known ahead, run as lines."""

    memory: Any = None
    lines = False

    def __init__(self, core: Core, order: Sequence[str], prepare: Sequence[Prepare | None]) -> None:
        first, begins, toward = len(core.layout.outputs), core.row.view, core.signals.toward
        driven, others = Inputs(core, core.layout.members, first), [0.0] * first

        def along(time: float, end: float, tick: int | None) -> None:
            driven.hold(begins, others + toward(time, end, tick), end - time)

        self.advance = Sweep(core, order, prepare, along if driven.some else None).__call__


class Remembering:
    """What every order with lines has to keep from step to step."""

    lines = True

    def __init__(self, lines: Lines) -> None:
        self._lines = lines

    @property
    def memory(self) -> Any:
        """The point before."""
        return self._lines.memory

    @memory.setter
    def memory(self, memory: Any) -> None:
        self._lines.memory = memory


class Lined(Remembering):
    """Inputs run along lines."""

    def __init__(self, core: Core, lines: Lines, order: Sequence[str], prepare: Sequence[Prepare | None]) -> None:
        super().__init__(lines)
        self._sweep = Sweep(core, order, prepare, lines.aim)

    def advance(self, time: float, end: float, tick: int | None) -> float:
        """See Stepper."""
        self._lines.begin()
        reached = self._sweep(time, end, tick)
        self._lines.done(time)
        return reached
