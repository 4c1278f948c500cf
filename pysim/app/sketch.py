"""A small curve of an effect's law, worked out from its equation, where that is a function of one variable."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Mapping, Sequence

_FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "tanh": math.tanh, "exp": math.exp, "sqrt": math.sqrt, "abs": abs, "max": max, "min": min, "sin": math.sin,
    "noEvent": lambda value: value, "smooth": lambda order, value: value,
}  # fmt: skip
_POINTS, _STEEP = 81, 25.0
_IF = re.compile(r"if (.+?) then (.+) else (.+)", re.S)


def sketch(law: str, sees: Sequence[str], parameters: Mapping[str, float]) -> tuple[list[float], list[float]] | None:
    """Points of the law's first equation over the one variable of its slot that it uses, both scaled to -1 ... 1.

    A constant that the law names and nobody gives, as the width of a sign change, is taken as a small part of the axis.

    Args:
        law: equations as the class writes them.
        sees: variables that the slot offers.
        parameters: of the effect, at sizes that show.
    Returns:
        x and y, or None for a law with a memory or of several variables.
    """
    equation = law.partition(";")[0]
    left, equals, right = equation.partition("=")
    if not equals or "der(" in law or "when" in law or "pre(" in law or not re.fullmatch(r"\s*\w+\s*", left):
        return None
    names = set(re.findall(r"(?<![\w.])[A-Za-z_]\w*(?!\w*\s*\()", right)) - {"if", "then", "else", "and", "or"}
    argument = [name for name in sees if name in names]
    if len(argument) > 1:
        return None
    span = _span(right, argument, parameters)
    steep = dict.fromkeys(names - set(argument) - set(parameters) - set(_FUNCTIONS), span / _STEEP)
    try:
        tree = ast.parse(_python(right), mode="eval").body
        x = [span * (2 * k / (_POINTS - 1) - 1) for k in range(_POINTS)]
        known = {**parameters, **steep}
        y = [_value(tree, {**known, **dict.fromkeys(argument, at)}) for at in x]
    except (SyntaxError, ValueError, KeyError, TypeError, ZeroDivisionError, OverflowError):
        return None
    high = max(map(abs, y))
    if not (math.isfinite(high) and high > 0):
        return None
    return [v / span for v in x], [v / high for v in y]


def _span(right: str, argument: Sequence[str], parameters: Mapping[str, float]) -> float:
    """Half of the axis: some sizes of a parameter that stands beside the variable in a sum or a comparison, else 1."""
    for name in argument:
        for other, value in parameters.items():
            if value and re.search(rf"\b{name}\s*(?:[-+<>]|>=|<=)\s*-?\s*{other}\b", right):
                return 3 * abs(value)
            if value and re.search(rf"\babs\({name}\)\s*/\s*{other}\b", right):
                return 4 * abs(value)
    return 1.0


def _python(text: str) -> str:
    """An expression of Modelica as one of Python; `if` within brackets too."""
    text = text.strip().replace("^", "**").replace("\n", " ")
    inner = re.fullmatch(r"noEvent\((.*)\)", text, re.S)
    text = inner[1] if inner else text
    found = _IF.fullmatch(text)
    if found is None:
        return text
    condition, then, other = found.groups()
    return f"(({_python(then)}) if ({condition}) else ({_python(other)}))"


def _value(node: ast.expr, names: Mapping[str, float]) -> float:
    """Of a tree of numbers, names and the few functions above; anything else is refused."""
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        return float(node.value)
    if isinstance(node, ast.Name):
        return names[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_value(node.operand, names)
    if isinstance(node, ast.BinOp):
        return _BINARY[type(node.op)](_value(node.left, names), _value(node.right, names))
    if isinstance(node, ast.IfExp):
        return _value(node.body if _value(node.test, names) else node.orelse, names)
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        return _COMPARED[type(node.ops[0])](_value(node.left, names), _value(node.comparators[0], names))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        return float(_FUNCTIONS[node.func.id](*(_value(one, names) for one in node.args)))
    raise ValueError("not a law that can be drawn")


def _power(a: float, b: float) -> float:
    if abs(b) > 20:
        raise ValueError("not a law that can be drawn")
    return float(math.copysign(abs(a) ** b, a) if b % 2 else abs(a) ** b)


_BINARY: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b, ast.Pow: _power,
}  # fmt: skip
_COMPARED: Mapping[type[ast.cmpop], Callable[[float, float], float]] = {
    ast.Gt: lambda a, b: a > b, ast.Lt: lambda a, b: a < b, ast.GtE: lambda a, b: a >= b, ast.LtE: lambda a, b: a <= b,
}  # fmt: skip
