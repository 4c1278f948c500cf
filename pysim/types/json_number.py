"""Numbers as JSON takes them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, overload

import numpy as np


def json_number(value: float | None) -> float | None:
    """The number; None, which JSON writes as null, in place of infinity, of NaN and of none."""
    return float(value) if value is not None and math.isfinite(value) else None


@overload
def json_data(value: Mapping[str, Any]) -> dict[str, Any]: ...
@overload
def json_data(value: Any) -> Any: ...
def json_data(value: Any) -> Any:
    """The same in lists, dictionaries and plain numbers, each of which is finite or None.

    Args:
        value: mappings, sequences and arrays, one within another.
    """
    if isinstance(value, Mapping):
        return {key: json_data(one) for key, one in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [json_data(one) for one in value]
    return json_number(value) if isinstance(value, float) else value
