"""From one communication point to the next: in one step, or in as many as an event or the error asks for."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np

from pysim.cosim._core import Core
from pysim.cosim._fault import Fault
from pysim.cosim._sweep import check_stall
from pysim.cosim.doubling import Doubling
from pysim.cosim.iterated import check_rollback
from pysim.cosim.order import Order, Stepper
from pysim.types import Outcome


class Mover(Protocol):
    """Steps from one communication point to the next; the row is consistent ahead, and not yet after."""

    memory: Any

    def move(self, number: int) -> None:
        """From point `number` to the one after it."""
        ...


class Plain:
    """One step, or several where events end one early."""

    def __init__(self, core: Core, stepper: Stepper, start: float, step: float) -> None:
        self._core, self._stepper, self._start, self._step = core, stepper, start, step
        self._advance = stepper.advance
        self._members = core.layout.members
        self._simple = core.balance is None and not any(member.may_return_early for member in self._members)

    @property
    def memory(self) -> Any:
        """The stepper's."""
        return self._stepper.memory

    @memory.setter
    def memory(self, memory: Any) -> None:
        self._stepper.memory = memory

    def move(self, number: int) -> None:
        """See Mover."""
        end = self._start + (number + 1) * self._step
        if self._simple:
            self._advance(self._start + number * self._step, end, number + 1)
            self._look_for_events()
        else:
            self.stretch(self._start + number * self._step, end, number + 1)

    def stretch(self, time: float, end: float, tick: int | None) -> None:
        """From `time` to `end` (s).

        Raises:
            Fault: a member could not go on, or events follow each other without time passing.
        """
        balance, stalled = self._core.balance, 0
        while True:
            if balance is not None:
                balance.begin()
            reached = self._advance(time, end, tick)
            if balance is not None:
                if self._stepper.lines:  # outputs that follow inputs at once: those of the inputs at the end
                    self._core.exchange.between(reached, tick if reached == end else None, events=False)
                balance.accept()
            if reached == end:
                self._look_for_events()
                return
            stalled = stalled + 1 if reached == time else 0
            check_stall("the system", stalled)
            self._note_event()
            self._core.exchange.between(reached)
            time = reached

    def _look_for_events(self) -> None:
        for member in self._members:
            if member.event:
                self._note_event()
                return

    def _note_event(self) -> None:
        """Nothing is extrapolated over an event."""
        self._core.counts["events"] += 1
        self._stepper.memory = None


class _Place(NamedTuple):
    """Everything a step may change."""

    members: list[Any]
    row: np.ndarray
    memory: Any


class Doubled:
    """Each step is made once whole and once in halves; their difference rules the size. Sizes are step / 2^k, so that
    time stays start + n * step / 2^k."""

    def __init__(self, core: Core, order: Order, start: float, step: float, doubling: Doubling) -> None:
        check_rollback("step doubling", core)
        doubling.check(core.layout.members)
        self._core, self._doubling, self._plain = core, doubling, Plain(core, order.stepper(core), start, step)
        self._start, self._parts = start, 2 ** (doubling.halvings + 1)
        self._part = step / self._parts
        self._gain = 2**order.accuracy - 1
        self._level = 0
        self._kept: list[Any] | None = None

    @property
    def memory(self) -> Any:
        """The size of the steps, and the stepper's."""
        return self._level, self._plain.memory

    @memory.setter
    def memory(self, memory: Any) -> None:
        self._level, self._plain.memory = memory

    def move(self, number: int) -> None:
        """See Mover."""
        first, place = number * self._parts, 0
        while place < self._parts:
            size = self._parts >> self._level
            error = self._try(first + place, size)
            if error > 1:
                self._smaller()
                continue
            place += size
            self._core.counts["parts"] += 2
            # A step twice as large has 2^(p+1) times the error; half of that is kept as a margin.
            may_grow = self._level > 0 and place % (2 * size) == 0
            if may_grow and error < 0.25 / (self._gain + 1):
                self._level -= 1

    def _time(self, place: int) -> float:
        return self._start + place * self._part

    def _smaller(self) -> None:
        self._core.counts["rejected"] += 1
        if self._level == self._doubling.halvings:
            why = f"its error stays above rtol = {self._doubling.rtol:g} with steps of {2 * self._part:g} s"
            raise Fault("step doubling", why, Outcome.STEP_TOO_SMALL)
        self._level += 1

    def _try(self, first: int, size: int) -> float:
        """Step from `first` by `size` parts; the error over the tolerance. Above 1 all is put back."""
        core, times = self._core, [self._time(first + n) for n in (0, size // 2, size)]
        self._kept = core.save(self._kept)
        place = _Place(self._kept, core.row.array.copy(), self._plain.memory)
        tick = (first + size) // self._parts if (first + size) % self._parts == 0 else None
        self._plain.stretch(times[0], times[2], tick)
        core.exchange.between(times[2], tick)
        whole = core.outputs.copy()
        core.enlarge_scale()
        self._put_back(place)
        self._plain.stretch(times[0], times[1], None)
        core.exchange.between(times[1])
        self._plain.stretch(times[1], times[2], tick)
        core.exchange.between(times[2], tick)
        error = self._error(whole)
        if error > 1:
            self._put_back(place)
        return error

    def _error(self, whole: np.ndarray) -> float:
        """Largest difference over its tolerance. What was tried counts for the magnitudes: an output at rest till now
        has no other, and any step's share of it would be large."""
        self._core.enlarge_scale()
        halves, scale = self._core.outputs, np.where(self._core.scale > 0, self._core.scale, 1.0)
        worst = float(np.max(np.abs(whole - halves) / scale, initial=0.0))
        return worst / self._gain / self._doubling.rtol

    def _put_back(self, place: _Place) -> None:
        self._core.restore(place.members)
        self._core.row.array[:] = place.row
        self._plain.memory = place.memory
