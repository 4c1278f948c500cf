"""Expressions of one argument: values, derivatives, and kinks rounded so that the derivative exists."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from fmu_build.text.expressions import NEGATE, Call, Name, Number, Tree, evaluate

_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power, NEGATE: np.negative,
    "exp": np.exp, "tanh": np.tanh, "sqrt": np.sqrt,
}  # fmt: skip
_RANKS = {"+": 0, "-": 0, "*": 1, "/": 1, NEGATE: 1, "^": 2}


def value(tree: Tree, known: Mapping[str, Any]) -> Any:
    """Value of a smooth expression; `known` gives numbers or arrays by name."""
    with np.errstate(all="ignore"):
        return evaluate(tree, known.__getitem__, _FUNCTIONS)


def replaced(text: str, words: Mapping[str, str]) -> str:
    """The text with some of its names replaced: `words` maps old names to new ones."""
    return re.sub(r"[A-Za-z_]\w*", lambda found: words.get(found[0], found[0]), text)


def smooth(tree: Tree, kink: float) -> Tree:
    """The expression with kinks rounded: |z| as sqrt(z^2 + kink^2), and `sign`, `max`, `min` made of that."""
    if not isinstance(tree, Call):
        return tree
    given = tuple(smooth(one, kink) for one in tree.arguments)
    match tree.function, given:
        case "abs", (z,):
            return _size(z, kink)
        case "sign", (z,):
            return Call("/", (z, _size(z, kink)))
        case "max", (a, b):
            return _half(Call("+", (a, _size(a, kink))) if b == Number(0.0) else _of_both(a, b, "+", kink))
        case "min", (a, b):
            return _half(_of_both(a, b, "-", kink))
        case _:
            return Call(tree.function, given)


def _size(z: Tree, kink: float) -> Tree:
    return Call("sqrt", (Call("+", (Call("^", (z, Number(2.0))), Number(kink**2))),))


def _of_both(a: Tree, b: Tree, sign: str, kink: float) -> Tree:
    return Call(sign, (Call("+", (a, b)), _size(Call("-", (a, b)), kink)))


def _half(tree: Tree) -> Tree:
    return Call("*", (Number(0.5), tree))


_ZERO, _ONE = Number(0.0), Number(1.0)


def derivative(tree: Tree, name: str) -> Tree:
    """Derivative of a smooth expression by one of its names."""
    if not isinstance(tree, Call):
        return _ONE if tree == Name(name) else _ZERO
    a, da = tree.arguments[0], derivative(tree.arguments[0], name)
    b = tree.arguments[1] if len(tree.arguments) > 1 else _ZERO
    db = derivative(b, name)
    match tree.function:
        case "+" | "-" as sign:
            return _simple(sign, da, db)
        case "*":
            return _simple("+", _simple("*", da, b), _simple("*", a, db))
        case "/":
            above = _simple("-", _simple("*", da, b), _simple("*", a, db))
            return _simple("/", above, Call("^", (b, Number(2.0))))
        case "^" if isinstance(b, Number):
            return _simple("*", _simple("*", b, _simple("^", a, Number(b.value - 1))), da)
        case "exp":
            return _simple("*", tree, da)
        case "tanh":
            return _simple("*", Call("-", (_ONE, Call("^", (tree, Number(2.0))))), da)
        case "sqrt":
            return _simple("/", da, Call("*", (Number(2.0), tree)))
    return Call(NEGATE, (da,))


def _simple(sign: str, a: Tree, b: Tree) -> Tree:
    """The operation, simplified where an operand is 0 or 1."""
    if (sign in "*/" and a == _ZERO) or (sign == "*" and b == _ZERO):
        return _ZERO
    if (sign == "*" and a == _ONE) or (sign == "+" and a == _ZERO):
        return b
    if (sign in "*/^" and b == _ONE) or (sign in "+-" and b == _ZERO):
        return a
    return Call(sign, (a, b))


def modelica(tree: Tree, above: int = 0) -> str:
    """A tree as Modelica text.

    Args:
        above: rank of the operator around the tree, which gets brackets if its own rank is lower.
    """
    match tree:
        case Number(value):
            return f"{value:.6g}"
        case Name(name):
            return name
    rank = _RANKS.get(tree.function)
    if rank is None:
        return f"{tree.function}({', '.join(modelica(one) for one in tree.arguments)})"
    if tree.function == NEGATE:
        text = f"-{modelica(tree.arguments[0], 2)}"
        return f"({text})" if above else text
    first, second = tree.arguments
    sign = f" {tree.function} " if rank == 0 else tree.function
    behind = rank + (tree.function in "-/^")
    text = f"{modelica(first, rank + (rank == 2))}{sign}{modelica(second, behind)}"
    return f"({text})" if rank < above else text
