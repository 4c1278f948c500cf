"""A system at work: started, moved on, kept, put back, recorded."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from threading import Lock
from types import TracebackType
from typing import Any, TypeVar

from pysim.control import Block
from pysim.cosim._core import Core
from pysim.cosim._fault import Fault
from pysim.cosim._layout import Layout, Row, lay_out
from pysim.cosim._mover import Doubled, Mover, Plain
from pysim.cosim._prepare import check_experiment, tick_of, ticks
from pysim.cosim._sampler import Sampler
from pysim.cosim._signals import Signals
from pysim.cosim._start import start
from pysim.cosim._trace import Trace
from pysim.cosim.doubling import Doubling
from pysim.cosim.iterated import check_rollback
from pysim.cosim.jacobi import Jacobi
from pysim.cosim.member import Member
from pysim.cosim.order import Order
from pysim.cosim.system import System
from pysim.types import BadInput, Experiment, Outcome, Record, SimulationError

Result = TypeVar("Result")

# Members of runs that are open; each can be in one at a time.
_at_work: set[int] = set()
_claiming = Lock()


@dataclass(frozen=True)
class Kept:
    """A run at one communication point; good for its own run only, as long as that is open."""

    tick: int
    run: object = field(repr=False)
    parts: tuple[Any, ...] = field(repr=False)


class Run:
    """One run of a system, for a `with` block: `advance` as far as you like, `save` and `restore` on the way.

    Args:
        system, experiment, step, order, doubling: as of `cosimulate`.
    Raises:
        BadInput: as of `cosimulate`, on entering too.
    """

    def __init__(
        self,
        system: System,
        experiment: Experiment,
        *,
        step: float,
        order: Order | None = None,
        doubling: Doubling | None = None,
    ) -> None:
        if not (isinstance(step, (int, float)) and 0 < step < math.inf):
            raise BadInput(f"co-simulation: the step is {step!r}; give a positive number of seconds")
        if order is not None and (isinstance(order, type) or not hasattr(order, "stepper")):
            raise BadInput(f"co-simulation: order is {order!r}; give one with its settings, as GaussSeidel()")
        if doubling is not None and not isinstance(doubling, Doubling):
            raise BadInput(f"co-simulation: doubling is {doubling!r}; give Doubling(rtol=...)")
        self.system, self.experiment, self.step = system, experiment, float(step)
        self._order: Order = Jacobi() if order is None else order
        self._doubling = doubling
        check_experiment(system, experiment, solves_loops=self._order.solves_loops)
        self._rows = ticks(experiment, self.step)
        self._layout = lay_out(system, (*experiment.inputs, *experiment.rates))
        self._tick = self._counted = 0
        self._failed: Fault | None = None
        self._open = False

    def __enter__(self) -> Run:
        _claim(self._layout.members)
        try:
            self._build()
            self._or_stop(partial(start, self._core, self.experiment, self.step))
            self._trace.take(0)
        except BaseException:
            self._close()
            raise
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._close()

    @property
    def blocks(self) -> Mapping[str, Block]:
        """The copies of its sampled blocks that this run steps, by name, as they are now."""
        return {name: sampler.block for name, sampler in self._samplers.items()}

    @property
    def time(self) -> float:
        """s, of the communication point that was reached."""
        return self.experiment.start + self._tick * self.step

    def advance(self, to: float | None = None, progress: Callable[[float], None] | None = None) -> None:
        """Move on to a communication point, s; None goes to the experiment's end.

        Args:
            progress: called now and then with the time, s.
        Raises:
            BadInput: a time between two communication points, before the one reached, or after the end.
            SimulationError: a member could not go on; `.record` holds the part that was reached.
        """
        if not self._open or self._failed is not None:
            raise BadInput("co-simulation: this run is closed or has failed; begin another")
        last = self._rows[-1] if to is None else tick_of(to, self.experiment.start, self.step)
        if not self._tick <= last <= self._rows[-1]:
            raise BadInput(f"co-simulation: cannot go to {to} s from {self.time:.12g} s; stay within the experiment")
        while self._tick < last:
            stop = last if progress is None else min(last, self._tick + 1000)
            self._or_stop(partial(self._loop, stop))
            if progress is not None:
                progress(self.time)

    def _or_stop(self, call: Callable[[], Result]) -> Result:
        """What a call returns.

        Raises:
            SimulationError: a member could not go on; the run is over.
        """
        try:
            return call()
        except Fault as error:
            self._failed = error
            record = self.record()
            raise SimulationError(record.message, record) from error.__cause__

    def _loop(self, last: int) -> None:
        """The hot loop: everything it calls was looked up before."""
        move, at, trace = self._mover.move, self._core.exchange.at, self._trace
        start, step, tick = self.experiment.start, self.step, self._tick
        due = trace.due()
        try:
            while tick < last:
                move(tick)
                tick += 1
                self._tick = tick
                at(tick, start + tick * step)
                if tick == due:
                    due = trace.take(tick)
        finally:
            self._core.counts["steps"] += self._tick - self._counted
            self._counted = self._tick

    def record(self) -> Record:
        """What was recorded so far."""
        if self._failed is None:
            return self._trace.record(Outcome.DONE, "", self._counts())
        message = f"t = {self.time:.9g} s: {self._failed}"
        return self._trace.record(self._failed.outcome, message, self._counts())

    def save(self) -> Kept:
        """The whole run, to come back to.

        Raises:
            BadInput: a member that cannot save its state.
            SimulationError: one that can, and failed to.
        """
        check_rollback("save", self._core)
        core = self._core
        blocks = {name: sampler.save() for name, sampler in self._samplers.items()}
        members = self._or_stop(core.save)
        parts = (members, blocks, core.row.array.copy(), core.scale.copy(), self._mover.memory, dict(core.counts))
        return Kept(self._tick, self._core, parts)

    def restore(self, kept: Kept) -> None:
        """Go back; what was recorded after that point is forgotten, and what follows repeats bit for bit.

        Raises:
            BadInput: kept in another run.
            SimulationError: a member could not be put back.
        """
        if kept.run is not self._core:
            raise BadInput("restore: this was kept in another run; states live as long as the run they come from")
        core = self._core
        members, blocks, row, scale, memory, counts = kept.parts
        self._or_stop(partial(core.restore, members))
        for name, state in blocks.items():
            self._samplers[name].restore(state)
        core.row.array[:], core.scale[:] = row, scale
        self._mover.memory = memory
        core.counts.clear()
        core.counts.update(counts)
        self._tick = self._counted = kept.tick
        self._failed = None
        self._trace.rewind(kept.tick)

    def _build(self) -> None:
        row = Row(self._layout)
        signals = Signals(self.experiment, self._layout, self.step)
        self._trace = Trace(self.system, self.experiment, self._rows, self._layout, row.array)
        self._samplers = self._make_samplers(self._layout, row)
        self._core = Core(self.system, self._layout, row, self._samplers, signals)
        self._mover = self._make_mover()
        self._tick, self._counted, self._open, self._failed = 0, 0, True, None

    def _make_samplers(self, layout: Layout, row: Row) -> dict[str, Sampler]:
        samplers, recorded = {}, frozenset(self.experiment.record)
        for block in layout.blocks:
            every = tick_of(block.every, 0.0, self.step, f"{block.name}: every =", least=1)
            delay = tick_of(block.delay, 0.0, self.step, f"{block.name}: delay =", least=int(block.delay > 0))
            looked_at = bool(self.system.bonds) or any(f"{block.name}.{p.name}" in recorded for p in block.inputs)
            samplers[block.name] = Sampler(block, row, layout, every, delay, self.step, keeps_inputs=looked_at)
        return samplers

    def _make_mover(self) -> Mover:
        start = self.experiment.start
        if self._doubling is not None:
            return Doubled(self._core, self._order, start, self.step, self._doubling)
        return Plain(self._core, self._order.stepper(self._core), start, self.step)

    def _counts(self) -> dict[str, int]:
        return dict(self._core.counts)

    def _close(self) -> None:
        self._open = False
        with ExitStack() as stack:  # every one is closed, whatever the others do
            stack.callback(_release, self._layout.members)
            for member in self._layout.members:
                stack.callback(member.close)


def _claim(members: Sequence[Member]) -> None:
    with _claiming:
        for member in members:
            if id(member) in _at_work:
                raise BadInput(
                    f"co-simulation: {member.name} is at work in another run; close that first, or make another member"
                )
        _at_work.update(map(id, members))


def _release(members: Sequence[Member]) -> None:
    with _claiming:
        _at_work.difference_update(map(id, members))
