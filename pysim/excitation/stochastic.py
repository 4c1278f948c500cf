"""A stochastic wave: many sines with the energy of a spectrum and random phases (thesis Appendix A)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.excitation._check import check_finite, check_positive, check_seed, check_sines
from pysim.excitation._waves import start_in_hold, wave_signal
from pysim.excitation.lead_in import BehindLeadIn, LeadIn
from pysim.excitation.spectrum import PiersonMoskowitz
from pysim.types import BadInput, Signal

Array = NDArray[np.float64]

# Shares of the spectrum's variance left out below and above where no band is given: a thousandth in all, so that the
# significant height is within 0.05 percent.
_BELOW, _ABOVE = 1e-5, 1e-3


@dataclass(frozen=True)
class StochasticWave(BehindLeadIn):
    """A sum of sines of evenly divided frequencies whose phases are drawn from a seed.

    Args:
        spectrum: how the variance is spread over frequency.
        length: s of the wave.
        seed: of the phases, and of the frequencies where they are scattered.
        components: how many sines.
        offset: what the wave is around, in the command's unit.
        band_hz: lowest and highest frequency; by default all but a thousandth of the variance is within.
        scatter: draw each frequency from its interval. Else it is the interval's centre, as in the thesis; a wave
            longer than `repeats_after` then shows nothing new.
        lead: how the command comes to its offset and back; the wave starts within the hold, where it last passes zero
            before the onset, so that the command does not jump.
    Raises:
        BadInput: a number that is not finite or positive where it must be, no component or too many, a seed below zero,
            or an empty band.
    Source: thesis Appendix A, Eq. 2-4. Differs: frequencies are scattered by default, and the variance of
    each interval is taken exactly, not as width times the density at its centre.
    """

    spectrum: PiersonMoskowitz
    length: float
    seed: int
    components: int = 100
    offset: float = 0.0
    band_hz: tuple[float, float] | None = None
    scatter: bool = True
    lead: LeadIn = field(default_factory=LeadIn)

    def __post_init__(self) -> None:
        check_positive("stochastic wave: the length", self.length, "s")
        check_finite("stochastic wave: the offset", self.offset, "")
        check_seed("stochastic wave: the seed", self.seed)
        check_sines("stochastic wave", self.components)
        if self.components < 1:
            raise BadInput(f"stochastic wave: {self.components} components; it needs at least one")
        if self.band_hz is not None and not 0 <= self.band_hz[0] < self.band_hz[1] < math.inf:
            raise BadInput(f"stochastic wave: a band from {self.band_hz[0]:g} to {self.band_hz[1]:g} Hz is empty")

    @property
    def end(self) -> float:
        """When the wave stops, s."""
        return self.onset + self.length

    @property
    def edges(self) -> Array:
        """Of the intervals, (components + 1,) rad/s."""
        if self.band_hz is not None:
            low, high = (2 * math.pi * f for f in self.band_hz)
        else:
            low, high = (self.spectrum.frequency_of_energy(share) for share in (_BELOW, 1 - _ABOVE))
        return np.linspace(low, high, self.components + 1)

    @property
    def repeats_after(self) -> float:
        """The envelope repeats after this time, 2 pi / spacing, s; infinite where the frequencies are scattered."""
        return math.inf if self.scatter else float(2 * math.pi / (self.edges[1] - self.edges[0]))

    @property
    def highest_hz(self) -> float:
        """Upper edge of the band, Hz."""
        return float(self.edges[-1] / (2 * math.pi))

    def waves(self) -> Array:
        """(components, 3): amplitude (command's unit), phase at the onset (rad), angular frequency (rad/s)."""
        draw = np.random.default_rng(self.seed)
        phases = draw.uniform(0.0, 2 * math.pi, self.components)
        edges = self.edges
        share = draw.uniform(size=self.components) if self.scatter else 0.5
        omega = edges[:-1] + share * np.diff(edges)
        variance = self.spectrum.moment(0) * np.diff(self.spectrum.energy_below(edges))
        return np.column_stack([np.sqrt(2 * variance), phases, omega])

    def moment(self, order: float) -> float:
        """Spectral moment of this very sum of sines, as `PiersonMoskowitz.moment`."""
        amplitude, _, omega = self.waves().T
        return float(np.sum(amplitude**2 / 2 * omega**order))

    def signal(self) -> Signal:
        """The command, in its unit."""
        waves = self.waves()
        first = start_in_hold(waves, self.lead)
        body = wave_signal(waves, offset=self.offset, first=first, onset=self.onset)
        return self.lead.around(self.offset, body, end=self.end, first=first)
