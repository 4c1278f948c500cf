"""Groups of records that are realisations of the same test."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.identify.multisine.lines import Harmonics, chosen_lines
from pysim.identify.multisine.periods import Periods

Array = NDArray[np.float64]

# Realisations have the same amplitudes by construction, except for noise and quantisation.
_SAME_AMPLITUDES = 0.05
_SAME_OFFSET = 0.1


def grouped_realisations(records: Sequence[Periods], *, excited: Harmonics | None = None) -> tuple[Periods, ...]:
    """Group records that excite the same lines with the same amplitudes around the same offset.

    Args:
        records: of one realisation each, or of several that belong together.
        excited: excited harmonics of all records; None finds them in each command's spectrum.
    Returns:
        one per test, in the order of first appearance. If numbers of periods differ in a test, the last periods are
        kept."""
    groups: list[list[Periods]] = []
    for record in records:
        for group in groups:
            if _same_test(group[0], record, excited):
                group.append(record)
                break
        else:
            groups.append([record])
    return tuple(_joined(group) for group in groups)


def _same_test(first: Periods, second: Periods, excited: Harmonics | None) -> bool:
    """Whether signals, sampling, spectrum and offset of the commands agree."""
    if (first.names, first.period, first.values.shape[2]) != (second.names, second.period, second.values.shape[2]):
        return False
    lines, other = (chosen_lines(periods, excited).excited for periods in (first, second))
    if not np.array_equal(lines, other):
        return False
    a, b = _command(first), _command(second)
    one, two = (np.abs(np.fft.rfft(command)[lines]) for command in (a, b))
    if np.linalg.norm(one - two) > _SAME_AMPLITUDES * np.linalg.norm(one):
        return False
    return abs(float(a.mean() - b.mean())) < _SAME_OFFSET * float(np.std(a))


def _command(periods: Periods) -> Array:
    """The first realisation's command, averaged over its periods, (N,)."""
    return np.asarray(periods.values[0, :, :, 2 if len(periods.names) == 3 else 0].mean(axis=0))


def _joined(group: list[Periods]) -> Periods:
    count = min(periods.values.shape[1] for periods in group)
    values = np.concatenate([periods.values[:, -count:] for periods in group])
    first = group[0]
    return Periods(values, first.names, first.units, first.period, first.origin)
