"""All members step from the same instant, with what was known there."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.cosim._core import Core
from pysim.cosim._lines import Lines
from pysim.cosim._steppers import Held, Lined
from pysim.cosim.order import Stepper


@dataclass(frozen=True)
class Jacobi:
    """Every input is held over a step, or runs on along a line; no member waits for another.

    Args:
        lines: False keeps the value at the step's begin (first order); True extrapolates from the step before (second
            order, less stable with large steps).
    """

    lines: bool = False
    solves_loops = False  # see Order

    @property
    def accuracy(self) -> int:
        """First order; with lines, second."""
        return 2 if self.lines else 1

    def stepper(self, core: Core) -> Stepper:
        """Start to work."""
        # Those that may return early go first: then nobody has gone past their event.
        names = [m.name for m in sorted(core.layout.members, key=lambda m: not m.may_return_early)]
        nothing = [None] * len(names)
        return Lined(core, Lines(core), names, nothing) if self.lines else Held(core, names, nothing)
