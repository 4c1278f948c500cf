"""Inputs that run as straight lines within a step: those that signals drive, and all for methods of second order."""

from __future__ import annotations

import numpy as np

from pysim.cosim._core import Core
from pysim.cosim._exchange import update
from pysim.cosim._layout import Wire, indices
from pysim.cosim.member import Array, Member

# An extrapolation reaches so many times as far as the stretch it is made from: beyond that it is the stretch's
# rounding, and a jump within it, that is carried on. Step doubling asks for four times at most.
_FARTHEST = 10.0


class Driven:
    """Inputs of members that signals drive. A signal is known ahead, so these run as lines whatever the order.

    A member that takes rates gets the line itself, any other the line's mean over the step.
    """

    def __init__(self, core: Core) -> None:
        self._toward, self._view = core.signals.toward, core.row.view
        first, shift = len(core.layout.outputs), len(core.layout.inputs)
        self._plan = [
            (wire.source, wire.source - first, wire.target, wire.target + shift if member.takes_rates else None)
            for member in core.layout.members
            for wire in core.layout.wires_to(member.name)
            if wire.source >= first
        ]
        self.some = bool(self._plan)

    def hold(self, time: float, end: float, tick: int | None) -> None:
        """Make inputs and rates for the step from `time` to `end` (s); see Lines.begin."""
        view, ends, size = self._view, self._toward(time, end, tick), end - time
        for source, place, target, rate in self._plan:
            if rate is None:
                view[target] = 0.5 * (view[source] + ends[place])
            else:
                view[rate] = (ends[place] - view[source]) / size


class Lines:
    """What drives the inputs at the begin and at the end of a step, and the inputs made from it.

    A member that takes rates gets the line itself; any other gets the line's mean over the step, which is as good to
    second order. Outputs of blocks and signals are known at the end too; outputs of members are extrapolated from the
    step before, unless that was far shorter, or somebody knows better and writes it to `ends`.

    Attributes:
        begins, ends: (n_sources).
        memory: time (s) and sources of the communication point before, for the extrapolation; None after an event.
    """

    def __init__(self, core: Core) -> None:
        self._core = core
        self.begins, self.ends = np.zeros(core.sources.size), np.zeros(core.sources.size)
        self.memory: tuple[float, Array] | None = None
        wires = [wire for member in core.layout.members for wire in core.layout.wires_to(member.name)]
        self._all = _Holder(core, wires)
        self._one = {m.name: _Holder(core, core.layout.wires_to(m.name)) for m in core.layout.members}
        self._at_once = {m.name for m in core.layout.members if any(m.feedthrough.values()) and not m.takes_rates}
        self._signals = slice(len(core.layout.outputs), core.sources.size)
        self._moving = [
            (core.layout.places[b.name].outputs, core.samplers[b.name]) for b in core.layout.blocks if b.hold
        ]

    def begin(self, time: float, end: float, tick: int | None) -> None:
        """Take the sources as they are at `time`, and what is known or expected of them at `end` (s).

        Args:
            tick: number of the communication point at `end`, if it is one.
        """
        core, outputs = self._core, self._core.outputs.size
        self.begins[:] = core.sources
        self.ends[:] = core.sources
        if self.memory is not None:
            before, values = self.memory
            if end - time <= _FARTHEST * (time - before):
                share = (end - time) / (time - before)
                self.ends[:outputs] += share * (self.begins[:outputs] - values[:outputs])
        if core.layout.signals:
            self.ends[self._signals] = core.signals.toward(time, end, tick)
        for slots, sampler in self._moving:
            self.ends[slots] = sampler.ahead(end)

    def hold(self, time: float, end: float, name: str | None = None) -> None:
        """Make inputs and rates from begins and ends: those of one member, or of all."""
        holder = self._all if name is None else self._one[name]
        holder.hold(self.begins, self.ends, end - time)

    def know(self, member: Member) -> None:
        """A member has stepped: take its outputs at the end.

        Those that follow an input at once were made with the input's mean over the step; they are brought to its end.
        """
        row, place = self._core.row.array, self._core.layout.places[member.name]
        if member.name in self._at_once and not member.event:
            held = row[place.inputs].copy()
            self._one[member.name].finish(self.ends)
            update(member)
            row[place.inputs] = held
        self.ends[place.outputs] = row[place.outputs]

    def done(self, time: float) -> None:
        """The step from `time` (s) was made: remember where it began."""
        self.memory = (time, self.begins.copy())


class _Holder:
    """Inputs that wires lead to."""

    def __init__(self, core: Core, wires: list[Wire] | tuple[Wire, ...]) -> None:
        self._row = core.row.array
        rating = {
            slot
            for member in core.layout.members
            if member.takes_rates
            for slot in range(*core.layout.places[member.name].inputs.indices(core.layout.size))
        }
        self._lines = indices(w for w in wires if w.target in rating)
        self._means = indices(w for w in wires if w.target not in rating)
        self._shift = len(core.layout.inputs)

    def finish(self, ends: Array) -> None:
        """Set the inputs to their last values."""
        targets, sources, factors, offsets = self._means
        self._row[targets] = factors * ends[sources] + offsets

    def hold(self, begins: Array, ends: Array, size: float) -> None:
        targets, sources, factors, offsets = self._means
        if targets.size:
            self._row[targets] = factors * (0.5 * (begins[sources] + ends[sources])) + offsets
        targets, sources, factors, offsets = self._lines
        if targets.size:
            self._row[targets] = factors * begins[sources] + offsets
            self._row[targets + self._shift] = factors * ((ends[sources] - begins[sources]) / size)
