"""Harmonics of the period (lines): excited ones, and free ones that show distortion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.periods import Periods
from pysim.types import BadInput

Array = NDArray[np.float64]
Harmonics = NDArray[np.intp]

# A line counts as not excited if its amplitude is 60 dB below the largest one. The sorted amplitudes must have a gap of
# 10 dB between excited and other lines.
_RANGE = 1e-3
_GAP = 10**0.5


@dataclass(frozen=True)
class Lines:
    """Harmonic numbers; number 1 is the inverse of the period.

    Args:
        excited: (n_f,) increasing.
        even, odd: (n,) free lines in the excited band; `even` may also have one on each side of it.
    """

    excited: Harmonics
    even: Harmonics
    odd: Harmonics

    @property
    def are_odd(self) -> bool:
        """Whether all excited lines are odd, so that even powers of a nonlinearity do not disturb them."""
        return bool(np.all(self.excited % 2 == 1))


def lines_of(excited: Harmonics) -> Lines:
    """Find the free lines in the excited band; even lines one below the lowest and one above the highest count too.

    Raises:
        BadInput: fewer than two lines, or numbers that are not positive and increasing.
    """
    excited = np.asarray(excited, dtype=np.intp)
    if excited.ndim != 1 or excited.size < 2 or excited[0] < 1 or np.any(np.diff(excited) <= 0):
        raise BadInput("multisine: give at least two excited harmonics, positive and increasing")
    free = np.setdiff1d(np.arange(max(1, excited[0] - 1), excited[-1] + 2), excited)
    inside = free[(free > excited[0]) & (free < excited[-1])]
    return Lines(excited, free[free % 2 == 0], inside[inside % 2 == 1])


def chosen_lines(periods: Periods, excited: Harmonics | None) -> Lines:
    """The given excited lines with their free lines; if None are given, those in the commands' spectra.

    Raises:
        BadInput: as `lines_of` and `excited_lines`, or a line that is not below half the sampling rate.
    """
    lines = excited_lines(periods) if excited is None else lines_of(excited)
    n = periods.values.shape[2]
    highest = (n - 1) // 2
    if lines.excited[-1] > highest:
        raise BadInput(
            f"multisine: line {lines.excited[-1]} is not below half of {n} samples per period; correct the lines, or "
            "sample faster"
        )
    return Lines(lines.excited, lines.even[lines.even <= highest], lines.odd)


def find_excited(amplitude: Array) -> Harmonics:
    """Numbers of the excited harmonics, by the widest gap in the sorted amplitudes of the command's spectrum.

    Args:
        amplitude: (n_l,) amplitudes of the harmonics 1, 2, ...
    Raises:
        BadInput: the spectrum has no gap of 10 dB within the 60 dB below its highest line.
    """
    amplitude = np.asarray(amplitude, dtype=np.float64)
    top = float(amplitude.max(initial=0.0))
    if not top > 0:
        raise BadInput("multisine: the command stands still; name the column that was excited")
    heights = np.sort(np.maximum(amplitude, _RANGE * top))[::-1]
    heights = np.append(heights, _RANGE * top)
    gaps = heights[:-1] / heights[1:]
    widest = int(np.argmax(gaps))
    if gaps[widest] < _GAP or widest == 0:
        raise BadInput(
            "multisine: the command's spectrum does not show which lines are excited; is the period right, and the "
            "record free of ramps? else name the lines"
        )
    return np.asarray(np.flatnonzero(amplitude > heights[widest + 1] * 1.0000001) + 1, dtype=np.intp)


def excited_lines(periods: Periods) -> Lines:
    """The lines that the commands of all realisations excite.

    Raises:
        BadInput: the spectra do not show them, or the realisations differ.
    """
    command = periods.values[:, :, :, 2 if len(periods.names) == 3 else 0].mean(axis=1)
    n = command.shape[1]
    spectra = np.abs(np.fft.rfft(command, axis=1))[:, 1 : (n - 1) // 2 + 1] * (2 / n)
    found = [find_excited(spectrum) for spectrum in spectra]
    for other in found[1:]:
        if not np.array_equal(other, found[0]):
            raise BadInput(
                f"multisine: the realisations excite different lines ({found[0].size} and {other.size} of them); "
                "analyse them one by one, or name the lines they have in common"
            )
    return lines_of(found[0])
