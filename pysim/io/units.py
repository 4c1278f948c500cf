"""Units that test benches write and people read, in SI. Everything behind pysim.io is in SI units, "1" or "%"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches

from pysim.types import SI, SYNONYMS, UNITS, MeasuredSignal, in_si

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
    unit, factor, _ = in_si(signal.unit)
    noise, resolution = (None if v is None else factor * v for v in (signal.noise, signal.resolution))
    return replace(signal, unit=unit, noise=noise, resolution=resolution)


@dataclass(frozen=True)
class Scale:
    """How the numbers of a file become those of a signal in SI: gain * number + zero.

    Args:
        unit: SI.
        gain: SI units per one in the file.
        zero: what a zero in the file is, in `unit`.
    """

    unit: str
    gain: float
    zero: float = 0.0

    @classmethod
    def of(cls, unit: str, factor: float = 1.0, offset: float = 0.0) -> Scale:
        """Of a file whose numbers are in `unit` once they are multiplied by the factor and the offset is added."""
        si, many, zero = in_si(unit)
        return cls(si, many * factor, many * offset + zero)

    def si(self, number: float) -> float:
        """The signal where the file has this number."""
        return self.gain * number + self.zero if self.zero else self.gain * number


def unit_cure(unit: str, among: Sequence[str] = UNITS) -> str:
    """What to write in place of a unit that is not known."""
    small = {one.casefold(): one for one in reversed(among)}
    near = [small[one] for one in get_close_matches(unit.casefold(), list(small), n=2)]
    if near:
        return f"did you mean {' or '.join(near)}? docs/data.md lists all"
    return f"use one of {', '.join(one for one in among if one not in SYNONYMS)}"
