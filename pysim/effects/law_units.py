"""Units of a law: those that its parameters must have, so that it gives what its slot takes, and quotients of two."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from fractions import Fraction

from fmu_build.text.expressions import Tree
from pysim.effects.law import Dimension, dimension, dimension_words, joined, unit_of

_PARTS = 1000  # of one, which a power has at the most; the rest is rounding


def parameter_units(equations: Sequence[tuple[str, Tree]], units: Mapping[str, str | None]) -> dict[str, str]:
    """Name -> unit of all that has none yet; none of Modelica's where the law needs a broken power.

    What the equations leave open is a plain number, or is in a unit that they name, so that most units have whole
    powers and are such units: p_n of `Q_n*sqrt(p/p_n)` is in Pa.

    Args:
        equations: what each gives, and its right-hand side.
        units: of what the slot has; None for one that is open.
    """
    names, seen = dict[str, None](), list[Dimension]([{}])
    rows, wishes = list[Dimension](), list[Dimension]()  # each is a plain number; wishes count where nothing else does

    def named(name: str) -> Dimension | None:
        if name not in units:
            names[f"?{name}"] = None  # beside the base units
            return {f"?{name}": 1.0}
        unit = units[name]
        if unit is not None:
            seen.append(dimension(unit))
        return None if unit is None else seen[-1]

    def alike(function: str, own: Sequence[Dimension | None]) -> None:
        known = [one for one in own if one is not None]
        rows.extend(joined(one, known[0], -1.0) for one in known[1:])
        if None in own:  # beside a number as it is written, as in 1 + k*x
            wishes.extend(known[:1])

    for gives, tree in equations:
        with suppress(ValueError):  # who checks the law says what it is, and where
            alike("=", [unit_of(tree, named, alike), named(gives)])
    solved: dict[str, Dimension] = {}  # name -> powers of others
    for row in [*reversed(rows), *wishes]:  # an equation goes before its parts
        left = _with(row, solved)
        name = next((one for one in names if left.get(one)), None)
        if name is not None:  # it is new, and contradicts nothing
            own = {name: joined({}, {one: power for one, power in left.items() if one != name}, -1 / left[name])}
            solved = {one: _with(powers, own) for one, powers in solved.items()} | own
    chosen: dict[str, Dimension] = {name: {} for name in names if name not in solved}

    def merit(name: str, unit: Dimension) -> tuple[int, int]:
        found = [_with(solved.get(one, {one: 1.0}), {**chosen, name: unit}) for one in names]
        whole = [one for one in found if all(power.is_integer() for power in one.values())]
        return len(whole), sum(one in seen for one in found)

    for name in reversed(chosen):
        chosen[name] = max(seen, key=lambda unit: merit(name, unit))
    return {name[1:]: dimension_words(_with(solved.get(name, {name: 1.0}), chosen)) for name in names}


def _with(powers: Dimension, known: Mapping[str, Dimension]) -> Dimension:
    """Powers of names and units, with those of others in place of some names."""
    found = {one: power for one, power in powers.items() if one not in known}
    for name, power in powers.items():
        found = joined(found, known.get(name, {}), power)
    return {
        one: rounded for one, power in found.items() if (rounded := float(Fraction(power).limit_denominator(_PARTS)))
    }


def quotient(unit: str, by: str, power: int = 1) -> str:
    """Quotient of a unit and a power of another as Modelica writes it: "N" by "m/s" is "N.s/m"."""
    powers: dict[str, int] = {}
    for text, sign in ((unit, 1), (by, -power)):
        above, _, below = text.partition("/")
        for part, side in ((above, sign), (below.strip("()"), -sign)):
            for symbol, exponent in re.findall(r"([A-Za-z%]+)(-?\d*)", part):
                powers[symbol] = powers.get(symbol, 0) + side * int(exponent or 1)
    over, under = (
        [symbol + (f"{side * n}" if side * n > 1 else "") for symbol, n in powers.items() if side * n > 0]
        for side in (1, -1)
    )
    divided = f"({'.'.join(under)})" if len(under) > 1 else "".join(under)
    return ".".join(over or ["1"]) + (f"/{divided}" if under else "")
