"""What happens at a communication point: signals, events, outputs that depend on inputs at once, sampled blocks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np

from pysim.cosim._fault import Fault, fault
from pysim.cosim._fixed_point import NotConverged, fixed_point
from pysim.cosim._graph import components, is_circle
from pysim.cosim._layout import Layout, Row, Wire
from pysim.cosim._sampler import Sampler
from pysim.cosim._signals import Signals
from pysim.cosim.member import Member
from pysim.cosim.system import System, owner
from pysim.types import Outcome

# An algebraic loop has so many evaluations to settle, within this share of its values.
_LIMIT, _RTOL = 100, 1e-10

# What is done at a point, given its tick (None between two) and its time.
Action = Callable[[int | None, float], None]


class Exchange:
    """Makes the row consistent at one instant. Whether circles may be solved, or are none, is settled before."""

    def __init__(self, system: System, layout: Layout, row: Row, samplers: Sequence[Sampler], signals: Signals) -> None:
        self._row, self._layout, self._signals = row, layout, signals
        self._samplers = {sampler.name: sampler for sampler in samplers}
        self._members = {member.name: member for member in layout.members}
        self._driven = row.view[len(layout.outputs) : layout.sources.stop] if layout.signals else None
        self._late = [self._samplers[b.name] for b in layout.blocks if b.delay > 0]
        self._moving = [self._samplers[b.name] for b in layout.blocks if b.delay > 0 or b.hold]
        self._wires = tuple(w for m in layout.members for w in layout.wires_to(m.name))
        self._actions = self._plan(system)
        self.counts: Counter[str] = Counter()

    def at(self, tick: int, time: float) -> None:
        """Communication point `tick`: blocks are sampled.

        Raises:
            Fault: a member or block could not go on, or a loop did not settle.
        """
        if self._driven is not None:
            self._driven[:] = self._signals.at(tick)
        for sampler in self._moving:
            sampler.deliver(tick, time)
        self._handle_events()
        for action in self._actions:
            action(tick, time)
        view = self._row.view
        for target, source, factor, offset in self._wires:
            view[target] = factor * view[source] + offset
        for sampler in self._late:
            sampler.sample(tick, time)

    def between(self, time: float, tick: int | None = None, *, events: bool = True) -> None:
        """No block is sampled: they keep what they set, or run on along their lines.

        Args:
            tick: where the time is that of a communication point; the signals are known there.
            events: False leaves events for later, and members that have one as they are.
        """
        if self._driven is not None:
            self._driven[:] = self._signals.between(time) if tick is None else self._signals.at(tick)
        for sampler in self._moving:
            sampler.deliver(-1, time)
        if events:
            self._handle_events()
        for action in self._actions:
            action(None, time)
        self._row.carry(self._wires)

    def settle(self, time: float, passes: int, *, exact: bool) -> bool:
        """Bring initial values round, with no block sampled; whether they came to rest.

        Args:
            exact: to the last bit, as they do without a loop.
        """
        now = self._row.array
        for _ in range(passes):
            before = now.copy()
            for member in self._members.values():
                self._row.carry(self._layout.wires_to(member.name))
                update(member)
                check_finite(member, self._row.part(self._layout.places[member.name].outputs))
            for action in self._actions:
                action(None, time)
            self._row.carry(self._wires)
            if np.array_equal(before, now) or (not exact and np.allclose(before, now, rtol=1e-6, atol=1e-12)):
                return True
        return False

    def _handle_events(self) -> None:
        for member in self._layout.members:
            if member.event:
                self._row.carry(self._layout.wires_to(member.name))
                update(member)

    def _plan(self, system: System) -> list[Action]:
        """Actions in an order in which each comes after what it needs."""
        graph, at_once = system.instant, {b.name for b in self._layout.blocks if not b.delay}
        level: dict[str, int] = {}
        plan: dict[tuple[int, str], list[str]] = {}
        circles: dict[tuple[int, str], tuple[str, ...]] = {}
        for group in components(graph):
            needs = {need for node in group for need in graph[node]} - set(group)
            depth = 1 + max((level[need] for need in needs), default=-1)
            level.update(dict.fromkeys(group, depth))
            if is_circle(group, graph):
                circles[depth, group[0]] = group
            elif group[0] in at_once or system.depends(group[0]):
                plan.setdefault((depth, owner(group[0])), []).append(group[0])
        actions = {key: self._evaluate(system, nodes)[0] for key, nodes in plan.items()}
        actions |= {key: self._circle(system, group) for key, group in circles.items()}
        return [actions[key] for key in sorted(actions, key=lambda key: key[0])]

    def _evaluate(self, system: System, nodes: Sequence[str]) -> tuple[Action, tuple[Wire, ...]]:
        """Sample a block, or update a member, and the wires that needs."""
        name = owner(nodes[0])
        if name in self._samplers:
            sampler = self._samplers[name]
            return sampler.sample, self._layout.wires_to(name)
        member = self._members[name]
        wires = self._layout.wires_to(name, {port for node in nodes for port in system.depends(node)})
        carry, outputs = self._row.carry, self._row.part(self._layout.places[name].outputs)

        def follow(tick: int | None, time: float) -> None:
            carry(wires)
            if member.event:  # left for later
                return
            update(member)
            check_finite(member, outputs)

        return follow, wires

    def _circle(self, system: System, group: tuple[str, ...]) -> Action:
        """Solve a loop for the values that are needed before they are known."""
        by_part: dict[str, list[str]] = {}
        for node in group:
            by_part.setdefault(owner(node), []).append(node)
        steps = [self._evaluate(system, nodes) for nodes in by_part.values()]
        slots = [{self._layout.outputs[o] for n in nodes for o in system.outputs_of(n)} for nodes in by_part.values()]
        torn, open_slots = set(), set().union(*slots)
        for (_, wires), own in zip(steps, slots, strict=True):
            torn |= {wire.source for wire in wires} & open_slots
            open_slots -= own
        samplers = [self._samplers[name] for name in by_part if name in self._samplers]
        tears = np.array(sorted(torn), dtype=np.intp)
        return self._solver([action for action, _ in steps], samplers, tears)

    def _solver(self, actions: list[Action], samplers: list[Sampler], tears: np.ndarray) -> Action:
        row, names = self._row.array, {slot: name for name, slot in self._layout.outputs.items()}

        def solve(tick: int | None, time: float) -> None:
            states = [sampler.save() for sampler in samplers]

            def g(x: np.ndarray) -> np.ndarray:
                for sampler, state in zip(samplers, states, strict=True):
                    sampler.restore(state)
                row[tears] = x
                for action in actions:
                    action(tick, time)
                return row[tears]

            try:
                count = fixed_point(g, row[tears], np.zeros(tears.size), rtol=_RTOL, limit=_LIMIT)[1]
            except NotConverged as error:
                name = names[int(tears[error.worst])]
                why = f"the algebraic loop through {name} does not settle in {_LIMIT} evaluations, it {error}"
                raise Fault(owner(name), why, Outcome.NOT_CONVERGED) from error
            self.counts["loop_evaluations"] += count

        return solve


def update(member: Member) -> None:
    """Let a member read its inputs and write its outputs.

    Raises:
        Fault: it could not.
    """
    try:
        member.update()
    except Exception as error:
        raise fault(member.name, error) from error


def check_finite(member: Member, outputs: np.ndarray) -> None:
    """Check what a member has put out.

    Raises:
        Fault: a value that is no finite number.
    """
    total = outputs.dot(outputs)
    if total - total == 0:
        return
    for port, value in zip(member.outputs, outputs, strict=True):
        if not np.isfinite(value):
            raise Fault(member.name, f"its output {port.name} is {value}", Outcome.NOT_FINITE)
