"""Steps that are made again until every member's inputs fit the outputs at the step's end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.cosim._core import Core
from pysim.cosim._fault import Fault
from pysim.cosim._fixed_point import NotConverged, fixed_point
from pysim.cosim._lines import Lines
from pysim.cosim._steppers import Remembering
from pysim.cosim._sweep import Sweep
from pysim.cosim.member import Array
from pysim.cosim.order import Stepper
from pysim.cosim.system import owner
from pysim.types import BadInput, Outcome


@dataclass(frozen=True)
class Iterated:
    """Inputs run as lines from the begin's values to those at the end, which are iterated; second order, and stable
    where held inputs are not. Every member must be able to go back. Algebraic loops are solved.

    Args:
        rtol: the iteration ends when no coupled output changes by more than this share of the largest it has had.
        limit: evaluations of a step; the run stops where they are not enough.
    Raises:
        BadInput: a setting that is not positive.
    """

    rtol: float = 1e-8
    limit: int = 50
    accuracy, solves_loops = 2, True  # see Order

    def __post_init__(self) -> None:
        if not (self.rtol > 0 and self.limit > 0):
            raise BadInput(f"iterated: rtol = {self.rtol}, limit = {self.limit}; give positive numbers")

    def stepper(self, core: Core) -> Stepper:
        """Start to work.

        Raises:
            BadInput: a member that cannot go back.
        """
        check_rollback("iterated steps", core)
        return _Stepper(core, self)


def check_rollback(what: str, core: Core) -> None:
    """Check that all members can go back.

    Raises:
        BadInput: one cannot.
    """
    stuck = [member.name for member in core.layout.members if not member.can_rollback]
    if stuck:
        raise BadInput(
            f"{what}: {', '.join(stuck)} cannot save and restore its state; export it with canGetAndSetFMUState, or "
            "step with Jacobi() or GaussSeidel()"
        )


class _Early(Exception):
    """A member met an event within the step."""

    def __init__(self, reached: float) -> None:
        super().__init__()
        self.reached = reached


class _Stepper(Remembering):
    def __init__(self, core: Core, settings: Iterated) -> None:
        super().__init__(Lines(core))
        self._core, self._settings = core, settings
        names = [m.name for m in core.layout.members]
        self._sweep = Sweep(core, names, [None] * len(names))
        targets = {slot for m in core.layout.members for slot in _range(core.layout.places[m.name].inputs)}
        coupled = {wire.source for wire in core.layout.wires if wire.target in targets}
        self._coupled = np.array(sorted(coupled & set(_range(core.layout.member_outputs))), dtype=np.intp)
        self._kept: list[Any] | None = None

    def advance(self, time: float, end: float, tick: int | None) -> float:
        """See Stepper."""
        core = self._core
        core.enlarge_scale()
        self._lines.begin()
        self._lines.aim(time, end, tick)
        self._kept = states = core.save(self._kept)
        again = False

        def g(x: Array) -> Array:
            nonlocal again
            if again:
                core.restore(states)
            again = True
            return self._evaluate(x, time, end, tick)

        try:
            scale = core.scale[self._coupled]
            _, count = fixed_point(
                g, self._lines.ends[self._coupled], scale, rtol=self._settings.rtol, limit=self._settings.limit
            )
        except _Early as early:
            core.restore(states)
            core.sources[:] = self._lines.begins
            return self.advance(time, early.reached, None)
        except NotConverged as error:
            raise self._not_converged(error, end - time) from error
        core.counts["iterations"] += count
        self._lines.done(time)
        return end

    def _evaluate(self, x: Array, time: float, end: float, tick: int | None) -> Array:
        """Coupled outputs at the end that follow from assumed ones."""
        self._lines.ends[self._coupled] = x
        self._lines.hold(time, end)
        reached = self._sweep(time, end)
        if reached != end:
            raise _Early(reached)
        self._core.exchange.between(end, tick, events=False)
        return self._core.sources[self._coupled]

    def _not_converged(self, error: NotConverged, size: float) -> Fault:
        slot = int(self._coupled[error.worst])
        name = next(n for n, s in self._core.layout.outputs.items() if s == slot)
        why = f"{name} {error} after {self._settings.limit} evaluations of a step of {size:g} s; take a smaller step"
        return Fault(owner(name), why, Outcome.NOT_CONVERGED)


def _range(slots: slice) -> range:
    return range(slots.start, slots.stop)
