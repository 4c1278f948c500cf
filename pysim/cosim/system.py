"""Members, blocks and wires, checked once."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from pysim.cosim._graph import Graph, components, is_circle, one_circle
from pysim.cosim._parts import check_member, check_unique, row_of
from pysim.cosim.bond import Bond, is_power
from pysim.cosim.connection import Connection
from pysim.cosim.member import Member
from pysim.cosim.sampled import Sampled
from pysim.types import BadInput, Port

Part = Member | Sampled


@dataclass(frozen=True)
class System:
    """What is wired to what. An input that no connection drives keeps its start value, or the experiment drives it.

    Args:
        members: FMUs (pysim.cosim.members), sampled blocks, or whatever has the attributes of `Member`.
        connections: at most one per input.
        bonds: where power goes over, for its balance in the record.
    Raises:
        BadInput: names that are not unique, a name that does not exist, an input driven twice, units that differ, a
            bond that is none.
    """

    members: tuple[Part, ...]
    connections: tuple[Connection, ...] = ()
    bonds: tuple[Bond, ...] = ()
    _ports: Mapping[str, Mapping[str, Port]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name, kind in (("members", object), ("connections", Connection), ("bonds", Bond)):
            object.__setattr__(self, name, row_of(name, getattr(self, name), kind))
        if not self.members:
            raise BadInput("system: it has no members; give at least one")
        for member in self.members:
            check_member(member)
        check_unique("members", [m.name for m in self.members])
        ports = {
            "input": {f"{m.name}.{p.name}": p for m in self.members for p in m.inputs},
            "output": {f"{m.name}.{p.name}": p for m in self.members for p in m.outputs},
        }
        object.__setattr__(self, "_ports", ports)
        for connection in self.connections:
            source, target = self.port("output", connection.source), self.port("input", connection.target)
            connection.check_units(source.unit, target.unit)
        self._check_single()
        check_unique("bonds", [bond.name for bond in self.bonds])
        for bond in self.bonds:
            self._check_bond(bond)

    @cached_property
    def drivers(self) -> Mapping[str, Connection]:
        """Input -> the connection that drives it."""
        return {connection.target: connection for connection in self.connections}

    @cached_property
    def instant(self) -> Graph:
        """What depends on what at once: an output (a sampled block as a whole) -> those it needs."""
        graph: dict[str, frozenset[str]] = {}
        for part in self.members:
            for node in self._nodes(part):
                drivers = (self.drivers.get(f"{part.name}.{port}") for port in self.depends(node))
                graph[node] = frozenset(self._node(driver.source) for driver in drivers if driver is not None)
        return graph

    @cached_property
    def loops(self) -> tuple[tuple[str, ...], ...]:
        """Algebraic loops: outputs that depend on themselves at once, each with a shortest way round."""
        groups = components(self.instant)
        return tuple(one_circle(group, self.instant) for group in groups if is_circle(group, self.instant))

    def depends(self, node: str) -> frozenset[str]:
        """The member's own inputs that a node of `instant` depends on."""
        name, _, port = node.partition(".")
        part = self._parts[name]
        if not port:
            return frozenset(p.name for p in part.inputs) if part.feedthrough else frozenset()
        return frozenset(part.feedthrough.get(port, ()))

    def outputs_of(self, node: str) -> tuple[str, ...]:
        """The outputs that a node of `instant` stands for."""
        return (node,) if "." in node else tuple(n for n in self.outputs if owner(n) == node)

    def _nodes(self, part: Part) -> tuple[str, ...]:
        return (part.name,) if isinstance(part, Sampled) else tuple(f"{part.name}.{p.name}" for p in part.outputs)

    def _node(self, output: str) -> str:
        return owner(output) if isinstance(self._parts[owner(output)], Sampled) else output

    @cached_property
    def _parts(self) -> Mapping[str, Part]:
        return {part.name: part for part in self.members}

    @property
    def inputs(self) -> Mapping[str, Port]:
        """Every input, by "member.input"."""
        return self._ports["input"]

    @property
    def outputs(self) -> Mapping[str, Port]:
        """Every output, by "member.output"."""
        return self._ports["output"]

    def port(self, side: str, name: str) -> Port:
        """The "input" or "output" of that name.

        Raises:
            BadInput: there is none; the text lists those that there are.
        """
        port = self._ports[side].get(name)
        if port is None:
            raise BadInput(f"system: there is no {side} {name!r}; {self._existing(side, name)}")
        return port

    def _existing(self, side: str, name: str) -> str:
        """What somebody may have meant: the ports of that member, or else the members."""
        owner = name.partition(".")[0]
        if owner not in (m.name for m in self.members):
            return f"members: {', '.join(m.name for m in self.members)} (write member.{side})"
        other = "output" if side == "input" else "input"
        if name in self._ports[other]:
            return f"it is an {other}; {side}s of {owner}: {self._list(side, owner)}"
        near = difflib.get_close_matches(name, list(self._ports[side]), n=3)
        hint = f"near it: {', '.join(near)}; " if near else ""
        return f"{hint}{side}s of {owner}: {self._list(side, owner)}"

    def _list(self, side: str, owner: str) -> str:
        return ", ".join(n for n in self._ports[side] if n.startswith(f"{owner}.")) or "none"

    def _check_single(self) -> None:
        seen: dict[str, Connection] = {}
        for connection in self.connections:
            if connection.target in seen:
                free = ", ".join(n for n in self.inputs if n not in {c.target for c in self.connections}) or "none"
                raise BadInput(
                    f"system: {connection.target} is driven by {seen[connection.target].source} and by "
                    f"{connection.source}; remove one (inputs still free: {free})"
                )
            seen[connection.target] = connection

    def _check_bond(self, bond: Bond) -> None:
        self.port("input", bond.effort), self.port("input", bond.flow)
        for name in (bond.effort, bond.flow):
            if name not in self.drivers:
                raise BadInput(f"bond {bond.name}: nothing is connected to {name}; connect it to the other member")
        effort, flow = self.drivers[bond.effort], self.drivers[bond.flow]
        if owner(effort.source) != owner(flow.target) or owner(flow.source) != owner(effort.target):
            raise BadInput(
                f"bond {bond.name}: {effort} and {flow} do not go to and fro between two members; name the input that "
                "receives the effort and the other's input that receives the flow"
            )
        if effort.offset or flow.offset:
            raise BadInput(
                f"bond {bond.name}: {effort if effort.offset else flow} adds an offset, which no power has; "
                "connect the two without one"
            )
        units = self.outputs[effort.source].unit, self.inputs[flow.target].unit
        if not is_power(*units):
            raise BadInput(
                f"bond {bond.name}: {units[0]} times {units[1]} is no power in W; pair Pa with m3/s, N with m/s, N.m "
                "with rad/s or V with A"
            )


def owner(name: str) -> str:
    """The member of "member.port"."""
    return name.partition(".")[0]
