"""A sampled block at work: reads its inputs at its samples, sets its outputs after its delay, holds them."""

from __future__ import annotations

from collections import deque
from math import isfinite
from typing import NamedTuple

from pysim.cosim._fault import Fault, fault
from pysim.cosim._layout import Layout, Row
from pysim.cosim.sampled import Sampled
from pysim.types import Outcome


class SamplerState(NamedTuple):
    """What a block and its hold remember."""

    block: tuple[float, ...]
    values: tuple[float, ...]
    before: tuple[float, ...]
    time: float
    fresh: bool
    waiting: tuple[tuple[int, tuple[float, ...]], ...]


class Sampler:
    """One block of a run. Its samples lie at ticks that `every` divides.

    Args:
        every, delay: in communication steps.
        step: s, of a communication step.
    """

    def __init__(self, sampled: Sampled, row: Row, layout: Layout, every: int, delay: int, step: float) -> None:
        place = layout.places[sampled.name]
        self.name, self.hold, self._block, self._initial = sampled.name, sampled.hold, sampled.block, sampled.initial
        self._step, self._every, self._delay, self._period = sampled.block.step, every, delay, every * step
        self._view, self._inputs = row.view, row.view[place.inputs]
        self._wires = layout.wires_to(sampled.name)
        self._slots = tuple(range(place.outputs.start, place.outputs.stop))
        self._ports = sampled.outputs
        self.reset()

    def reset(self) -> None:
        """Be as ahead of the first sample."""
        self._block.restore(self._initial)
        values = tuple(port.start or 0.0 for port in self._ports)
        self._values = self._before = values
        self._time = 0.0
        self._waiting: deque[tuple[int, tuple[float, ...]]] = deque()
        self._fresh = True
        self._write(values)

    def sample(self, tick: int, time: float) -> None:
        """Step the block if its time has come.

        Raises:
            Fault: it raised, or returned what are no finite numbers.
        """
        if tick % self._every:
            return
        view = self._view
        for target, source, factor in self._wires:
            view[target] = factor * view[source]
        try:
            values = tuple(self._step(time, self._inputs.tolist()))
            good = len(values) == len(self._slots) and all(map(isfinite, values))
        except Exception as error:
            raise fault(self.name, error) from error
        if not good:
            raise self._refused(values)
        if self._delay:
            self._waiting.append((tick + self._delay, values))
        else:
            self._set(time, values)

    def deliver(self, tick: int, time: float) -> None:
        """Set what was waiting for this tick, and go on along the line of a first-order hold."""
        while self._waiting and self._waiting[0][0] <= tick:
            self._set(time, self._waiting.popleft()[1])
        if self.hold:
            self._write(self.ahead(time))

    def ahead(self, time: float) -> tuple[float, ...]:
        """The outputs at a time ahead of the next sample."""
        if not self.hold:
            return self._values
        share = (time - self._time) / self._period
        return tuple(now + share * (now - old) for now, old in zip(self._values, self._before, strict=True))

    def _set(self, time: float, values: tuple[float, ...]) -> None:
        self._before = values if self._fresh else self._values
        self._values, self._time, self._fresh = values, time, False
        self._write(values)

    def _write(self, values: tuple[float, ...]) -> None:
        view = self._view
        for slot, value in zip(self._slots, values, strict=True):
            view[slot] = value

    def _refused(self, values: tuple[float, ...]) -> Fault:
        names = [port.name for port in self._ports]
        if len(values) != len(names):
            return Fault(
                self.name, f"its step returned {len(values)} values for {len(names)} outputs", Outcome.MODEL_ERROR
            )
        bad = next(f"{n} = {v}" for n, v in zip(names, values, strict=True) if not isfinite(v))
        return Fault(self.name, f"its step returned {bad}", Outcome.NOT_FINITE)

    def save(self) -> SamplerState:
        """All that the next samples depend on."""
        return SamplerState(
            tuple(self._block.state()), self._values, self._before, self._time, self._fresh, tuple(self._waiting)
        )

    def restore(self, state: SamplerState) -> None:
        """Go on from a state that was saved. Outputs are not written."""
        self._block.restore(state.block)
        self._values, self._before, self._time, self._fresh = state.values, state.before, state.time, state.fresh
        self._waiting = deque(state.waiting)
