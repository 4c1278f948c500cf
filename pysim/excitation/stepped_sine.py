"""One sine around an offset: a step of the stepped-sine test."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from pysim.excitation._check import check_finite, check_positive
from pysim.excitation.lead_in import BehindLeadIn, LeadIn
from pysim.types import BadInput, Signal


@dataclass(frozen=True)
class SteppedSineCommand(BehindLeadIn):
    """amplitude sin(2 pi frequency (t - onset)) + offset behind a lead-in.

    Args:
        offset: what the command swings around, in its unit.
        amplitude: positive, in its unit.
        frequency: Hz.
        periods: how many; infinity where the sine is not to end.
        lead: how the command comes to its offset and back.
    Raises:
        BadInput: an amplitude, frequency or number of periods that is not positive, or a number that is not finite.
    Source: thesis Eq. 2.1 and Section 2.1.1.
    """

    offset: float
    amplitude: float
    frequency: float
    periods: float = 10.0
    lead: LeadIn = field(default_factory=LeadIn)

    def __post_init__(self) -> None:
        check_finite("stepped sine: the offset", self.offset, "")
        check_positive("stepped sine: the amplitude", self.amplitude, "")
        check_positive("stepped sine: the frequency", self.frequency, "Hz")
        if not self.periods > 0:
            raise BadInput(f"stepped sine: the number of periods is {self.periods}; it must be positive")

    @property
    def highest_hz(self) -> float:
        """Of the sine, Hz."""
        return self.frequency

    @property
    def end(self) -> float:
        """When the sine stops, s."""
        return self.onset + self.periods / self.frequency

    def signal(self) -> Signal:
        """The command, in its unit."""
        sine = np.array([[[self.amplitude, 0.0, 2 * math.pi * self.frequency, 0.0]]])
        body = Signal(np.array([self.onset]), np.array([[self.offset, 0.0, 0.0, 0.0]]), sine)
        return self.lead.around(self.offset, body, end=self.end)
