"""Numbers as JSON takes them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def json_number(value: float | None) -> float | None:
    """The number; None, which JSON writes as null, in place of infinity, of NaN and of none."""
    return float(value) if value is not None and math.isfinite(value) else None


def json_data(value: Mapping[str, Any]) -> dict[str, Any]:
    """The same as lists, dictionaries and plain numbers, each of which is finite or None.

    Args:
        value: holds mappings, sequences and arrays, one within another.
    """
    return {key: _plain(one) for key, one in value.items()}


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return json_data(value)
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return json_number(value) if isinstance(value, float) else value
