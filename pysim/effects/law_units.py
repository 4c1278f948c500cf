"""The units that the parameters of a law must have, so that it gives what its slot takes: one linear system."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from fmu_build.text.expressions import IF, NEGATE, Name, Number, Tree
from pysim.effects.law import Dimension, dimension, dimension_words

_Open = tuple[dict[str, float], Dimension]  # powers of names whose unit is not known, and what is known beside them
_PLAIN = ("tanh", "exp", "sin", "cos")  # take a number and give one
_SAME = ("abs", "noEvent", NEGATE)
_EQUAL = ("+", "-", "max", "min")
_BASES = ("A", "K", "kg", "m", "s")
_SURE = 1e-6  # of a power
# As people write them; any other unit is a product of base units.
_USUAL = ("1", "N", "N/m", "N.s/m", "N.s2/m2", "N/m3", "N.m", "N.m.s", "N.m.s2", "m", "m/s", "s", "1/s", "Pa", "m3/s",
          "m2", "A", "V", "W", "K", "J", "W/K", "J/K", "A/m", "N/A")  # fmt: skip


def parameter_units(equations: Sequence[tuple[str, Tree]], units: Mapping[str, str | None]) -> dict[str, str]:
    """Name -> unit of all that has none yet, as far as the equations determine it; "" where they do not.

    Args:
        equations: what each gives, and its right-hand side.
        units: of what the slot has; None for one that is open.
    """
    system = _System(units)
    for gives, tree in equations:
        system.same(system.of(Name(gives)), system.of(tree))
    return system.solved()


class _System:
    """Each row says that powers of unknown units, times what is known, make a plain number."""

    def __init__(self, units: Mapping[str, str | None]) -> None:
        self._units = units
        self._rows: list[_Open] = []
        self._names: dict[str, None] = {}
        self._hidden = 0

    def of(self, tree: Tree) -> _Open | None:
        """The unit of an expression; None where any will do."""
        if isinstance(tree, Number):
            return None
        if isinstance(tree, Name):
            if tree.name not in self._units:
                self._names[tree.name] = None
                return {tree.name: 1.0}, {}
            unit = self._units[tree.name]
            return None if unit is None else ({}, dimension(unit))
        own = [self.of(one) for one in tree.arguments]
        if tree.function in ("*", "/") and len(own) == 2:
            if tree.function == "/" and own[1] is None:
                return None
            if own[0] is None and own[1] is None:
                return None
            return _times(own[0] or ({}, {}), own[1] or ({}, {}), 1.0 if tree.function == "*" else -1.0)
        if tree.function == "^":
            self.same(own[1], ({}, {}))
            exponent = tree.arguments[1]
            if isinstance(exponent, Number):
                return None if own[0] is None else _times(({}, {}), own[0], exponent.value)
            self._hidden += 1  # what it is depends on the exponent's value
            return {f"{self._hidden} ^": 1.0}, {}
        if tree.function == "sqrt":
            return None if own[0] is None else _times(({}, {}), own[0], 0.5)
        if tree.function in _PLAIN:
            self.same(own[0], ({}, {}))
            return {}, {}
        if tree.function in _SAME:
            return own[-1]
        values = own[1:] if tree.function in (IF, "smooth") else own
        known = [one for one in values if one is not None]
        for one in known[1:]:
            self.same(known[0], one)
        return known[0] if known and tree.function in (*_EQUAL, IF, "smooth") else ({}, {}) if known else None

    def same(self, one: _Open | None, other: _Open | None) -> None:
        """Both have one unit."""
        if one is not None and other is not None:
            self._rows.append(_times(one, other, -1.0))

    def solved(self) -> dict[str, str]:
        """Units of the unknown names."""
        names = [*self._names, *(f"{k + 1} ^" for k in range(self._hidden))]
        if not self._names:
            return {}
        matrix = np.array([[row[0].get(name, 0.0) for name in names] for row in self._rows]).reshape(-1, len(names))
        known = np.array([[-row[1].get(base, 0.0) for base in _BASES] for row in self._rows]).reshape(-1, len(_BASES))
        inverse = np.linalg.pinv(matrix)
        powers, sure = inverse @ known, np.diag(inverse @ matrix) > 1 - _SURE
        return {name: _words(powers[k]) if sure[k] else "" for k, name in enumerate(self._names)}


def _times(one: _Open, other: _Open, power: float) -> _Open:
    def joined(a: Mapping[str, float], b: Mapping[str, float]) -> dict[str, float]:
        found = {key: a.get(key, 0.0) + power * b.get(key, 0.0) for key in {**a, **b}}
        return {key: value for key, value in found.items() if value}

    return joined(one[0], other[0]), joined(one[1], other[1])


def _words(powers: np.ndarray) -> str:
    """As people write it; "" for a broken power."""
    if np.any(np.abs(powers - np.round(powers)) > _SURE):
        return ""
    found = {base: float(power) for base, power in zip(_BASES, np.round(powers), strict=True) if abs(power) > _SURE}
    return next((unit for unit in _USUAL if dimension(unit) == found), dimension_words(found))
