"""A wire from an output to an input, and whether their units agree."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real

from pysim.types import BadInput, conversion

# Two factors, or offsets, that are the same number, written with fewer digits.
_SAME = 1e-6


@dataclass(frozen=True)
class Connection:
    """input = factor * output + offset.

    Args:
        source: "member.output".
        target: "member.input".
        factor: target's unit over source's; None where both have the same. A negative one turns the sign round. Between
            units of different kinds it is taken as what you know of them.
        offset: in the target's unit, as between degC and K, or between gauge and absolute pressure.
    Raises:
        BadInput: a factor of zero, or a number that is not finite.
    """

    source: str
    target: str
    factor: float | None = None
    offset: float = 0.0

    def __post_init__(self) -> None:
        if self.factor is not None and not (_finite(self.factor) and self.factor != 0):
            raise BadInput(f"connection {self}: the factor is {self.factor}; give a finite one that is not zero")
        if not _finite(self.offset):
            raise BadInput(f"connection {self}: the offset is {self.offset}; give a finite one")

    def __str__(self) -> str:
        return f"{self.source} -> {self.target}"

    @property
    def gain(self) -> float:
        """The factor as a number."""
        return 1.0 if self.factor is None else self.factor

    def check_units(self, source: str, target: str) -> None:
        """Check factor and offset against the units of both ends.

        Raises:
            BadInput: units that differ without the factor and the offset between them.
        """
        if source == target:
            return
        needed = signal_conversion(source, target)
        if needed is None:
            if self.factor is None:
                self._refuse(source, target, "connect another, or give the factor you know")
        elif self.factor is None and not self.offset and needed != (1.0, 0.0):
            self._refuse(source, target, _cure(*needed))
        elif not self._is(*needed):
            raise BadInput(
                f"connection {self}: from {source!r} to {target!r} the factor is {needed[0]:.12g}"
                f"{f', the offset {needed[1]:.12g}' if needed[1] else ''}, not {self.gain:g}"
                f"{f' and {self.offset:g}' if needed[1] else ''}; {_cure(*needed)}"
            )

    def _is(self, factor: float, offset: float) -> bool:
        """Whether this converts so. Where no offset is needed, the sign may be turned and any offset added."""
        if offset == 0.0:
            return math.isclose(abs(self.gain), factor, rel_tol=_SAME)
        return math.isclose(self.gain, factor, rel_tol=_SAME) and math.isclose(self.offset, offset, rel_tol=_SAME)

    def _refuse(self, source: str, target: str, cure: str) -> None:
        raise BadInput(f"connection {self}: the output is in {source!r}, the input in {target!r}; {cure}")


def signal_conversion(source: str, target: str) -> tuple[float, float] | None:
    """Factor and offset from one unit to another, "1" and "%" included; None for different kinds or unknown ones."""
    if {source, target} == {"1", "%"}:
        return (100.0 if target == "%" else 0.01), 0.0
    return conversion(source, target)


def _cure(factor: float, offset: float) -> str:
    parts = [f"factor={factor:.12g}"] if factor != 1.0 or not offset else []
    return f"give {', '.join([*parts, *([f'offset={offset:.12g}'] if offset else [])])}"


def _finite(value: object) -> bool:
    return isinstance(value, Real) and math.isfinite(value)
