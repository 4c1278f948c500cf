"""Maxima (tops) and minima (bottoms) of an output, each assigned to the half turn of the command that caused it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pysim.identify.chirp.cycle_fit import CycleFit, Extreme, Samples, fit_cycle
from pysim.identify.logged import LoggedWave
from pysim.types import Record, sampling
from pysim.types.note import Note, NoteCode

# An extreme counts as lost in noise if its distance from the level is below this many of its standard deviations.
_SEEN = 4.0
# After this many lost extremes in a row, all further ones are ignored.
_LOST = 6


def samples_of(data: Record, command: LoggedWave, output: str) -> Samples:
    """The output within the sweep, over the command's angle."""
    inside = (data.time >= command.start - 1e-9) & (data.time <= command.end + 1e-9)
    time = data.time[inside]
    frequency = np.maximum(command.frequency_at(time), 1e-9)
    per_turn = 1 / (sampling(data.time).step * frequency)
    return Samples(command.angle(time), data[output][inside], per_turn, abs(command.rate) / frequency**2)


def extremes(samples: Samples, command: LoggedWave) -> Iterator[tuple[int, Extreme, CycleFit]]:
    """Number of the command's half turn, the output's extreme that it caused, and the local fit, from low frequency up.

    The command's extremes are at the angles (number + 1/2) pi; even numbers are tops.
    """
    first = int(np.ceil(samples.angle[0] / np.pi - 0.5))
    last = int(np.floor(samples.angle[-1] / np.pi - 0.5))
    numbers = range(first, last + 1) if command.rate >= 0 else range(last, first - 1, -1)
    phase = None
    for number in numbers:
        at = (number + 0.5) * np.pi
        here = fit_cycle(samples, at - (phase or 0.0))
        if here is None:
            continue
        # the window is shifted by the output's phase lag, which is tracked from one extreme to the next
        found = here.phase if phase is None else phase + float(np.angle(np.exp(1j * (here.phase - phase))))
        if phase is None:
            here = fit_cycle(samples, at - found) or here
        phase = found
        extreme = here.extreme(at - phase, 1 if number % 2 == 0 else -1)
        if extreme is not None:
            yield number, extreme, here


def seen_ones(
    found: list[tuple[int, Extreme, CycleFit]], level: float, noise: float, command: LoggedWave
) -> tuple[dict[int, Extreme], list[Note]]:
    """Number -> extreme for extremes above the noise, up to where too many in a row are lost, with a note on that."""
    seen: dict[int, Extreme] = {}
    lost = 0
    for number, extreme, _ in found:
        height = (extreme.value - level) * (1 if number % 2 == 0 else -1)
        if height > _SEEN * noise * extreme.value_deviation:
            seen[number], lost = extreme, 0
            continue
        lost += 1
        if lost == _LOST:
            at = float(command.frequency_at(command.time_of(np.array([(number + 0.5) * np.pi])))[0])
            return seen, [Note(NoteCode.LOST_IN_NOISE, {"frequency": at})]
    return seen, []


def paired_ones(seen: dict[int, Extreme], step: int) -> list[tuple[int, int]]:
    """Pairs (top, bottom) of neighbouring numbers, each in one pair; step is 1 if the frequency rises, else -1."""
    pairs, taken = [], None
    for number in sorted(seen, reverse=step < 0):
        if number == taken or number + step not in seen:
            continue
        taken = number + step
        pairs.append((number, taken) if number % 2 == 0 else (taken, number))
    return pairs


def apart_ones(paired: list[tuple[int, int]], half: dict[int, float]) -> tuple[int, ...]:
    """Indices of pairs whose local fits do not overlap; `half`: number -> half width of its fit, rad."""
    chosen: list[int] = []
    reached = (np.inf, -np.inf)  # angles that the last chosen pair spans
    for i, pair in enumerate(paired):
        low, high = min(n * np.pi - half[n] for n in pair), max(n * np.pi + half[n] for n in pair)
        if not chosen or low >= reached[1] or high <= reached[0]:
            chosen.append(i)
            reached = low, high
    return tuple(chosen)
