"""A periodic sum of sines with random phases."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.excitation._check import check_finite, check_positive, check_seed
from pysim.excitation._waves import largest_value, start_in_hold, wave_signal
from pysim.excitation.lead_in import BehindLeadIn, LeadIn
from pysim.excitation.line_grid import LineGrid
from pysim.types import BadInput, Signal

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Multisine(BehindLeadIn):
    """Sines on the excited lines of a grid, phases drawn evenly from [0, 2 pi), around an offset.

    Args:
        grid: period and lines.
        seed: of the phases; `realisation` gives the next ones.
        rms, peak: level of the wave without its offset, in the command's unit; give exactly one.
        shape: (n_excited,) relative amplitudes, not negative; equal ones where empty.
        offset: what the wave is around, in the command's unit.
        periods: how many, whole or not.
        lead: how the command comes to its offset and back; the wave starts within the hold, where it last passes zero
            before the onset, so that the command does not jump. With `LeadIn.none()` it is periodic from time zero.
    Raises:
        BadInput: both levels or none, one that is not positive, a shape of another length or without power, a
            number of periods that is not positive, or a seed below zero.
    Source: Pintelon and Schoukens, System Identification: A Frequency Domain Approach, 2nd ed., Section 2.3 and 5.3.
    """

    grid: LineGrid
    seed: int
    rms: float | None = None
    peak: float | None = None
    shape: tuple[float, ...] = ()
    offset: float = 0.0
    periods: float = 3.0
    lead: LeadIn = field(default_factory=LeadIn)

    def __post_init__(self) -> None:
        if (self.rms is None) == (self.peak is None):
            raise BadInput("multisine: give its level by rms or by peak, one of them")
        check_positive("multisine: the level", self.rms if self.peak is None else self.peak, "")  # type: ignore[arg-type]
        check_finite("multisine: the offset", self.offset, "")
        check_positive("multisine: the number of periods", self.periods, "")
        check_seed("multisine: the seed", self.seed)
        object.__setattr__(self, "shape", tuple(float(a) for a in self.shape))
        count = self.grid.excited.size
        if self.shape and (len(self.shape) != count or min(self.shape) < 0 or not 0 < sum(self.shape) < math.inf):
            raise BadInput(
                f"multisine: its shape needs {count} relative amplitudes, one per excited line, none negative and not "
                f"all zero; got {len(self.shape)}"
            )

    def realisation(self, number: int) -> Multisine:
        """The same wave with other phases: the seed is `number` further on."""
        return replace(self, seed=self.seed + number)

    @property
    def period(self) -> float:
        """s."""
        return self.grid.period

    @property
    def end(self) -> float:
        """When the wave stops, s."""
        return self.onset + self.periods * self.period

    @property
    def highest_hz(self) -> float:
        """Of the fastest sine, Hz."""
        return float(self.grid.excited[-1]) / self.period

    def waves(self) -> Array:
        """(n_excited, 3): amplitude (command's unit), phase at the onset (rad), angular frequency (rad/s)."""
        lines = self.grid.excited
        phases = np.random.default_rng(self.seed).uniform(0.0, 2 * math.pi, lines.size)
        relative = np.array(self.shape) if self.shape else np.ones(lines.size)
        waves = np.column_stack([relative, phases, 2 * math.pi * lines / self.period])
        if self.rms is not None:
            waves[:, 0] *= self.rms / math.sqrt(float(np.sum(relative**2)) / 2)
        else:
            waves[:, 0] *= float(self.peak or 0.0) / largest_value(waves, self.period)
        return waves

    def coefficients(self) -> NDArray[np.complex128]:
        """(n_excited,) complex amplitudes: the wave is the sum of Re(c_k exp(i omega_k (t - onset)))."""
        amplitude, phase, _ = self.waves().T
        return amplitude * np.exp(1j * (phase - math.pi / 2))

    def signal(self) -> Signal:
        """The command, in its unit."""
        waves = self.waves()
        first = start_in_hold(waves, self.lead)
        body = wave_signal(waves, offset=self.offset, first=first, onset=self.onset)
        return self.lead.around(self.offset, body, end=self.end, first=first)
