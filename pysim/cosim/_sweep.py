"""One step of every member, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from pysim.cosim._core import Core, restore, save
from pysim.cosim._exchange import check_finite
from pysim.cosim._fault import Fault, fault
from pysim.cosim.member import Member
from pysim.types import Outcome

# So many numbers are added faster one by one than by a call of numpy's.
_FEW = 12

Prepare = Callable[[float, float], None]
Make = Callable[[float, float, int | None], None]


class Sweep:
    """Steps members in an order; all end at the same time, the earliest that one of them could reach.

    Where a member returns early, it and those that have stepped on are put back and stepped again to that time, since
    inputs that run, or their means, are others over a shorter step. The first to step is left where it is if it cannot
    go back, or if no inputs run. Where that cannot be, because a member cannot be put back or takes no other step, the
    one goes on by itself, with its inputs as they are; `counts["unaligned"]` tells.

    Args:
        order: names of all members.
        prepare: for each, what is to be done with its inputs right ahead of its step; None for nothing.
        make: makes the inputs of all for a step from one time to another, to a tick; None where they are held.
    """

    def __init__(
        self, core: Core, order: Sequence[str], prepare: Sequence[Prepare | None], make: Make | None = None
    ) -> None:
        members = {member.name: member for member in core.layout.members}
        self._core, self._balance, outputs = core, core.balance, core.outputs
        few = outputs.size <= _FEW
        self._total = partial(sum, core.row.view[: outputs.size]) if few else partial(outputs.dot, outputs)
        self._plan = [(members[name], members[name].step, todo) for name, todo in zip(order, prepare, strict=True)]
        early = [i for i, (member, _, _) in enumerate(self._plan) if member.may_return_early]
        again = [member for member, _, _ in self._plan[: early[-1] + 1]] if early else []
        can_go_back, others = all(m.can_rollback for m in again), early != [0]
        self._can_cut = all(m.can_vary_step for m, _, _ in self._plan) and (can_go_back or not others)
        self._again = again if self._can_cut and can_go_back and (others or make is not None) else []
        self._make = make
        self._kept: list[object] = [None] * len(self._again)

    def __call__(self, time: float, end: float, tick: int | None = None) -> float:
        """Step all from `time` towards `end` (s), which is that tick; the time they have reached.

        Raises:
            Fault: a member could not go on, or put out what is no finite number.
        """
        if self._again:
            self._kept = [save(m, old) for m, old in zip(self._again, self._kept, strict=True)]
        if self._make is not None and end > time:
            self._make(time, end, tick)
        goal = end
        for number, (member, step, prepare) in enumerate(self._plan):
            try:
                if prepare is not None and goal > time:
                    prepare(time, goal)
                reached = step(time, goal)
            except Exception as error:
                raise self._blame(member, error) from error
            if reached != goal:
                reached = self._early(member, time, reached, goal)
            if reached != goal:
                if number or (self._again and reached > time):
                    for one, state in zip(self._again[: number + 1], self._kept, strict=False):
                        restore(one, state)
                    return self(time, reached)
                goal = reached
                if self._make is not None and goal > time:
                    self._make(time, goal, None)
        total = self._total()
        if total - total != 0:
            self._check_all()
        if self._balance is not None:
            self._balance.hold(goal - time)
        return goal

    def _early(self, member: Member, time: float, reached: float, goal: float) -> float:
        """What to make of an early return: the time for all."""
        if not member.may_return_early or not time <= reached < goal:
            why = f"a step to {goal:.12g} s ended at {reached:.12g} s, which it does not say it may do"
            raise Fault(member.name, why, Outcome.MODEL_ERROR)
        if self._can_cut:
            return reached
        self._core.counts["unaligned"] += 1
        try:
            return self._alone(member, reached, goal)
        except Exception as error:
            raise fault(member.name, error) from error

    def _alone(self, member: Member, reached: float, goal: float) -> float:
        stalled = 0
        while reached != goal:
            member.update()
            before, reached = reached, member.step(reached, goal)
            stalled = stalled + 1 if reached == before else 0
            check_stall(member.name, stalled)
        return reached

    def _blame(self, member: Member, error: Exception) -> Fault:
        """The fault of the member that failed, or of the one that fed it what is no number."""
        self._check_all()
        return fault(member.name, error)

    def _check_all(self) -> None:
        for member, _, _ in self._plan:
            check_finite(member, self._core.row.part(self._core.layout.places[member.name].outputs))


def check_stall(name: str, count: int) -> None:
    """Check that time passes.

    Raises:
        Fault: it does not, again and again.
    """
    if count > 100:
        raise Fault(name, "its events follow each other without time passing", Outcome.TOO_MANY_EVENTS)


def carrier(core: Core, name: str, stepped: Sequence[str]) -> Prepare | None:
    """Bring a member the outputs of those that have stepped already."""
    slots = [core.layout.places[other].outputs for other in stepped]
    owned = {slot for place in slots for slot in range(place.start, place.stop)}
    wires = tuple(wire for wire in core.layout.wires_to(name) if wire.source in owned)
    view = core.row.view

    def carry(time: float, end: float) -> None:
        for target, source, factor, offset in wires:
            view[target] = factor * view[source] + offset

    return carry if wires else None
