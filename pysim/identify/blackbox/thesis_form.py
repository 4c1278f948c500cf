"""Rows of thesis Table 4.1: five poles, no zeros, in the printed units (Eq. 4.1)."""

from __future__ import annotations

from collections.abc import Mapping

from pysim.identify.blackbox.structure import Structure
from pysim.identify.transfer_function import TransferFunction
from pysim.types import BadInput

THESIS_STRUCTURE = Structure(poles=5, zeros=0)
_UNITS = {
    "b0": 1e6,
    "a4": 1.0,
    "a3": 1.0,
    "a2": 1e3,
    "a1": 1e6,
    "a0": 1e6,
}  # units of the table's columns


def from_thesis_row(row: Mapping[str, float]) -> TransferFunction:
    """b0 / (s^5 + a4 s^4 + a3 s^3 + a2 s^2 + a1 s + a0), from the numbers b0, a4 ... a0 as printed."""
    b0, *below = (row[name] * unit for name, unit in _UNITS.items())
    return TransferFunction((b0,), (1.0, *below))


def thesis_row(function: TransferFunction) -> dict[str, float]:
    """The numbers b0, a4 ... a0 in the units of the table.

    Raises:
        BadInput: a structure other than that of Eq. 4.1.
    """
    if len(function.numerator) != 1 or len(function.denominator) != 6 or function.dead_time:
        raise BadInput("thesis row: Eq. 4.1 has five poles, no zeros and no dead time; fit with THESIS_STRUCTURE")
    lead, *below = function.denominator
    numbers = (function.numerator[0], *below)
    return {name: number / lead / unit for (name, unit), number in zip(_UNITS.items(), numbers, strict=True)}
