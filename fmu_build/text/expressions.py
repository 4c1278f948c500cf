"""Expressions of Modelica text as trees, and their values.

A tree is a number, a name, or a call; an operator is a call too, of a function with the operator's name.
"""

import math
import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from fmu_build.text.tokens import Tokens, is_name, tokenise

ARRAY, IF, NEGATE = "{}", "if", "negate"
_LEVELS = (("or",), ("and",), ("<", "<=", ">", ">=", "==", "<>"), ("+", "-"), ("*", "/"))
MOST_ELEMENTS = 100_000  # elements of an array of literals; a file that asks for more is a mistake, or worse
_PAIRS = ("<=", ">=", "==", "<>")


class Misplaced(ValueError):
    """A word where another one is expected, with its offset in the text."""

    def __init__(self, message: str, at: int) -> None:
        super().__init__(message)
        self.at = at


@dataclass(frozen=True)
class Number:
    """A literal; true is 1 and false is 0."""

    value: float


@dataclass(frozen=True)
class Name:
    """A name with its dots and indices, as written without blanks: `a[2].b`."""

    name: str


@dataclass(frozen=True)
class Call:
    """A function and its arguments.

    Args:
        function: as written; "+", "<" and the like, "not", NEGATE, ARRAY of the elements, or IF of condition, value
            and what holds else.
    """

    function: str
    arguments: tuple["Tree", ...]


Tree = Number | Name | Call
Value = Any  # a float, a tuple of values, or what the given functions make of them


def parse(text: str) -> Tree:
    """The tree of an expression.

    Raises:
        Misplaced: it is none; says what stands where something else is expected.
        ValueError: an index that is no number.
    """
    reader = _Reader(tokenise(text), len(text.rstrip()))
    tree = reader.expression()
    reader.expect("")
    return tree


def names_in(tree: Tree) -> Iterator[str]:
    """All names of a tree, in written order."""
    if isinstance(tree, Name):
        yield tree.name
    elif isinstance(tree, Call):
        for argument in tree.arguments:
            yield from names_in(argument)


def evaluate(tree: Tree, value: Callable[[str], Value], functions: Mapping[str, Callable[..., Value]]) -> Value:
    """The value of a tree.

    Args:
        value: of a name; raises KeyError for one that it does not know.
        functions: all that may be called, by the names that `Call` uses.
    Raises:
        ValueError: a function that is none of these, or that does not take what it is given.
    """
    if isinstance(tree, Number):
        return tree.value
    if isinstance(tree, Name):
        return value(tree.name)
    if tree.function not in functions:
        raise ValueError(f"{tree.function} is no function that is known here")
    given = [evaluate(argument, value, functions) for argument in tree.arguments]
    try:
        return functions[tree.function](*given)
    except (TypeError, ZeroDivisionError, OverflowError) as failure:
        raise ValueError(f"{tree.function}: {failure}") from failure


def literal(text: str, known: Mapping[str, Value] = MappingProxyType({})) -> Value:
    """The number, or the tuple of numbers, that an expression of literals gives, such as `2*50e-3` or `zeros(9)`.

    Args:
        known: values of the names that it may hold; any constant called pi is known.
    Raises:
        ValueError: it holds something else.
    """

    def value(name: str) -> Value:
        if name in known:
            return known[name]
        if name.rpartition(".")[2] == "pi":
            return math.pi
        raise ValueError(f"{name} is no number")

    try:
        return evaluate(parse(text), value, _LITERALS)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


