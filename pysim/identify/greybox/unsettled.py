"""Stepped sines that a plant does not follow steadily yet: none of their periods stands for all."""

from __future__ import annotations

from collections.abc import Sequence

from pysim.identify.greybox.sine_log import SineLog

# Standard deviations by which a log's first period may differ from the others, of which a data set has some hundred
# numbers, and noise with memory puts more into slow ones than white noise does; and the same where another log
# differs by more.
UNLIKE, _ALSO = 5.0, 2.5


def unsettled(logs: Sequence[SineLog]) -> list[bool]:
    """Of each log of a data set, whether the plant had not settled when its compared periods began."""
    away = [log.unlike for log in logs]
    limit = _ALSO if max(away, default=0.0) > UNLIKE else UNLIKE
    return [z > limit for z in away]


def unsettled_note(sources: Sequence[str]) -> list[str]:
    """What a reader must know of such logs; nothing where there are none."""
    if not sources:
        return []
    others = f" and {len(sources) - 1} more" if len(sources) > 1 else ""
    return [
        f"{sources[0]}{others}: the first compared period is unlike those after it, as before a plant has "
        "settled or where noise has a long memory; compared sample by sample from its start"
    ]
