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
