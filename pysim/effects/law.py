"""The law of an effect, read from its text: equations by what they give, their units, and their values with NumPy.

The text is parsed, never run: a few functions of plain names can be worked out, and all else is refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from fmu_build.text.expressions import ARRAY, IF, NEGATE, Call, Misplaced, Name, Number, Tree, evaluate, names_in, parse
from fmu_build.text.statements import Statement, statements
from fmu_build.text.tokens import Token, Tokens, depth_change, tokenise, written

_AHEAD = "equation "  # makes the text of a law statements
_PRE = "pre "  # ahead of a name: its value at the moment before
_STEEPEST = 20.0  # exponent up to which a power of numbers is one that a law would have
Equation = tuple[Tree, Tree]


@dataclass(frozen=True)
class Law:
    """Equations by what they give.

    Args:
        values: name -> expression.
        rates: name -> its derivative, and what that derivative is multiplied by.
        sampled: name -> expression and interval, of what is kept from one sample to the next.
        resets: name -> its new value, and the conditions of which one has to become true.
    """

    values: dict[str, Tree] = field(default_factory=dict)
    rates: dict[str, Equation] = field(default_factory=dict)
    sampled: dict[str, Equation] = field(default_factory=dict)
    resets: dict[str, tuple[Tree, tuple[Tree, ...]]] = field(default_factory=dict)

    def needs(self, name: str) -> set[str]:
        """Names that a name depends on, through all equations."""
        found: set[str] = set()
        queue = [name]
        while queue:
            one = queue.pop()
            trees = [self.values.get(one), *self.rates.get(one, ()), *self.sampled.get(one, ())]
            used = {n for tree in trees if tree is not None for n in names_in(tree)} - found
            found |= used
            queue += sorted(used)
        return found

    def remembers(self, name: str) -> bool:
        """Whether it depends on what was before."""
        own = {name, *self.needs(name)}
        return bool(own & {*self.rates, *self.sampled}) or any(one.startswith(_PRE) for one in own)

    def looks_back(self) -> set[str]:
        """Names whose value at the moment before some equation needs."""
        used = {name for one in self.values for name in self.needs(one)}
        return {name.removeprefix(_PRE) for name in used if name.startswith(_PRE)}


def read_law(text: str) -> Law:
    """Equations as a class writes them.

    Raises:
        Misplaced: a word where another one is expected, with its offset in the text.
        ValueError: one that cannot be worked out here; names it.
    """
    law = Law()
    try:
        for statement in statements(tokenise(_AHEAD + text)):
            _take(law, statement, _AHEAD + text)
    except RecursionError:
        raise ValueError("the law is nested too deeply; split it into several equations") from None
    return law


def _take(law: Law, statement: Statement, text: str) -> None:
    if statement.word != "when":
        _take_equation(law, statement, text)
        return
    (guard,), (branch,) = statement.conditions, statement.branches
    when = _tree(guard, text)
    for inner in branch:
        sides = _sides(inner.tokens, text)
        call = _tree(_bare(inner.tokens), text) if sides is None else None
        if sides is not None and isinstance(when, Call) and when.function == "sample" and len(when.arguments) == 2:
            name = sides[0]
            if isinstance(name, Name):
                law.sampled[name.name] = sides[1], when.arguments[1]
                continue
        if isinstance(call, Call) and call.function == "reinit" and isinstance(call.arguments[0], Name):
            is_list = isinstance(when, Call) and when.function == ARRAY
            law.resets[call.arguments[0].name] = call.arguments[1], _arguments(when) if is_list else (when,)
            continue
        raise ValueError(f"{written(text, inner.tokens)} in a when-clause cannot be worked out")


def _take_equation(law: Law, statement: Statement, text: str) -> None:
    sides = _sides(statement.tokens, text)
    match sides:
        case (Name(name), right):
            law.values[name] = right
        case (Call("der", (Name(name),)), right):
            law.rates[name] = right, Number(1.0)
        case (Call("*", (factor, Call("der", (Name(name),)))), right):
            law.rates[name] = right, factor
        case _:
            raise ValueError(f"{written(text, statement.tokens)} does not give one name; write name = expression")


def _sides(tokens: Tokens, text: str) -> Equation | None:
    """Left and right of the equation that these tokens of a text are; None for what is none."""
    depth, bare = 0, _bare(tokens)
    for k, token in enumerate(bare):
        depth += depth_change(token)
        beside = (bare[k - 1].text if k else "", bare[k + 1].text if k + 1 < len(bare) else "")
        if token.text == "=" and depth == 0 and beside[0] not in ("=", "<", ">") and beside[1] != "=":
            return _tree(bare[:k], text), _tree(bare[k + 1 :], text)
    return None


def _bare(tokens: Tokens) -> Tokens:
    return tokens[:-1] if tokens and tokens[-1].text == ";" else tokens


def _tree(tokens: tuple[Token, ...], text: str) -> Tree:
    try:
        return _with_past(parse(written(text, tokens)))
    except Misplaced as error:
        begin = tokens[0].start if tokens else len(text)
        raise Misplaced(str(error), begin + error.at - len(_AHEAD)) from None


def _with_past(tree: Tree) -> Tree:
    """`pre(x)` as a name of its own."""
    if not isinstance(tree, Call):
        return tree
    if tree.function == "pre" and len(tree.arguments) == 1 and isinstance(tree.arguments[0], Name):
        return Name(_PRE + tree.arguments[0].name)
    return Call(tree.function, tuple(_with_past(one) for one in tree.arguments))


def _arguments(tree: Tree) -> tuple[Tree, ...]:
    return tree.arguments if isinstance(tree, Call) else ()


class Moment:
    """All names of a law at one moment, or for many values at once, each worked out when it is asked for.

    Args:
        law: its equations.
        known: numbers or arrays of one shape that are given: parameters, what the slot offers, states.
        before: of the moment before, for `pre`; 0 where it says nothing.
    """

    def __init__(self, law: Law, known: Mapping[str, Any], before: Mapping[str, Any] = MappingProxyType({})) -> None:
        self._law, self._known, self._before = law, dict(known), before
        self._asked: set[str] = set()

    def __getitem__(self, name: str) -> Any:
        if name.startswith(_PRE):
            return self._before.get(name.removeprefix(_PRE), 0.0)
        if name not in self._known:
            if name not in self._law.values or name in self._asked:
                why = "depends on itself" if name in self._asked else "is given by nobody"
                raise ValueError(f"{name} {why}; write an equation {name} = expression")
            self._asked.add(name)
            self._known[name] = self.value(self._law.values[name])
        return self._known[name]

    def value(self, tree: Tree) -> Any:
        """Of an expression.

        Raises:
            ValueError: a name that nobody gives, or a function that is none of those a law may have.
        """
        try:
            with np.errstate(all="ignore"):
                return evaluate(tree, self.__getitem__, _FUNCTIONS)
        except RecursionError:
            raise ValueError("the law is nested too deeply; split it into several equations") from None


def _power(base: Any, exponent: Any) -> Any:
    if not np.max(np.abs(exponent)) <= _STEEPEST:
        raise ValueError(f"a power of {np.max(np.abs(exponent)):g} is no law")
    return np.power(np.asarray(base, float), exponent)


_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "tanh": np.tanh, "exp": np.exp, "sqrt": np.sqrt, "abs": np.abs, "max": np.maximum, "min": np.minimum, "sin": np.sin,
    "cos": np.cos, "sign": np.sign, "noEvent": lambda value: value, "smooth": lambda order, value: value,
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": _power, NEGATE: np.negative,
    "<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal, "==": np.equal, "<>": np.not_equal,
    "and": np.logical_and, "or": np.logical_or, "not": np.logical_not, IF: np.where,
}  # fmt: skip

_UNARY = (NEGATE, "not", "tanh", "exp", "sqrt", "abs", "sin", "cos", "sign", "noEvent")
ARGUMENTS = {name: 3 if name == IF else 1 if name in _UNARY else 2 for name in _FUNCTIONS}  # how many each takes

# --- units -----------------------------------------------------------------------------------------------------------

Dimension = dict[str, float]  # exponents of kg, m, s, A, K; an angle is a number
_Alike = Callable[[str, Sequence[Dimension | None]], None]
_DERIVED: Mapping[str, Dimension] = {
    "N": {"kg": 1, "m": 1, "s": -2}, "Pa": {"kg": 1, "m": -1, "s": -2}, "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3}, "%": {}, "V": {"kg": 1, "m": 2, "s": -3, "A": -1}, "Hz": {"s": -1}, "rad": {},
    **{base: {base: 1} for base in ("kg", "m", "s", "A", "K")},
}  # fmt: skip
# As people write them; any other unit is a quotient of base units.
_USUAL = ("N", "N/m", "N.s", "N.s/m", "N.s2/m2", "N/m3", "N.m", "N.m.s", "N.m.s2", "N/A", "Pa", "1/Pa", "Pa.s",
          "m3/(s.Pa)", "V", "W", "J", "W/K", "J/K")  # fmt: skip
_UNIT_FREE = ("tanh", "exp", "sin", "cos", "^")  # take numbers and give one; ^ where its exponent is no written number
_SUMS = ("+", "-", "max", "min", "<", "<=", ">", ">=", "==", "<>")
# Source: Modelica Specification 3.6, Section 19.2.
_FACTOR = r"[A-Za-zµμ°%']+(?:[+-]?\d+)?"
_FACTORS = rf"(?:1|{_FACTOR}(?:\.{_FACTOR})*)"
_UNIT = re.compile(rf"(?:{_FACTORS}|\({_FACTORS}\))?(?:/(?:{_FACTOR}|\({_FACTORS}(?:/{_FACTOR})?\)))?")


def check_unit(unit: str) -> None:
    """Refuse what Modelica cannot read as a unit; a symbol may be any.

    Raises:
        ValueError: brackets, powers or signs that no unit has.
    """
    if not _UNIT.fullmatch(unit):
        how = "write whole powers and brackets as in m3/(s.Pa), and under a root a ratio"
        raise ValueError(f"{unit} is no unit of Modelica; {how}, as in Q_n*sqrt(p/p_n) or Q_n*sqrt(p/1e5)")


def dimension(unit: str) -> Dimension:
    """Exponents of the base units in an SI unit, such as "N.s2/m2" or "1/(Pa.s)".

    Raises:
        ValueError: what Modelica cannot read, or a symbol that is no SI unit.
    """
    check_unit(unit)
    above, _, below = unit.partition("/")
    found: Dimension = {}
    for part, sign in ((above, 1), (below.strip("()"), -1)):
        for factor in filter(None, part.split(".")):
            symbol = factor.rstrip("-0123456789")
            if factor != "1" and symbol not in _DERIVED:
                raise ValueError(f"{unit} is no SI unit; write it with kg, m, s, A, K, rad, N, Pa, J, W, V and Hz")
            power = sign * int(factor[len(symbol) :] or 1) if symbol else 0
            found = joined(found, _DERIVED.get(symbol, {}), power)
    return found


def check_units(tree: Tree, units: Mapping[str, str | None]) -> Dimension | None:
    """The dimension of an expression; None where a number written in it, or a name of an open unit, may have any.

    A number is a plain factor in `2*v`, and may have any unit in a sum, a comparison, and below a quotient's line, as
    the width of `tanh(v/1e-3)`.

    Args:
        units: name -> SI unit; None for one that is open.
    Raises:
        ValueError: a sum or comparison of two quantities, a unit in tanh() and the like, or a name without a unit.
    """

    def named(name: str) -> Dimension | None:
        if name.removeprefix(_PRE) not in units:
            raise ValueError(f"{name} has no unit; the law may name {', '.join(units) or 'nothing'}")
        unit = units[name.removeprefix(_PRE)]
        return None if unit is None else dimension(unit)

    def alike(function: str, own: Sequence[Dimension | None]) -> None:
        known = [one for one in own if one is not None]
        if function in _UNIT_FREE and any(known):
            given = dimension_words(next(filter(None, known)))
            raise ValueError(f"{function} is given {given}; divide by a width of that unit")
        if any(one != known[0] for one in known):
            both = " and ".join(map(dimension_words, known))
            raise ValueError(f"{function} takes {both} together; give both the same unit")

    return unit_of(tree, named, alike)


def unit_of(tree: Tree, named: Callable[[str], Dimension | None], alike: _Alike) -> Dimension | None:
    """The dimension of an expression, as `check_units` has it.

    Args:
        named: that of a name.
        alike: called with every function, and the dimensions that have to be the same in it.
    """
    match tree:
        case Number():
            return None
        case Name(name):
            return named(name)
    own = [unit_of(argument, named, alike) for argument in tree.arguments]
    match tree.function, own:
        case ("*", [one, other]):
            return joined(one or {}, other or {}, 1) if one is not None or other is not None else None
        case ("/", [one, other]):
            return None if other is None else joined(one or {}, other, -1)
        case ("sqrt", [base]):
            return None if base is None else joined({}, base, 0.5)
        case ("^", [base, _]) if not any(names_in(tree.arguments[1])):
            exponent = Moment(Law(), {}).value(tree.arguments[1])
            _power(1.0, exponent)  # refuses what is none
            return None if base is None else joined({}, base, float(exponent))
    values = [*own, {}] if tree.function in _UNIT_FREE else own[1:] if tree.function in (IF, "smooth") else own
    alike(tree.function, values)
    is_number = tree.function in (*_UNIT_FREE, *_SUMS[4:], "and", "or", "not", "sign")
    return {} if is_number else next((one for one in values if one is not None), None)


def joined(one: Dimension, other: Dimension, power: float) -> Dimension:
    """One times a power of the other."""
    found = {base: one.get(base, 0) + power * other.get(base, 0) for base in {**one, **other}}
    return {base: exponent for base, exponent in sorted(found.items()) if exponent}


def dimension_words(found: Dimension | None) -> str:
    """A dimension as people write it; "1" where there is none, and no unit of Modelica where a power is broken."""
    found = found or {}
    words = {one: one if abs(power) == 1 else f"{one}{abs(power):g}" for one, power in found.items()}
    above, below = (".".join(words[one] for one in found if sign * found[one] > 0) for sign in (1, -1))
    plain = (above or "1") + (f"/({below})" if "." in below else below and f"/{below}")
    return next((unit for unit in _USUAL if dimension(unit) == found), plain)
