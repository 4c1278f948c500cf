"""Tops and bottoms of an answer, each by the half turn of the command that caused it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pysim.identify.chirp.cycle_fit import CycleFit, Extreme, Samples, fit_cycle
from pysim.identify.logged import LoggedWave
from pysim.types import Record, sampling
from pysim.types.note import Note, NoteCode

# An extreme that sticks out of the level by less than this many of its standard deviations is lost in noise.
_SEEN = 4.0
# So many lost ones in a row end the search: what comes behind is chance.
_LOST = 6


def samples_of(data: Record, command: LoggedWave, output: str) -> Samples:
    """The output within the sweep, over the command's angle."""
    inside = (data.time >= command.start - 1e-9) & (data.time <= command.end + 1e-9)
    time = data.time[inside]
    frequency = np.maximum(command.frequency_at(time), 1e-9)
    per_turn = 1 / (sampling(data.time).step * frequency)
    return Samples(command.angle(time), data[output][inside], per_turn, abs(command.rate) / frequency**2)


def extremes(samples: Samples, command: LoggedWave) -> Iterator[tuple[int, Extreme, CycleFit]]:
    """Number of the half turn of the command, and the output's extreme that belongs to it, from low frequency up.

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
        # the window follows the answer: its phase there is the one between the two, up to whole turns
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
    """Those that stick out of the noise, up to where too many in a row do not."""
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
    """(top, bottom) of extremes next to each other, each in one pair; step, 1 or -1, leads to higher frequency."""
    pairs, taken = [], None
    for number in sorted(seen, reverse=step < 0):
        if number == taken or number + step not in seen:
            continue
        taken = number + step
        pairs.append((number, taken) if number % 2 == 0 else (taken, number))
    return pairs


def apart_ones(paired: list[tuple[int, int]], half: dict[int, float]) -> tuple[int, ...]:
    """Places of pairs whose fits, `half` to either side of each extreme (rad), do not overlap."""
    chosen: list[int] = []
    reached = (np.inf, -np.inf)  # angles that the last chosen one spans
    for i, pair in enumerate(paired):
        low, high = min(n * np.pi - half[n] for n in pair), max(n * np.pi + half[n] for n in pair)
        if not chosen or low >= reached[1] or high <= reached[0]:
            chosen.append(i)
            reached = low, high
    return tuple(chosen)
