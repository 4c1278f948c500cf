"""Numbers as JSON takes them."""

from __future__ import annotations

import math


def json_number(value: float | None) -> float | None:
    """The number; None, which JSON writes as null, in place of infinity, of NaN and of none."""
    return float(value) if value is not None and math.isfinite(value) else None
