"""Unit strings as Modelica writes them ("kg.m2", "m3/s", "1/(Pa.s)", "l/min") in terms of the SI base units."""

import math
import re
from dataclasses import dataclass, replace

BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")  # those of the FMI standard, in its order


@dataclass(frozen=True)
class Unit:
    """A value in this unit is `factor * value + offset` in SI base units with these exponents.

    Args:
        exponents: (8,) in the order of BASE_UNITS.
        turns: how many of the angles are whole turns, as the one of rev or rpm is.
        cycles: how many cycles are counted that the exponents do not show, as the one of Hz.
    """

    exponents: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0
    turns: int = 0
    cycles: int = 0

    def to_power(self, power: int) -> "Unit":
        exponents = tuple(power * e for e in self.exponents)
        return Unit(exponents, self.factor**power, turns=power * self.turns, cycles=power * self.cycles)

    def times(self, other: "Unit") -> "Unit":
        return Unit(
            tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True)),
            self.factor * other.factor,
            turns=self.turns + other.turns,
            cycles=self.cycles + other.cycles,
        )

    def with_angles(self) -> "Unit":
        """A cycle as an angle of 2 pi: Hz as rad/s."""
        return self._with_more_angle(self.cycles)

    def with_counts(self) -> "Unit":
        """A turn as one of a number: rev/min as 1/min."""
        return self._with_more_angle(-self.turns)

    def _with_more_angle(self, power: int) -> "Unit":
        *others, angle = self.exponents
        return replace(self, exponents=(*others, angle + power), factor=self.factor * (2 * math.pi) ** power)


def _unit(factor: float = 1.0, *, turns: int = 0, cycles: int = 0, **exponents: int) -> Unit:
    return Unit(tuple(exponents.get(base, 0) for base in BASE_UNITS), factor, turns=turns, cycles=cycles)


