"""Commands of the bench's tests, at knots close enough for a cubic between them: rest, ramp, hold, then the test."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.blind.plant.quantities import STEP

Array = NDArray[np.float64]

_FINE, _COARSE = 10, 50  # steps between knots: 0.2 ms for sines of up to 30 Hz, 1 ms for waves
_ONSET = 1.0  # s, over which a wave grows
_PEAK = 95.0  # percent, the largest swing of a wave


@dataclass(frozen=True)
class Lead:
    """What comes ahead of the test: rest at `before`, a ramp to `level`, and a hold; s and percent."""

    level: float
    before: float = 0.0
    rest: float = 0.5
    ramp: float = 0.5
    hold: float = 1.0

    @property
    def length(self) -> float:
        """s before the test starts."""
        return self.rest + self.ramp + self.hold


@dataclass(frozen=True)
class Command:
    """Values and slopes (n,) in percent and percent/s at knots `every` steps apart; the test starts at `start` s."""

    level: Array
    slope: Array
    every: int
    start: float


def stepped_sine(lead: Lead, offset: float, amplitude: float, frequency: float, length: float) -> Command:
    """Thesis Section 2.1.1: a sine around `offset` from the end of the lead on, `length` s long."""
    w = 2 * math.pi * frequency
    return _command(
        lead, offset, length, _FINE, lambda s: amplitude * np.sin(w * s), lambda s: amplitude * w * np.cos(w * s)
    )


def chirp(lead: Lead, offset: float, amplitude: float, first: float, last: float, length: float) -> Command:
    """Thesis Eq. 2.2 and 2.3: from `first` to `last` Hz in `length` s."""
    gradient = (last - first) / length
    return _command(
        lead,
        offset,
        length,
        _FINE,
        lambda s: amplitude * np.sin(2 * math.pi * (first + gradient / 2 * s) * s),
        lambda s: (
            amplitude * 2 * math.pi * (first + gradient * s) * np.cos(2 * math.pi * (first + gradient / 2 * s) * s)
        ),
    )


def wave(
    lead: Lead, seed: Sequence[int], peak_period: float, deviation: float, length: float, sines: int = 40
) -> Command:
    """A stochastic wave around zero: sines of seeded frequencies and phases, most energy at the peak period.

    Args:
        deviation: standard deviation in percent; less where the largest swing would pass 95 percent.
    """
    rng = np.random.default_rng(seed)
    edges = np.linspace(0.5, 4.0, sines + 1) / peak_period
    f = edges[:-1] + np.diff(edges) * rng.uniform(size=sines)
    density = f**-5.0 * np.exp(-1.25 * (f * peak_period) ** -4.0)  # after Pierson and Moskowitz
    size = np.sqrt(density / density.sum() * 2.0) * deviation
    phase = rng.uniform(0, 2 * math.pi, sines)
    w = 2 * math.pi * f

    def swing(s: Array) -> tuple[Array, Array]:
        angle = s[:, None] * w + phase
        grown = np.clip(s / _ONSET, 0, 1)
        share, share_t = grown**2 * (3 - 2 * grown), 6 * grown * (1 - grown) / _ONSET
        value, rate = np.sin(angle) @ size, np.cos(angle) @ (size * w)
        return value * share, rate * share + value * share_t

    probe, _ = swing(np.arange(0.0, length, 0.01))
    fit = min(1.0, _PEAK / float(np.abs(probe).max()))
    return _command(lead, 0.0, length, _COARSE, lambda s: fit * swing(s)[0], lambda s: fit * swing(s)[1])


def _command(
    lead: Lead,
    offset: float,
    length: float,
    every: int,
    value: Callable[[Array], Array],
    rate: Callable[[Array], Array],
) -> Command:
    """Lead and test joined: a knot more than the test needs, so that its last sample is inside."""
    pitch = every * STEP
    ahead = round(lead.length / pitch)
    before: Array = np.arange(ahead, dtype=np.float64) * pitch
    behind: Array = np.arange(round(length / pitch) + 2, dtype=np.float64) * pitch
    climb = (before >= lead.rest - 1e-9) & (before < lead.rest + lead.ramp - 1e-9)
    change = lead.level - lead.before
    level = lead.before + change * np.clip((before - lead.rest) / lead.ramp, 0.0, 1.0)
    return Command(
        np.concatenate([level, offset + value(behind)]),
        np.concatenate([np.where(climb, change / lead.ramp, 0.0), rate(behind)]),
        every,
        lead.length,
    )
