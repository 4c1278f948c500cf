"""Units that test benches write and people read, in SI. Everything behind pysim.io is in SI units, "1" or "%"."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from pysim.types import MeasuredSignal

# unit -> SI unit and how many of them it is; "%" stays what it is
SI: Mapping[str, tuple[str, float]] = MappingProxyType(
    {unit: (unit, 1.0) for unit in ("1", "%", "%/s", "s", "Hz", "rad", "rad/s", "m", "m/s", "m2", "m3", "m3/s")}
    | {unit: (unit, 1.0) for unit in ("Pa", "Pa/s", "N", "N.m", "kg", "V", "V/s", "A", "W")}
    | {
        "ms": ("s", 1e-3),
        "deg": ("rad", math.pi / 180),
        "deg/s": ("rad/s", math.pi / 180),
        "rpm": ("rad/s", math.pi / 30),
        "rev/min": ("rad/s", math.pi / 30),
        "1/min": ("rad/s", math.pi / 30),
        "mm": ("m", 1e-3),
        "mm/s": ("m/s", 1e-3),
        "mm2": ("m2", 1e-6),
        "cm2": ("m2", 1e-4),
        "cm3": ("m3", 1e-6),
        "l": ("m3", 1e-3),
        "l/min": ("m3/s", 1e-3 / 60),
        "kPa": ("Pa", 1e3),
        "MPa": ("Pa", 1e6),
        "bar": ("Pa", 1e5),
        "bar/s": ("Pa/s", 1e5),
        "kN": ("N", 1e3),
        "kN.m": ("N.m", 1e3),
        "mV": ("V", 1e-3),
        "mA": ("A", 1e-3),
        "kW": ("W", 1e3),
    }
)

# What is read in place of an SI unit, in every picture; all others are shown as they are
_READ = {SI[unit][0]: (unit, 1 / SI[unit][1]) for unit in ("bar", "mm", "mm/s", "l/min", "deg", "rpm")}


def shown_unit(unit: str) -> tuple[str, float]:
    """The unit that people read in place of an SI unit, "-" in place of "1", and the factor to it."""
    return _READ.get(unit, ("-" if unit == "1" else unit, 1.0))


def shown_value(value: float, unit: str, form: str = "g") -> str:
    """A number given in an SI unit as people read it, with its unit where it has one: "100 bar", "0.5"."""
    shown, factor = shown_unit(unit)
    return f"{factor * value:{form}} {'' if shown == '-' else shown}".rstrip()


def signal_in_si(signal: MeasuredSignal) -> MeasuredSignal:
    """A signal that was described in the unit of its files, with unit, noise and resolution in SI."""
    unit, factor = SI[signal.unit]
    noise, resolution = (None if v is None else factor * v for v in (signal.noise, signal.resolution))
    return replace(signal, unit=unit, noise=noise, resolution=resolution)