ONE = _unit()
_PREFIXES = {
    **{"Y": 1e24, "Z": 1e21, "E": 1e18, "P": 1e15, "T": 1e12, "G": 1e9, "M": 1e6, "k": 1e3, "h": 1e2, "da": 1e1},
    **{"d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "f": 1e-15, "a": 1e-18},
}
_PREFIXED = {
    **{base: _unit(**{base: 1}) for base in BASE_UNITS if base != "kg"},
    "g": _unit(1e-3, kg=1),
    "sr": _unit(rad=2),
    "Hz": _unit(s=-1, cycles=1),
    "Bq": _unit(s=-1),
    "N": _unit(kg=1, m=1, s=-2),
    "Pa": _unit(kg=1, m=-1, s=-2),
    "bar": _unit(1e5, kg=1, m=-1, s=-2),
    "J": _unit(kg=1, m=2, s=-2),
    "eV": _unit(1.602176634e-19, kg=1, m=2, s=-2),
    "W": _unit(kg=1, m=2, s=-3),
    "VA": _unit(kg=1, m=2, s=-3),
    "var": _unit(kg=1, m=2, s=-3),
    "V": _unit(kg=1, m=2, s=-3, A=-1),
    "Ohm": _unit(kg=1, m=2, s=-3, A=-2),
    "S": _unit(kg=-1, m=-2, s=3, A=2),
    "C": _unit(s=1, A=1),
    "F": _unit(kg=-1, m=-2, s=4, A=2),
    "H": _unit(kg=1, m=2, s=-2, A=-2),
    "Wb": _unit(kg=1, m=2, s=-2, A=-1),
    "T": _unit(kg=1, s=-2, A=-1),
    "lm": _unit(cd=1, rad=2),
    "lx": _unit(cd=1, m=-2, rad=2),
    "Gy": _unit(m=2, s=-2),
    "Sv": _unit(m=2, s=-2),
    "kat": _unit(mol=1, s=-1),
    "l": _unit(1e-3, m=3),
    "L": _unit(1e-3, m=3),
    "P": _unit(1e-1, kg=1, m=-1, s=-1),  # poise
    "St": _unit(1e-4, m=2, s=-1),  # stokes
}
_UNPREFIXED = {
    "1": ONE,
    "%": _unit(1e-2),
    "t": _unit(1e3, kg=1),  # with the prefixes in use alone: "ft" and "at" are no tonnes
    "kt": _unit(1e6, kg=1),
    "Mt": _unit(1e9, kg=1),
    "Gt": _unit(1e12, kg=1),
    "min": _unit(60.0, s=1),
    "h": _unit(3600.0, s=1),
    "d": _unit(86400.0, s=1),
    "deg": _unit(math.pi / 180, rad=1),
    "rev": _unit(2 * math.pi, rad=1, turns=1),
    "r": _unit(2 * math.pi, rad=1, turns=1),
    "rpm": _unit(2 * math.pi / 60, rad=1, s=-1, turns=1),
    "degC": Unit(_unit(K=1).exponents, 1.0, 273.15),
    "degF": Unit(_unit(K=1).exponents, 5 / 9, 459.67 * 5 / 9),
    "atm": _unit(101325.0, kg=1, m=-1, s=-2),
    "in": _unit(0.0254, m=1),
    "ft": _unit(0.3048, m=1),
    "psi": _unit(6894.757293168361, kg=1, m=-1, s=-2),
}

_FACTOR = re.compile(r"(?P<symbol>1|%|[A-Za-z]+?)\^?(?P<exponent>[+-]?\d+)?")


def parse_unit(text: str) -> Unit | None:
    """What the unit string says, or None where it is not one we know.

    Grammar (Modelica specification, unit expressions): factors joined by ".", one "/" before one factor or a whole
    expression in brackets, which may stand above too; a factor is a symbol with an SI prefix and an integer exponent.
    """
    plain = _UNPREFIXED.get(text)
    if plain is not None:
        return plain
    above, below = _divided(text)
    numerator = _group(above)
    if numerator is None or below is None:
        return numerator
    denominator = None if "." in below and not below.startswith("(") else _group(below)
    return None if denominator is None else numerator.times(denominator.to_power(-1))


def _divided(text: str) -> tuple[str, str | None]:
    """What stands above and below the "/" outside of brackets; None where there is none."""
    depth = 0
    for k, sign in enumerate(text):
        depth += (sign == "(") - (sign == ")")
        if sign == "/" and depth == 0:
            return text[:k], text[k + 1 :]
    return text, None


def _group(text: str) -> Unit | None:
    if text.startswith("(") and text.endswith(")"):
        return parse_unit(text[1:-1])
    result = ONE
    for part in text.split("."):
        factor = _factor(part)
        if factor is None:
            return None
        result = result.times(factor)
    return result


def _factor(text: str) -> Unit | None:
    match = _FACTOR.fullmatch(text)
    if match is None:
        return None
    unit = _symbol(match["symbol"])
    return None if unit is None else unit.to_power(int(match["exponent"] or 1))


def _symbol(symbol: str) -> Unit | None:
    """A whole symbol goes before a prefixed one: "min" is a minute, "cd" a candela, "Pa" a pascal."""
    for known in (_UNPREFIXED, _PREFIXED):
        if symbol in known:
            return known[symbol]
    for length in (1, 2):
        prefix, rest = symbol[:length], symbol[length:]
        if prefix in _PREFIXES and rest in _PREFIXED:
            unit = _PREFIXED[rest]
            return replace(unit, factor=unit.factor * _PREFIXES[prefix])
    return None


def conversion(unit: Unit, display: Unit) -> tuple[float, float] | None:
    """(factor, offset) such that a value in `unit` is `factor * value + offset` in `display`.

    Hz against rad/s is a matter of angles, 1/s against rev/min one of counts; 1/s against rad/s may be either.

    Returns:
        None where they measure different quantities, or it is not known whether angles or cycles are counted.
    """
    for seen in (Unit.with_angles, Unit.with_counts):
        one, other = seen(unit), seen(display)
        if one.exponents == other.exponents:
            return _tidy(one.factor / other.factor), _tidy((one.offset - other.offset) / other.factor)
    return None


def _tidy(value: float) -> float:
    """Without the last digit's rounding: 1e-05, not 1.0000000000000001e-05."""
    return float(f"{value:.15g}")
