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


def shown_point(offset: float, amplitude: float, unit: str, command: str = "") -> str:
    """What a command swings around and how far, both in its SI unit: "offset 25 %, amplitude 10 %".

    Args:
        command: its name, to stand ahead; none where there is but one.
    """
    of = f"{command} at " if command else ""
    return f"{of}offset {shown_value(offset, unit)}, amplitude {shown_value(amplitude, unit)}"


@dataclass(frozen=True)
class Scale:
    """How numbers in one unit become those in another: gain * number + zero.

    Args:
        unit: the other one.
        gain: how many of it each is.
        zero: where zero lies in it.
    """

    unit: str
    gain: float
    zero: float = 0.0

    @classmethod
    def of(cls, unit: str, factor: float = 1.0, offset: float = 0.0) -> Scale:
        """To SI, of numbers that are in `unit` once they are multiplied by the factor and the offset is added."""
        si, many, zero = in_si(unit)
        return cls(si, many * factor, many * offset + zero)

    def number(self, number: float) -> float:
        """A number in the other unit."""
        return self.gain * number + self.zero if self.zero else self.gain * number

    def signal(self, signal: MeasuredSignal) -> MeasuredSignal:
        """A signal in the other unit, its noise and resolution too."""
        noise, resolution = (None if v is None else self.gain * v for v in (signal.noise, signal.resolution))
        return replace(signal, unit=self.unit, noise=noise, resolution=resolution)


def signal_in_si(signal: MeasuredSignal) -> MeasuredSignal:
    """A signal that was described in the unit of its files, in SI."""
    return Scale.of(signal.unit).signal(signal)


def unit_cure(unit: str, among: Sequence[str] = UNITS) -> str:
    """What to write in place of a unit that is not known."""
    small = {one.casefold(): one for one in reversed(among)}
    near = [small[one] for one in get_close_matches(unit.casefold(), list(small), n=2)]
    if near:
        return f"did you mean {' or '.join(near)}? pysim.types.UNITS lists all"
    return f"use one of {', '.join(one for one in among if one not in SYNONYMS)}"
