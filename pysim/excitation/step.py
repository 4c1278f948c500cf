"""A step from one level to another."""

from __future__ import annotations

from dataclasses import dataclass, field

from pysim.excitation._check import check_finite, check_positive
from pysim.excitation.lead_in import BehindLeadIn, LeadIn
from pysim.types import BadInput, Signal


@dataclass(frozen=True)
class Step(BehindLeadIn):
    """From `offset` to `offset + height` at the onset, and back again where asked for.

    Args:
        offset: level before the step, in the command's unit.
        height: of the step, of either sign, in the command's unit.
        length: s at each level behind the onset.
        back: whether a second step returns to the offset.
        lead: how the command comes to its offset and back to zero.
    Raises:
        BadInput: no height, no lead-in, one that jumps to the offset at the onset, a length that is not positive, or a
            number that is not finite.
    """

    offset: float
    height: float
    length: float
    back: bool = False
    lead: LeadIn = field(default_factory=LeadIn)

    def __post_init__(self) -> None:
        check_finite("step: the offset", self.offset, "")
        check_finite("step: the height", self.height, "")
        check_positive("step: the length", self.length, "s")
        if self.height == 0:
            raise BadInput("step: the height is 0; give one of either sign")
        if self.lead.onset == 0:  # a signal's first value also holds before it
            raise BadInput("step: without a lead-in there is no level to step from; give a rest, a ramp or a hold")
        if self.offset != 0 and self.lead.ramp == self.lead.hold == 0:
            raise BadInput(f"step: it would start from 0, not from its offset {self.offset:g}; give a ramp or a hold")

    @property
    def highest_hz(self) -> float:
        """Zero: there is no sine."""
        return 0.0

    @property
    def end(self) -> float:
        """When the last level ends, s."""
        return self.onset + self.length * (2 if self.back else 1)

    def signal(self) -> Signal:
        """The command, in its unit."""
        body = Signal.steps([self.onset, self.onset + self.length], [self.offset + self.height, self.offset])
        return self.lead.around(self.offset, body, end=self.end)
