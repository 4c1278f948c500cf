"""Members step one after the other; each sees what those before it have reached."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pysim.cosim._core import Core
from pysim.cosim._graph import components
from pysim.cosim._lines import Lines
from pysim.cosim._steppers import Held, Lined
from pysim.cosim._sweep import Prepare, carrier
from pysim.cosim.order import Stepper
from pysim.cosim.system import System, owner
from pysim.types import BadInput


@dataclass(frozen=True)
class GaussSeidel:
    """A member's inputs from those that have stepped already are taken at the step's end.

    Args:
        order: names of the members, blocks left out; empty follows the connections, each member after those that
            drive it; within a circle as the system lists them.
        lines: False holds an input over the step (first order); True lets it run as a line, to the end's value where
            that is known, else extrapolated (second order).
    """

    order: tuple[str, ...] = ()
    lines: bool = False
    solves_loops = False  # see Order

    @property
    def accuracy(self) -> int:
        """First order; with lines, second."""
        return 2 if self.lines else 1

    def stepper(self, core: Core) -> Stepper:
        """Start to work.

        Raises:
            BadInput: an order that does not name each member once.
        """
        names = [member.name for member in core.layout.members]
        if self.order and sorted(self.order) != sorted(names):
            raise BadInput(
                f"Gauss-Seidel: the order is {', '.join(self.order)}; name each of these once: {', '.join(names)}"
            )
        ordered = self.order or stepping_order(core.system, names)
        before = [ordered[:number] for number in range(len(ordered))]
        if not self.lines:
            return Held(core, ordered, [carrier(core, n, b) for n, b in zip(ordered, before, strict=True)])
        lines = Lines(core)
        prepare = [_interpolator(core, lines, n, b) for n, b in zip(ordered, before, strict=True)]
        return Lined(core, lines, ordered, prepare)


def stepping_order(system: System, names: Sequence[str]) -> tuple[str, ...]:
    """Members after those that drive them, through blocks too; within a circle as listed."""
    parts = {member.name: index for index, member in enumerate(system.members)}
    graph = {name: frozenset(owner(c.source) for c in system.connections if owner(c.target) == name) for name in parts}
    ordered = [name for group in components(graph) for name in sorted(group, key=parts.__getitem__)]
    return tuple(name for name in ordered if name in set(names))


def _interpolator(core: Core, lines: Lines, name: str, stepped: Sequence[str]) -> Prepare | None:
    """Take what the member before has reached, and let this one's inputs run to what all before it have."""
    if not stepped:
        return None
    last = next(member for member in core.layout.members if member.name == stepped[-1])
    follows = carrier(core, name, stepped) is not None

    def prepare(time: float, end: float) -> None:
        lines.know(last)
        if follows:
            lines.hold(time, end, name)

    return prepare
