"""Settings of blocks that are numbers."""

from __future__ import annotations

from numbers import Real

from pysim.types import BadInput


def check_numbers(what: str, block: object, *names: str) -> None:
    """Raises: BadInput for an attribute that is no real number, as "1" or None."""
    for name in names:
        value = getattr(block, name)
        if not isinstance(value, Real) or isinstance(value, bool):
            raise BadInput(f"{what}: {name} is {value!r}; give a number")
