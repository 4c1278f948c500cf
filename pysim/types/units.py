"""Units that test benches and models write, in SI."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

# SI unit -> units of the same quantity and how many SI units each is; "%" stays what it is. A speed may be told in
# 1/min, and what is in 1/s is a rate of anything.
_KINDS: Mapping[str, Mapping[str, float]] = {
    "1": {},
    "%": {},
    "%/s": {},
    "s": {"ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0},
    "Hz": {"kHz": 1e3},
    "1/s": {},
    "rad": {"deg": math.pi / 180},
    "rad/s": {"deg/s": math.pi / 180, "rpm": math.pi / 30, "rev/min": math.pi / 30, "1/min": math.pi / 30},
    "rad/s2": {"deg/s2": math.pi / 180},
    "m": {"mm": 1e-3, "cm": 1e-2, "um": 1e-6, "in": 0.0254},
    "m/s": {"mm/s": 1e-3, "m/min": 1 / 60, "km/h": 1 / 3.6},
    "m/s2": {"mm/s2": 1e-3},
    "m2": {"mm2": 1e-6, "cm2": 1e-4},
    "m3": {"cm3": 1e-6, "dm3": 1e-3, "l": 1e-3, "ml": 1e-6},
    "m3/s": {"l/min": 1e-3 / 60, "l/s": 1e-3, "l/h": 1e-3 / 3600, "m3/h": 1 / 3600, "cm3/s": 1e-6},
    "m2/s": {"mm2/s": 1e-6, "cSt": 1e-6},
    "Pa": {"hPa": 1e2, "kPa": 1e3, "MPa": 1e6, "mbar": 1e2, "bar": 1e5, "psi": 6894.757293168361},
    "Pa/s": {"bar/s": 1e5},
    "Pa.s": {"mPa.s": 1e-3},
    "N": {"kN": 1e3},
    "N.m": {"kN.m": 1e3},
    "N/m": {"N/mm": 1e3},
    "N.s/m": {},
    "kg": {},
    "kg/s": {"kg/min": 1 / 60, "kg/h": 1 / 3600},
    "kg/m3": {},
    "K": {},
    "V": {"mV": 1e-3},
    "V/s": {},
    "A": {"mA": 1e-3},
    "W": {"kW": 1e3},
    "J": {"kJ": 1e3},
}

# unit with a zero of its own -> SI unit, how many of them it is, and where its zero lies in that
_ZEROS = {"degC": ("K", 1.0, 273.15), "degF": ("K", 5 / 9, 459.67 * 5 / 9)}

# what is said in place of one of these
SYNONYMS: Mapping[str, str] = MappingProxyType(
    {
        **{"-": "1", "°": "deg", "°/s": "deg/s", "°/s²": "deg/s2", "rad/s²": "rad/s2"},
        **{"U/min": "rpm", "µs": "us", "μs": "us", "µm": "um", "μm": "um"},
        **{"m/s²": "m/s2", "mm/s²": "mm/s2", "m/s^2": "m/s2"},
        **{"m²": "m2", "mm²": "mm2", "cm²": "cm2", "m³": "m3", "cm³": "cm3", "ccm": "cm3", "L": "l", "m³/s": "m3/s"},
        **{"m³/h": "m3/h", "L/min": "l/min", "lpm": "l/min", "L/s": "l/s", "L/h": "l/h", "mm²/s": "mm2/s"},
        **{"Nm": "N.m", "N*m": "N.m", "kNm": "kN.m", "Ns/m": "N.s/m", "Pas": "Pa.s", "mPas": "mPa.s", "kg/m³": "kg/m3"},
        **{"°C": "degC", "°F": "degF"},
        **{"sec": "s", "secs": "s", "second": "s", "seconds": "s", "msec": "ms", "minutes": "min", "hours": "h"},
    }
)

_PLAIN = {unit: (si, many) for si, kin in _KINDS.items() for unit, many in {si: 1.0, **kin}.items()}

# unit -> SI unit and how many of them it is; without those that have a zero of their own
SI: Mapping[str, tuple[str, float]] = MappingProxyType(
    _PLAIN | {word: _PLAIN[unit] for word, unit in SYNONYMS.items() if unit in _PLAIN}
)

# unit of time -> how many s it is
SECONDS: Mapping[str, float] = MappingProxyType({unit: many for unit, (si, many) in SI.items() if si == "s"})

# every unit that is known
UNITS = (*SI, *_ZEROS, *(word for word, unit in SYNONYMS.items() if unit in _ZEROS))


def in_si(unit: str) -> tuple[str, float, float]:
    """SI unit of one of UNITS, how many of them it is, and where its zero lies in that."""
    zero = _ZEROS.get(SYNONYMS.get(unit, unit))
    return zero if zero is not None else (*SI[unit], 0.0)


def conversion(source: str, target: str) -> tuple[float, float] | None:
    """Factor and offset from one unit to another: target = factor * source + offset.

    Returns:
        None where they are of different quantities, or one of them is not known.
    """
    if source == target:
        return 1.0, 0.0
    if source not in UNITS or target not in UNITS:
        return None
    (one, factor, zero), (other, per, below) = in_si(source), in_si(target)
    return (factor / per, (zero - below) / per) if one == other else None