class _Reader:
    def __init__(self, tokens: Tokens, end: int) -> None:
        joined = _joined(tokens)
        self._words, self._starts = [word for word, _ in joined], [*(start for _, start in joined), end]
        self._at = 0

    def _peek(self) -> str:
        return self._words[self._at] if self._at < len(self._words) else ""

    def _took(self, *words: str) -> str:
        """The word at hand, which is passed, if it is one of these."""
        word = self._peek()
        self._at += bool(word) and word in words
        return word if word in words else ""

    def _misplaced(self, wanted: str) -> Misplaced:
        word, place = self._peek(), self._starts[min(self._at, len(self._starts) - 1)]
        power = "; a power is written with ^" if self._at and word == "*" == self._words[self._at - 1] else ""
        wanted = wanted if word or wanted not in (",", ")") else "a closing bracket"
        return Misplaced(f"{word or 'the end'} stands where {wanted} is expected{power}", place)

    def expect(self, word: str) -> None:
        if self._peek() != word:
            raise self._misplaced(word or "the end")
        self._at += 1

    def expression(self) -> Tree:
        if not self._took("if"):
            return self._binary(0)
        condition = self.expression()
        self.expect("then")
        value = self.expression()
        if self._peek() == "elseif":
            self._words[self._at] = "if"
        else:
            self.expect("else")
        return Call(IF, (condition, value, self.expression()))

    def _binary(self, level: int) -> Tree:
        if level == len(_LEVELS):
            return self._power()
        if _LEVELS[level][0] == "<" and self._took("not"):
            return Call("not", (self._binary(level),))
        sign = self._took("+", "-") if "+" in _LEVELS[level] else ""
        tree = self._binary(level + 1)
        tree = Call(NEGATE, (tree,)) if sign == "-" else tree
        while found := self._took(*_LEVELS[level]):
            tree = Call(found, (tree, self._binary(level + 1)))
        return tree

    def _power(self) -> Tree:
        if self._took("-"):  # behind another operator, which Modelica would want in brackets
            return Call(NEGATE, (self._power(),))
        base = self._primary()
        return Call("^", (base, self._power())) if self._took("^") else base

    def _primary(self) -> Tree:
        word = self._peek()
        if word[:1].isdigit():
            self._at += 1
            return Number(float(word))
        if self._took("true", "false"):
            return Number(float(word == "true"))
        if self._took("("):
            tree = self.expression()
            self.expect(")")
            return tree
        if self._took("{"):
            return Call(ARRAY, self._list("}"))
        if not is_name(word) or word in ("then", "else", "elseif", "and", "or", "not", "if"):
            raise self._misplaced("a value")
        name = self._name()
        return Call(name, self._list(")")) if self._took("(") else Name(name)

    def _name(self) -> str:
        parts = [self._peek()]
        self._at += 1
        while self._peek() in (".", "["):
            if self._took("["):
                parts[-1] += f"[{self._peek()}]"
                if not self._peek().isdigit():
                    raise ValueError(f"{parts[-1]}: an index that is no number is not known here")
                self._at += 1
                self.expect("]")
            else:
                self._at += 1
                parts.append(self._peek())
                self._at += 1
        return ".".join(parts)

    def _list(self, last: str) -> tuple[Tree, ...]:
        found: list[Tree] = []
        while not self._took(last):
            if found:
                self.expect(",")
            found.append(self.expression())
        return tuple(found)


def _joined(tokens: Tokens) -> list[tuple[str, int]]:
    """Words with their places, signs of two letters as one."""
    found: list[tuple[str, int]] = []
    for word, start in tokens:
        if found and found[-1][0] + word in _PAIRS:
            found[-1] = found[-1][0] + word, found[-1][1]
        else:
            found.append((word, start))
    return found


def _elementwise(function: Callable[[float, float], float]) -> Callable[[Value, Value], Value]:
    def apply(a: Value, b: Value) -> Value:
        if isinstance(a, tuple) or isinstance(b, tuple):
            count = len(a) if isinstance(a, tuple) else len(b)
            both = (side if isinstance(side, tuple) else (side,) * count for side in (a, b))
            return tuple(apply(x, y) for x, y in zip(*both, strict=True))
        return function(a, b)

    return apply


def _fill(value: Value, *sizes: float) -> Value:
    if not sizes:
        raise ValueError("an array needs a size")
    _count(_length(value) * math.prod(sizes))
    for size in reversed(sizes):
        value = (value,) * _count(size)
    return value


def _length(value: Value) -> int:
    """Numbers in a value whose parts are of one size."""
    return len(value) * _length(value[0]) if isinstance(value, tuple) and value else 1


def _linspace(first: float, last: float, count: float) -> Value:
    return tuple(first + (last - first) * k / (count - 1) for k in range(_count(count)))


def _count(size: float) -> int:
    if not 0 <= size <= MOST_ELEMENTS:
        raise ValueError(f"an array of {size:g} elements is too large")
    return int(size)


def _power(base: float, exponent: float) -> float:
    found = base**exponent
    if isinstance(found, complex):
        raise ValueError(f"{base:g}^{exponent:g} is no real number")
    return float(found)


_LITERALS: Mapping[str, Callable[..., Value]] = {
    "+": _elementwise(operator.add), "-": _elementwise(operator.sub), "*": _elementwise(operator.mul),
    "/": _elementwise(operator.truediv), "^": _elementwise(_power),
    NEGATE: lambda value: _elementwise(operator.mul)(-1.0, value), ARRAY: lambda *values: values,
    "zeros": lambda *sizes: _fill(0.0, *sizes), "ones": lambda *sizes: _fill(1.0, *sizes), "fill": _fill,
    "linspace": _linspace,
}  # fmt: skip
