"""How a command comes from zero to its offset, and back."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.excitation._check import check_not_negative
from pysim.excitation.excitation import Excitation
from pysim.types import BadInput, Signal

Array = NDArray[np.float64]


@dataclass(frozen=True)
class LeadIn:
    """Rest at zero, a straight ramp to the offset, a hold there; behind the excitation a straight ramp back to zero.

    Args:
        rest: s at zero command.
        ramp: s from zero to the offset; 0 jumps.
        hold: s at the offset before the excitation starts.
        ramp_down: s from the excitation's last value back to zero; 0 lets that value hold.
    Raises:
        BadInput: a duration that is negative or not finite.
    Source: thesis Section 2.1.1 and Figure 2.1, whose times are the defaults; it does not tell that of the ramp down.
    """

    rest: float = 0.5
    ramp: float = 0.5
    hold: float = 1.0
    ramp_down: float = 0.5

    def __post_init__(self) -> None:
        for name in ("rest", "ramp", "hold", "ramp_down"):
            check_not_negative(f"lead-in: {name}", getattr(self, name), "s")

    @classmethod
    def none(cls) -> LeadIn:
        """The excitation starts at time zero around its offset, and its last value holds."""
        return cls(0.0, 0.0, 0.0, 0.0)

    @property
    def onset(self) -> float:
        """When the excitation starts, s."""
        return self.rest + self.ramp + self.hold

    def around(self, offset: float, body: Signal, *, end: float = math.inf, first: float | None = None) -> Signal:
        """The whole command.

        Args:
            offset: what is led to, in the signal's unit.
            body: the excitation with its offset, in times of the test.
            end: s; where the excitation stops, or infinity where it does not.
            first: s; where it starts: the onset, or earlier within the hold.
        Raises:
            BadInput: an end that is not behind the start.
        """
        first = self.onset if first is None else first
        if not end > first:
            raise BadInput(f"test signal: its end at {end:g} s is not behind its start at {first:g} s; lengthen it")
        pieces = [*self._before(offset, first), *_between(body, first, end)]
        if math.isfinite(end):
            pieces += self._after(body, end)
        width = body.sines.shape[1]
        starts, cubics, sines = zip(*pieces, strict=True)
        padded = [np.vstack([rows, np.zeros((width - rows.shape[0], 4))]) for rows in sines]
        return Signal(np.array(starts), np.array(cubics), np.array(padded))

    def _before(self, offset: float, first: float) -> list[tuple[float, Array, Array]]:
        """Rest, ramp and hold as pieces; those of no length are left out."""
        nothing = np.zeros((0, 4))
        pieces = []
        if self.rest > 0:
            pieces.append((0.0, np.zeros(4), nothing))
        if self.ramp > 0:
            pieces.append((self.rest, np.array([0.0, offset / self.ramp, 0.0, 0.0]), nothing))
        if first > self.rest + self.ramp:
            pieces.append((self.rest + self.ramp, np.array([offset, 0.0, 0.0, 0.0]), nothing))
        return pieces

    def _after(self, body: Signal, end: float) -> list[tuple[float, Array, Array]]:
        """From the excitation's last value to zero, or that value for ever."""
        nothing = np.zeros((0, 4))
        (last,) = body.value(np.array([np.nextafter(end, -np.inf)]))  # to the left of a jump
        if self.ramp_down == 0:
            return [(end, np.array([last, 0.0, 0.0, 0.0]), nothing)]
        slope = np.array([last, -last / self.ramp_down, 0.0, 0.0])
        return [(end, slope, nothing), (end + self.ramp_down, np.zeros(4), nothing)]


class BehindLeadIn(Excitation, Protocol):
    """An excitation behind a lead-in: it begins where that ends, and the test is over when the command is at zero."""

    lead: LeadIn

    @property
    def onset(self) -> float:
        """When the excitation proper begins, s."""
        return self.lead.onset

    @property
    def duration(self) -> float:
        """Of the whole test, s."""
        return self.end + self.lead.ramp_down


def _between(body: Signal, first: float, end: float) -> list[tuple[float, Array, Array]]:
    """The body's pieces that start in [first, end); its first piece must start at `first`."""
    keep = np.flatnonzero(body.starts < end)
    if body.starts[0] != first:
        raise BadInput(f"test signal: its excitation starts at {body.starts[0]:g} s, not at {first:g} s")
    return [(float(body.starts[k]), body.cubics[k], body.sines[k]) for k in keep]
