"""The tests of one measuring session: 65 stepped sines, a chirp and two waves, logged at 250 Hz."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from validation.blind.plant.command import Command, Lead, chirp, stepped_sine, wave

RATE = 250.0  # Hz
OPERATING_POINTS = ((25.0, 10.0), (50.0, 5.0), (50.0, 20.0), (75.0, 10.0), (-50.0, 10.0))  # percent
FREQUENCIES = (0.1, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0)  # Hz
FEW_SINES = tuple(f"frequency_response/{test}/{f}Hz.txt" for test in ("O+50_A20", "O-50_A10") for f in (1, 4, 10, 20))
"""Logs of eight sines that stand for the 65 where time is short."""
UNSEEN = "stochastic/Tp0.5_heldout.txt"
"""The wave that a diagnosis is not given where it is judged."""
_LONG = 30.0  # s, of chirp and waves
_WAVE_DEVIATION = {"fit": 34.0, "validate": 30.0}  # percent


@dataclass(frozen=True)
class Test:
    """One test and the log it leaves.

    Args:
        file: of the log. kind, use: as the data set's form has them.
        length: s, from the first to the last sample.
        offset, amplitude: percent; frequency: Hz; None where the kind has none.
        peak_period: s, of a wave.
    """

    file: str
    kind: str
    use: str
    length: float
    offset: float | None = None
    amplitude: float | None = None
    frequency: float | None = None
    peak_period: float | None = None

    def command(self, seed: int, *, hold: float = 1.0, before: float = 0.0) -> Command:
        """The command of this test.

        Args:
            seed: of the session's waves.
            hold: s at the offset ahead of the test; the plate is at rest after half a second.
            before: percent, from where a wave's lead comes; sines and chirps come from zero.
        """
        if self.peak_period is not None:
            deviation = _WAVE_DEVIATION[self.use]
            lead = Lead(0.0, before, hold=hold)
            return wave(lead, (seed, self.use == "fit"), self.peak_period, deviation, self.length)
        assert self.offset is not None
        assert self.amplitude is not None
        lead = Lead(self.offset, hold=hold)
        if self.frequency is None:
            return chirp(lead, self.offset, self.amplitude, 0.1, 30.0, self.length)
        return stepped_sine(lead, self.offset, self.amplitude, self.frequency, self.length)


def programme() -> tuple[Test, ...]:
    """In the order in which they are carried out."""
    return (
        *_sines(),
        Test("chirp/O+50_A10.txt", "chirp", "validate", _LONG, 50.0, 10.0),
        Test("stochastic/Tp1.0_fit.txt", "stochastic", "fit", _LONG, peak_period=1.0),
        Test(UNSEEN, "stochastic", "validate", _LONG, peak_period=0.5),
    )


def _sines() -> Iterator[Test]:
    for offset, amplitude in OPERATING_POINTS:
        for f in FREQUENCIES:
            file = f"frequency_response/O{offset:+g}_A{amplitude:g}/{f:g}Hz.txt"
            yield Test(file, "frequency-response", "fit", _sine_length(f), offset, amplitude, f)


def _sine_length(frequency: float) -> float:
    """Whole periods: three or more, at least 1.2 s, at most 20 s."""
    return min(max(math.ceil(1.2 * frequency - 1e-9), 3) / frequency, 20.0)
