"""Settings that make sense, or a sentence that says which does not."""

from __future__ import annotations

import math

from pysim.types import BadInput

MOST_SINES = 1_000_000  # one signal of so many takes minutes to sample


def check_finite(what: str, value: float, unit: str) -> None:
    """Raises: BadInput for a value that is no finite number."""
    if not math.isfinite(value):
        raise BadInput(f"{what} is {value}{_behind(unit)}; give a finite number")


def check_positive(what: str, value: float, unit: str) -> None:
    """Raises: BadInput for a value that is not positive and finite."""
    if not (value > 0 and math.isfinite(value)):
        raise BadInput(f"{what} is {value:g}{_behind(unit)}; it must be positive and finite")


def check_not_negative(what: str, value: float, unit: str) -> None:
    """Raises: BadInput for a value that is negative or not finite."""
    if not (value >= 0 and math.isfinite(value)):
        raise BadInput(f"{what} is {value:g}{_behind(unit)}; it must be finite and not negative")


def check_seed(what: str, value: int) -> None:
    """Raises: BadInput for a seed below zero, which a random generator does not take."""
    if value < 0:
        raise BadInput(f"{what} is {value}; give a whole number that is not negative")


def check_sines(what: str, count: float) -> None:
    """Raises: BadInput for more sines than a signal can be made of."""
    if count > MOST_SINES:
        raise BadInput(f"{what}: {count:g} sines are too many to add up; give {MOST_SINES:,} at most")


def _behind(unit: str) -> str:
    return f" {unit}" if unit else ""
