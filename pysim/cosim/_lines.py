"""Inputs that run as straight lines within a step: those that signals drive, and all for methods of second order."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pysim.cosim._core import Core
from pysim.cosim._exchange import update
from pysim.cosim._layout import view_of
from pysim.cosim.member import Array, Member

# An extrapolation reaches so many times as far as the stretch it is made from: beyond that it is the stretch's
# rounding, and a jump within it, that is carried on. Step doubling asks for four times at most.
_FARTHEST = 10.0


class Inputs:
    """Inputs of members, made from what drives them: one by one, since NumPy's calls cost more than a few numbers.

    A member that takes rates gets the line itself; any other gets the line's mean over the step, which is as good to
    second order.

    Args:
        first: slot in the row from which on a driver counts.
    """

    def __init__(self, core: Core, members: Sequence[Member], first: int = 0) -> None:
        self._view, shift = core.row.view, len(core.layout.inputs)
        self._plan = [
            (*wire, wire.target + shift if member.takes_rates else None)
            for member in members
            for wire in core.layout.wires_to(member.name)
            if wire.source >= first
        ]
        self.some = bool(self._plan)

    def finish(self, ends: Sequence[float]) -> None:
        """Set the inputs to their last values."""
        for target, source, factor, offset, rate in self._plan:
            if rate is None:
                self._view[target] = factor * ends[source] + offset

    def hold(self, begins: Sequence[float], ends: Sequence[float], size: float) -> None:
        """Make inputs and rates for a step of `size` (s)."""
        view = self._view
        for target, source, factor, offset, rate in self._plan:
            if rate is None:
                view[target] = factor * (0.5 * (begins[source] + ends[source])) + offset
            else:
                view[target] = factor * begins[source] + offset
                view[rate] = factor * ((ends[source] - begins[source]) / size)


class Lines:
    """What drives the inputs at the begin and at the end of a step, and the inputs made from it.

    Outputs of blocks and signals are known at the end too; outputs of members are extrapolated from the step before,
    unless that was far shorter, or somebody knows better and writes it to `ends`.

    Attributes:
        begins, ends: (n_sources).
        memory: time (s) and sources of the communication point before, for the extrapolation; None after an event.
    """

    def __init__(self, core: Core) -> None:
        self._core = core
        self.begins, self.ends = np.zeros(core.sources.size), np.zeros(core.sources.size)
        self.memory: tuple[float, Array] | None = None
        self._views = view_of(self.begins), view_of(self.ends)
        self._all = Inputs(core, core.layout.members)
        self._one = {member.name: Inputs(core, [member]) for member in core.layout.members}
        self._at_once = {m.name for m in core.layout.members if any(m.feedthrough.values()) and not m.takes_rates}
        self._signals = slice(len(core.layout.outputs), core.sources.size)
        self._moving = [
            (core.layout.places[b.name].outputs, core.samplers[b.name]) for b in core.layout.blocks if b.hold
        ]

    def begin(self) -> None:
        """A step begins: take the sources as they are."""
        self.begins[:] = self._core.sources

    def aim(self, time: float, end: float, tick: int | None) -> None:
        """Find what is known or expected of the sources at `end` (s), and make all inputs of a step to there.

        Args:
            tick: number of the communication point at `end`, if it is one.
        """
        core, outputs = self._core, self._core.outputs.size
        self.ends[:] = self.begins
        if self.memory is not None:
            before, values = self.memory
            if end - time <= _FARTHEST * (time - before):
                share = (end - time) / (time - before)
                self.ends[:outputs] += share * (self.begins[:outputs] - values[:outputs])
        if core.layout.signals:
            self.ends[self._signals] = core.signals.toward(time, end, tick)
        for slots, sampler in self._moving:
            self.ends[slots] = sampler.ahead(end)
        self.hold(time, end)

    def hold(self, time: float, end: float, name: str | None = None) -> None:
        """Make inputs and rates from begins and ends: those of one member, or of all."""
        inputs = self._all if name is None else self._one[name]
        inputs.hold(*self._views, end - time)

    def know(self, member: Member) -> None:
        """A member has stepped: take its outputs at the end.

        Those that follow an input at once were made with the input's mean over the step; they are brought to its end.
        """
        row, place = self._core.row.array, self._core.layout.places[member.name]
        if member.name in self._at_once and not member.event:
            held = row[place.inputs].copy()
            self._one[member.name].finish(self._views[1])
            update(member)
            row[place.inputs] = held
        self.ends[place.outputs] = row[place.outputs]

    def done(self, time: float) -> None:
        """The step from `time` (s) was made: remember where it began."""
        self.memory = (time, self.begins.copy())
