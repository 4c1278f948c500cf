"""Numbers as Modelica writes them: products, powers and sums of literals."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable

from pysim.types import BadInput

_OPERATORS: dict[type, Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}


def number(text: str, where: str) -> float:
    """The value of an expression of literals, such as `50e-3` or `2*Constants.pi*5`.

    Raises:
        BadInput: anything else; says where.
    """
    try:
        return _value(ast.parse(text.strip().replace("^", "**"), mode="eval").body)
    except (SyntaxError, ValueError, ZeroDivisionError, OverflowError) as error:
        raise BadInput(f"{where}: {text.strip()!r} must be a number; write it out, such as 5e-3") from error


def _value(node: ast.expr) -> float:
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return float(value)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_value(inner)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_value(left), _value(right))
        case ast.Attribute(attr="pi"):
            return math.pi
    raise ValueError("no number")
