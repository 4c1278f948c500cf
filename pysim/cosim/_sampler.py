"""A sampled block at work: reads its inputs at its samples, sets its outputs after its delay, holds them."""

from __future__ import annotations

import copy
import reprlib
from collections import deque
from collections.abc import Callable, Sequence
from functools import partial
from math import isfinite
from numbers import Real
from operator import itemgetter
from struct import Struct
from typing import Any, NamedTuple

import numpy as np

from pysim.control import Block
from pysim.cosim._fault import Fault, fault
from pysim.cosim._layout import Layout, Row, Wire
from pysim.cosim.sampled import Sampled
from pysim.io import counted
from pysim.types import BadInput, Outcome


class SamplerState(NamedTuple):
    """What a block and its hold remember."""

    block: Block
    values: tuple[float, ...]
    before: tuple[float, ...]
    time: float
    fresh: bool
    waiting: tuple[tuple[int, tuple[float, ...]], ...]


def _gatherer(slots: slice, wires: Sequence[Wire]) -> Callable[[memoryview[float]], tuple[float, ...]] | None:
    """A function that takes all inputs from where they come, without a stop in their slots; None where a factor or an
    offset is in the way, or where there are too few inputs for it."""
    sources = {wire.target: wire.source for wire in wires}
    if slots.stop - slots.start < 2 or any(wire.factor != 1 or wire.offset for wire in wires):
        return None
    return itemgetter(*(sources.get(slot, slot) for slot in range(slots.start, slots.stop)))


class Sampler:
    """One block of a run. Its samples lie at ticks that `every` divides.

    Args:
        every, delay: in communication steps.
        step: s, of a communication step.
        keeps_inputs: whether somebody looks at its inputs' slots.
    """

    def __init__(
        self, sampled: Sampled, row: Row, layout: Layout, every: int, delay: int, step: float, *, keeps_inputs: bool
    ) -> None:
        place = layout.places[sampled.name]
        self.name, self.hold = sampled.name, sampled.hold
        self._every, self._delay, self._period = every, delay, every * step
        self._view, self._ports = row.view, sampled.outputs
        self._wires = layout.wires_to(sampled.name)
        self._gather = None if keeps_inputs else _gatherer(place.inputs, self._wires)
        inputs, outputs = (Struct(f"{slots.stop - slots.start}d") for slots in (place.inputs, place.outputs))
        self._read = partial(inputs.unpack_from, row.view, 8 * place.inputs.start)
        self._write = partial(outputs.pack_into, row.view, 8 * place.outputs.start)
        self._pack = outputs.pack
        self._take_over(sampled.block)
        values = tuple(port.start or 0.0 for port in self._ports)
        self._values: Sequence[float] = values
        self._before = values
        self._time = 0.0
        self._waiting: deque[tuple[int, tuple[float, ...]]] = deque()
        self._fresh = True
        self._write(*values)

    def _take_over(self, block: Block) -> None:
        """Go on with a copy: whatever the block holds, what it was copied from stays as it is."""
        self.block = self._copied(block)
        self._step = self.block.step

    def _copied(self, block: Block) -> Block:
        """Raises: BadInput where it cannot be copied."""
        try:
            return copy.deepcopy(block)
        except Exception as error:  # whatever its parts raise
            raise BadInput(
                f"{self.name}: it cannot be copied, as each run and each saved state needs ({error}); open files and "
                "connections in step, and leave them out of its __getstate__"
            ) from error

    def sample(self, tick: int | None, time: float) -> None:
        """Step the block if its time has come; it never has between communication points, where tick is None.

        Raises:
            Fault: it raised, or returned what are no finite numbers.
        """
        if tick is None or tick % self._every:
            return
        view = self._view
        if self._gather is not None:
            inputs = self._gather(view)
        else:
            for target, source, factor, offset in self._wires:
                view[target] = factor * view[source] + offset
            inputs = self._read()
        values: Any = None
        try:
            values = self._step(time, inputs)
            total = sum(values)
            if not (total - total == 0 and len(values) == len(self._ports)):
                self._check(values)
            self._take(tick, time, values)
        except Fault:
            raise
        except Exception as error:
            raise self._wrong(values, error) from error

    def _take(self, tick: int, time: float, values: Sequence[float]) -> None:
        """Set them, or keep them till they are due; either way they are packed now, which takes numbers only."""
        if self._delay:
            self._pack(*values)
            self._waiting.append((tick + self._delay, tuple(values)))
        elif self.hold:
            self._set(time, tuple(values))
        else:
            self._values = values
            self._write(*values)

    def deliver(self, tick: int, time: float) -> None:
        """Set what was waiting for this tick, and go on along the line of a first-order hold."""
        while self._waiting and self._waiting[0][0] <= tick:
            self._set(time, self._waiting.popleft()[1])
        if self.hold:
            self._write(*self.ahead(time))

    def ahead(self, time: float) -> tuple[float, ...]:
        """The outputs at a time ahead of the next sample, on the line through the last two values."""
        share = (time - self._time) / self._period
        return tuple(now + share * (now - old) for now, old in zip(self._values, self._before, strict=True))

    def _set(self, time: float, values: tuple[float, ...]) -> None:
        self._before = values if self._fresh else tuple(self._values)
        self._values, self._time, self._fresh = values, time, False
        self._write(*values)

    def _wrong(self, values: object, error: Exception) -> Fault:
        """What to say where the step raised, or what it returned is no row of numbers."""
        if isinstance(values, Real):
            row = ", ".join(port.name for port in self._ports) + ("," if len(self._ports) == 1 else "")
            why = f"its step returned the number {values}; let it return ({row})"
            return Fault(self.name, why, Outcome.MODEL_ERROR)
        if isinstance(values, (tuple, list, np.ndarray)):
            for port, value in zip(self._ports, values, strict=False):
                if not _is_number(value):
                    why = f"its step returned {port.name} = {reprlib.repr(value)}; return a number, as float(...)"
                    return Fault(self.name, why, Outcome.MODEL_ERROR)
        return fault(self.name, error)

    def _check(self, values: Sequence[float]) -> None:
        """Check what has no finite sum, which may be too large only, or is not as long as it should be.

        Raises:
            Fault: what is wrong.
        """
        names = [port.name for port in self._ports]
        if len(values) != len(names):
            why = f"its step returned {counted(len(values), 'value')} for {counted(len(names), 'output')}"
            raise Fault(self.name, why, Outcome.MODEL_ERROR)
        for name, value in zip(names, values, strict=True):
            if not isfinite(value):
                raise Fault(self.name, f"its step returned {name} = {value}", Outcome.NOT_FINITE)

    def save(self) -> SamplerState:
        """All that the next samples depend on."""
        block = self._copied(self.block)
        return SamplerState(block, tuple(self._values), self._before, self._time, self._fresh, tuple(self._waiting))

    def restore(self, state: SamplerState) -> None:
        """Go on from a state that was saved. Outputs are not written."""
        self._take_over(state.block)
        self._values, self._before, self._time, self._fresh = state.values, state.before, state.time, state.fresh
        self._waiting = deque(state.waiting)


def _is_number(value: object) -> bool:
    """Whether it is one that fits into 64 bits."""
    try:
        return isinstance(value, (Real, np.bool_)) and isinstance(float(value), float)
    except OverflowError:
        return False
