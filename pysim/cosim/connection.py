"""A wire from an output to an input, and whether their units agree."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pysim.io import SI
from pysim.types import BadInput

# Two factors that are the same number, written with fewer digits.
_SAME_FACTOR = 1e-6


@dataclass(frozen=True)
class Connection:
    """input = factor * output.

    Args:
        source: "member.output".
        target: "member.input".
        factor: target's unit over source's; None where both have the same. A negative one turns the sign round. Between
            units of different kinds it is taken as what you know of them.
    Raises:
        BadInput: a factor of zero, or one that is no number.
    """

    source: str
    target: str
    factor: float | None = None

    def __post_init__(self) -> None:
        if self.factor is not None and not (math.isfinite(self.factor) and self.factor != 0):
            raise BadInput(f"connection {self}: the factor is {self.factor}; give a finite one that is not zero")

    def __str__(self) -> str:
        return f"{self.source} -> {self.target}"

    @property
    def gain(self) -> float:
        """The factor as a number."""
        return 1.0 if self.factor is None else self.factor

    def check_units(self, source: str, target: str) -> None:
        """Check the factor against the units of both ends.

        Raises:
            BadInput: units that differ without the factor between them.
        """
        needed = conversion(source, target)
        if self.factor is None:
            if source != target and needed != 1.0:
                cure = (
                    "connect another, or give the factor you know" if needed is None else f"give factor={needed:.12g}"
                )
                raise BadInput(f"connection {self}: the output is in {source!r}, the input in {target!r}; {cure}")
        elif (
            needed is not None and source != target and not math.isclose(abs(self.factor), needed, rel_tol=_SAME_FACTOR)
        ):
            raise BadInput(
                f"connection {self}: from {source!r} to {target!r} the factor is {needed:.12g}, not {self.factor:g}; "
                f"give factor={needed:.12g}"
            )


def conversion(source: str, target: str) -> float | None:
    """How many of the target unit one of the source unit is; None where they are of different kinds or unknown."""
    if {source, target} == {"1", "%"}:
        return 100.0 if target == "%" else 0.01
    if source == target or source not in SI or target not in SI or SI[source][0] != SI[target][0]:
        return 1.0 if source == target else None
    return SI[source][1] / SI[target][1]
