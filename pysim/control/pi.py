"""The thesis' PI controller as a difference equation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from pysim.control._check import check_numbers
from pysim.types import BadInput, Port


@dataclass
class PI:
    """u(k) = u(k-1) + K_p e(k) + (K_p dt / T_i - K_p) e(k-1), e = reference - measured.

    The output that is remembered is the limited one, so that the integral does not wind up: the controller leaves its
    limit with the first sample whose increment points inwards. While `active` is not above 0.5 the output is
    `track`, and once it is active again it goes on from there without a jump; the first active step adds the integral's
    part only.

    Args:
        K_p: gain, output unit per unit of the error.
        T_i: integration time, s.
        dt: s between two steps.
        unit, output_unit: of error and output.
        low, high: limits of the output.
        start: output ahead of the first step.
    Raises:
        BadInput: what is no number, times that are not positive, a gain that is not finite, limits the wrong way
            round, a start outside.
    Source: thesis Eq. 5.33. Differs: output limits, bumpless start.
    """

    K_p: float
    T_i: float
    dt: float
    unit: str = "1"
    output_unit: str = "1"
    low: float = -math.inf
    high: float = math.inf
    start: float = 0.0

    def __post_init__(self) -> None:
        check_numbers("PI", self, "K_p", "T_i", "dt", "low", "high", "start")
        if not (math.isfinite(self.K_p) and 0 < self.T_i < math.inf and 0 < self.dt < math.inf):
            raise BadInput(
                f"PI: K_p = {self.K_p:g}, T_i = {self.T_i:g} s, dt = {self.dt:g} s; give a finite gain, positive times"
            )
        if not self.low < self.high or not self.low <= self.start <= self.high:
            raise BadInput(
                f"PI: low = {self.low:g}, start = {self.start:g}, high = {self.high:g}; put them in this order"
            )
        self.inputs = (
            Port("reference", self.unit),
            Port("measured", self.unit),
            Port("track", self.output_unit, self.start),
            Port("active", "1", 1.0),
        )
        self.outputs = (Port("u", self.output_unit, self.start),)
        self._integral = self.K_p / self.T_i * self.dt
        self._u, self._error, self._begun = self.start, 0.0, 0.0

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        """One sample: (reference, measured, track, active) -> (u,)."""
        reference, measured, track, active = inputs
        error = reference - measured
        if active <= 0.5:
            self._u, self._error, self._begun = min(max(track, self.low), self.high), error, 0.0
            return (self._u,)
        return (self.advance(error, self.low, self.high),)

    def advance(self, error: float, low: float, high: float) -> float:
        """The output of one active sample within limits that may be others each time."""
        before = self._error if self._begun else error
        u = self._u + self.K_p * (error - before) + self._integral * before
        self._u, self._error, self._begun = min(max(u, low), high), error, 1.0
        return self._u

    def rest(self) -> None:
        """One sample that is not active and keeps the output for later."""
        self._begun = 0.0
