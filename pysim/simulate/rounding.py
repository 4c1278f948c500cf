"""When two times are one: those of communication points and of events are computed in different ways."""

from __future__ import annotations

import math

_SHARE = 1e-9  # of the step
_ROUNDINGS = 4  # of the time, where these are more


def rounding(time: float, end: float) -> float:
    """How near to the end (s) of a step from `time` an event is at the end."""
    return max(_SHARE * (end - time), _ROUNDINGS * math.ulp(end))
