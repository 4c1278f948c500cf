"""Stepped sines that a plant does not follow steadily yet: none of their periods stands for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pysim.identify.greybox.sine_log import SineLog

# Standard deviations by which a log's first period may differ from the others, of which a data set has some hundred
# numbers, and noise with memory puts more into slow ones than white noise does; and the same where another log
# differs by more.
UNLIKE, _ALSO = 5.0, 2.5


def unsettled(logs: Sequence[SineLog]) -> list[bool]:
    """Of each log of a data set, whether the plant had not settled when its compared periods began."""
    away = [unlike(log) for log in logs]
    limit = _ALSO if max(away, default=0.0) > UNLIKE else UNLIKE
    return [z > limit for z in away]


def unlike(log: SineLog) -> float:
    """How far the first compared period of a log is from those after it, in standard deviations: the largest difference
    of a mean, a sine or a cosine; zero where there is one period only.

    A valve that is too slow for the sine, or a plate that sticks, may need many periods more than were left out.
    """
    first = log.phase < log.phase[0] + (1 - 1e-6) * 2 * np.pi
    if any(np.count_nonzero(part) < 2 * log.count + 2 for part in (first, ~first)):
        return 0.0
    begun, rest = log.part(first), log.part(~first)
    variance = sum(part.variances[:, None] * np.maximum(part.scatter, log.noise) ** 2 for part in (begun, rest))
    return float(np.max(np.abs(rest.parts - begun.parts) / np.sqrt(variance)))


def unsettled_note(sources: Sequence[str]) -> list[str]:
    """What a reader must know of such logs; nothing where there are none."""
    if not sources:
        return []
    others = f" and {len(sources) - 1} more" if len(sources) > 1 else ""
    return [
        f"{sources[0]}{others}: the first compared period is unlike those after it, as before a plant has "
        "settled or where noise has a long memory; compared sample by sample from its start"
    ]
