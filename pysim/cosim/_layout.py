"""Where each value of a run lies: one row of numbers that all members share."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pysim.cosim.member import Array, Member
from pysim.cosim.sampled import Sampled
from pysim.cosim.system import Part, System


class Wire(NamedTuple):
    """One input and what drives it: input = factor * source + offset."""

    target: int
    source: int
    factor: float
    offset: float = 0.0


@dataclass(frozen=True)
class Place:
    """Slots of one part in the row."""

    outputs: slice
    inputs: slice
    rates: slice


@dataclass(frozen=True)
class Layout:
    """[outputs of members | outputs of blocks | signals | inputs | rates of inputs | power, residual of bonds].

    Args:
        members: those that move on by themselves, in the system's order.
        blocks: the sampled ones.
        places: by name of the part.
        outputs, signals, inputs: slot by name; signals are named by the input they drive.
        wires: every driven input.
        size: of the row.
    """

    members: tuple[Member, ...]
    blocks: tuple[Sampled, ...]
    places: Mapping[str, Place]
    outputs: Mapping[str, int]
    signals: Mapping[str, int]
    inputs: Mapping[str, int]
    bonds: Mapping[str, int]
    wires: tuple[Wire, ...]
    size: int

    @property
    def member_outputs(self) -> slice:
        """Slots of the outputs of all members, without blocks."""
        return slice(0, sum(len(m.outputs) for m in self.members))

    @property
    def sources(self) -> slice:
        """Slots of all that can drive an input."""
        return slice(0, len(self.outputs) + len(self.signals))

    def wires_to(self, name: str, among: Iterable[str] | None = None) -> tuple[Wire, ...]:
        """Wires to a part, or to some of its inputs."""
        place = self.places[name].inputs
        wanted = range(place.start, place.stop)
        if among is not None:
            wanted = frozenset(self.inputs[f"{name}.{port}"] for port in among)  # type: ignore[assignment]
        return tuple(wire for wire in self.wires if wire.target in wanted)

    def owner(self, slot: int) -> str | None:
        """The part whose output lies there; None for a signal."""
        for name, place in self.places.items():
            if place.outputs.start <= slot < place.outputs.stop:
                return name
        return None


def lay_out(system: System, signals: Iterable[str]) -> Layout:
    """Give every value its slot.

    Args:
        signals: inputs driven by the experiment.
    """
    members = tuple(m for m in system.members if not isinstance(m, Sampled))
    blocks = tuple(m for m in system.members if isinstance(m, Sampled))
    parts: tuple[Part, ...] = (*members, *blocks)
    outputs = {n: i for i, n in enumerate(f"{p.name}.{q.name}" for p in parts for q in p.outputs)}
    driven = {name: len(outputs) + i for i, name in enumerate(signals)}
    names = [f"{p.name}.{q.name}" for p in parts for q in p.inputs]
    inputs = {name: len(outputs) + len(driven) + i for i, name in enumerate(names)}
    size = len(outputs) + len(driven) + 2 * len(inputs)
    bonds = {bond.name: size + 2 * i for i, bond in enumerate(system.bonds)}
    wires = [Wire(inputs[c.target], outputs[c.source], c.gain, c.offset) for c in system.connections]
    wires += [Wire(inputs[name], slot, 1.0) for name, slot in driven.items()]
    places, first_out, first_in = {}, 0, len(outputs) + len(driven)
    for part in parts:
        last_out, last_in = first_out + len(part.outputs), first_in + len(part.inputs)
        rates = slice(first_in + len(inputs), last_in + len(inputs))
        places[part.name] = Place(slice(first_out, last_out), slice(first_in, last_in), rates)
        first_out, first_in = last_out, last_in
    return Layout(members, blocks, places, outputs, driven, inputs, bonds, tuple(sorted(wires)), size + 2 * len(bonds))


def view_of(array: Array) -> memoryview[float]:
    """The same memory, for one number or one stretch at a time."""
    return memoryview(array)  # type: ignore[arg-type]


class Row:
    """The numbers of a run, as an array for all at once and as a view for one at a time (which is faster)."""

    def __init__(self, layout: Layout) -> None:
        self.array: Array = np.zeros(layout.size)
        self.view = view_of(self.array)

    def carry(self, wires: tuple[Wire, ...]) -> None:
        """Bring the drivers' values to the inputs."""
        view = self.view
        for target, source, factor, offset in wires:
            view[target] = factor * view[source] + offset

    def part(self, slots: slice) -> Array:
        """A view of some slots, contiguous and writable."""
        return self.array[slots]
