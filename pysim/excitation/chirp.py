"""A sine whose frequency runs linearly from one to another."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from pysim.excitation._check import check_finite, check_not_negative, check_positive
from pysim.excitation.lead_in import BehindLeadIn, LeadIn
from pysim.types import BadInput, Signal


@dataclass(frozen=True)
class Chirp(BehindLeadIn):
    """amplitude sin(2 pi (start_hz + rate/2 s) s) + offset, s = t - onset, behind a lead-in.

    Args:
        offset: what the command swings around, in its unit.
        amplitude: positive, in its unit.
        start_hz, stop_hz: frequency at the onset and at the end; the sweep may run either way.
        sweep: s from the one to the other.
        lead: how the command comes to its offset and back.
    Raises:
        BadInput: an amplitude or sweep that is not positive, a negative frequency, two equal ones, or a number that is
            not finite.
    Source: thesis Eq. 2.2, 2.3.
    """

    offset: float
    amplitude: float
    start_hz: float
    stop_hz: float
    sweep: float
    lead: LeadIn = field(default_factory=LeadIn)

    def __post_init__(self) -> None:
        check_finite("chirp: the offset", self.offset, "")
        check_positive("chirp: the amplitude", self.amplitude, "")
        check_not_negative("chirp: the start frequency", self.start_hz, "Hz")
        check_not_negative("chirp: the stop frequency", self.stop_hz, "Hz")
        check_positive("chirp: the sweep", self.sweep, "s")
        if self.start_hz == self.stop_hz:
            raise BadInput(f"chirp: it starts and stops at {self.start_hz:g} Hz; use a stepped sine")

    @property
    def rate(self) -> float:
        """How fast the frequency runs, Hz/s (Eq. 2.3)."""
        return (self.stop_hz - self.start_hz) / self.sweep

    @property
    def highest_hz(self) -> float:
        """Of the faster end, Hz."""
        return max(self.start_hz, self.stop_hz)

    @property
    def end(self) -> float:
        """When the sweep stops, s."""
        return self.onset + self.sweep

    def signal(self) -> Signal:
        """The command, in its unit."""
        wave = np.array([[[self.amplitude, 0.0, 2 * math.pi * self.start_hz, 2 * math.pi * self.rate]]])
        body = Signal(np.array([self.onset]), np.array([[self.offset, 0.0, 0.0, 0.0]]), wave)
        return self.lead.around(self.offset, body, end=self.end)
