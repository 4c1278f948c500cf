"""Settings of error control by step doubling."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from pysim.cosim.member import Member
from pysim.types import BadInput


@dataclass(frozen=True)
class Doubling:
    """Between two communication points, as many steps as the error asks for.

    Every step is made once whole and once in two halves; the difference, over 2^p - 1 for an order p, is the error of
    the halves, which are what is kept. It costs three steps for two, and every member must be able to go back and to
    take steps of any size.

    Args:
        rtol: tolerated error of a step, of the largest value that each output has had, in steps that were tried too.
        halvings: the smallest step is the communication step over 2 to this power; the run stops where it is too large.
    Raises:
        BadInput: a setting out of range.
    """

    rtol: float = 1e-4
    halvings: int = 12

    def __post_init__(self) -> None:
        if not self.rtol > 0 or not 0 <= self.halvings <= 40:
            raise BadInput(f"doubling: rtol = {self.rtol}, halvings = {self.halvings}; give a positive one and 0 to 40")

    def check(self, members: Iterable[Member]) -> None:
        """Check that all members take steps of any size.

        Raises:
            BadInput: one does not.
        """
        stiff = [member.name for member in members if not member.can_vary_step]
        if stiff:
            raise BadInput(f"step doubling: {', '.join(stiff)} takes steps of one size only; leave doubling out")
