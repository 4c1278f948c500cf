"""Units that are not in our table, asked of pint where that is installed."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any

from pysim.io.named_columns import optional_package
from pysim.io.units import Scale, unit_cure
from pysim.types import UNITS, BadInput

EXTRA = "hydraulic-test-bench[data]"
# Units inside pysim -> the same in base units as pint writes them. Energy comes ahead of torque, which has the same.
_INSIDE: Mapping[str, str] = MappingProxyType(
    {
        **{u: u for u in ("s", "m", "rad", "kg", "K", "A", "rad/s", "rad/s**2", "m/s", "kg/s", "m/s**2")},
        **{"1": "", "Pa": "kg/m/s**2", "Pa.s": "kg/m/s", "Pa/s": "kg/m/s**3", "N": "kg*m/s**2", "N/m": "kg/s**2"},
        **{"N.s/m": "kg/s", "J": "kg*m**2/s**2", "W": "kg*m**2/s**3", "V": "kg*m**2/s**3/A", "V/s": "kg*m**2/s**4/A"},
        **{"m2": "m**2", "m3": "m**3", "m3/s": "m**3/s", "m2/s": "m**2/s", "kg/m3": "kg/m**3", "1/s": "1/s"},
    }
)


def known_unit(unit: str) -> bool:
    """Whether our table has it."""
    return unit in UNITS


def scale_of(unit: str, wanted_by: str) -> Scale:
    """How numbers in a unit become those in SI.

    Args:
        wanted_by: what is in that unit, for messages.
    Raises:
        BadInput: nobody knows the unit, or it takes pint and that is not installed.
    """
    if unit in UNITS:
        return Scale.of(unit)
    try:
        pint = optional_package("pint", "", "")
    except BadInput as error:
        raise BadInput(
            f"{wanted_by}: the unit {unit!r} is not in our table ({unit_cure(unit)}); "
            f'with pint more are known: pip install "{EXTRA}"'
        ) from error
    return _asked(pint, unit, wanted_by)


def _asked(pint: Any, unit: str, wanted_by: str) -> Scale:
    """What pint says of it."""
    ask = _registry(pint)
    try:
        one, two = (ask.Quantity(size, ask.Unit(unit)).to_base_units() for size in (1.0, 2.0))
        inside = next((ours for ours, base in _INSIDE.items() if ask.Unit(base) == one.units), None)
    except Exception as error:  # whatever its parser raises over a text that is no unit
        raise BadInput(f"{wanted_by}: {unit!r} is no unit; {unit_cure(unit)}") from error
    if inside is None:
        raise BadInput(f"{wanted_by}: {unit!r} is {one.units:~} in SI, which is not used here; {unit_cure(unit)}")
    if inside == "J" and len(dict(ask.Unit(unit)._units)) > 1:
        inside = "N.m"  # lbf*ft, and not BTU
    gain = float(two.magnitude - one.magnitude)
    return Scale(inside.replace("**", ""), gain, float(one.magnitude) - gain)


@cache
def _registry(pint: Any) -> Any:
    return pint.UnitRegistry()
