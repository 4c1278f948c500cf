"""Settings that make sense, or a sentence that says which does not."""

from __future__ import annotations

import math

from pysim.types import BadInput


def check_finite(what: str, value: float, unit: str) -> None:
    """Raises: BadInput for a value that is no finite number."""
    if not math.isfinite(value):
        raise BadInput(f"{what} is {value} {unit}; give a finite number")


def check_positive(what: str, value: float, unit: str) -> None:
    """Raises: BadInput for a value that is not positive and finite."""
    if not (value > 0 and math.isfinite(value)):
        raise BadInput(f"{what} is {value:g} {unit}; it must be positive and finite")


def check_not_negative(what: str, value: float, unit: str) -> None:
    """Raises: BadInput for a value that is negative or not finite."""
    if not (value >= 0 and math.isfinite(value)):
        raise BadInput(f"{what} is {value:g} {unit}; it must be finite and not negative")
