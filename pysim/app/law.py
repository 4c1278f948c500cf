"""The equations of an effect, worked out with numbers: a few functions of plain names, and nothing else of Modelica."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

_FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "tanh": math.tanh, "exp": math.exp, "sqrt": math.sqrt, "abs": abs, "max": max, "min": min, "sin": math.sin,
    "cos": math.cos, "sign": lambda value: (value > 0) - (value < 0), "noEvent": lambda value: value,
    "smooth": lambda order, value: value,
}  # fmt: skip
_DERIVATIVE = re.compile(r"(?:(?P<factor>.+)\*\s*)?der\((?P<name>\w+)\)", re.S)
_SAMPLE = re.compile(r"sample\(\s*[^,]+,\s*(.+)\)", re.S)
FAILED = (SyntaxError, ValueError, KeyError, TypeError, ZeroDivisionError, OverflowError, RecursionError)


@dataclass
class Law:
    """Equations by what they give.

    Args:
        values: name -> expression.
        rates: name -> its derivative, and what that derivative is multiplied by.
        sampled: name -> expression and interval, of what is kept from one sample to the next.
        resets: name -> its new value, and the conditions of which one has to become true.
    """

    values: dict[str, ast.expr] = field(default_factory=dict)
    rates: dict[str, tuple[ast.expr, ast.expr]] = field(default_factory=dict)
    sampled: dict[str, tuple[ast.expr, ast.expr]] = field(default_factory=dict)
    resets: dict[str, tuple[ast.expr, tuple[ast.expr, ...]]] = field(default_factory=dict)

    def needs(self, name: str) -> set[str]:
        """Names that a name depends on, through all equations."""
        found: set[str] = set()
        queue = [name]
        while queue:
            one = queue.pop()
            trees = [self.values.get(one), *self.rates.get(one, ()), *self.sampled.get(one, ())]
            used = {n for tree in trees if tree is not None for n in _names(tree)} - found
            found |= used
            queue += sorted(used)
        return found

    def remembers(self, name: str) -> bool:
        """Whether it depends on what was before."""
        own = {name, *self.needs(name)}
        kept = {*self.rates, *self.sampled}
        return bool(own & kept) or any(one.startswith("pre ") for one in own)


def read_law(text: str) -> Law:
    """Equations as a class writes them.

    Raises:
        ValueError, SyntaxError: one that is none of those that can be worked out here.
    """
    law, guard = Law(), ""
    for statement in (part.strip() for part in text.split(";")):
        if statement.startswith("when "):
            guard, _, statement = statement[5:].partition(" then")
        if statement.strip() in ("", "end when"):
            guard = guard if statement.strip() == "" else ""
            continue
        _take(law, statement.strip(), guard.strip())
    return law


def _take(law: Law, statement: str, guard: str) -> None:
    reset = re.fullmatch(r"reinit\((\w+),(.*)\)", statement, re.S)
    if reset:
        law.resets[reset[1]] = (_tree(reset[2]), tuple(_tree(part) for part in guard.strip("{}").split(",")))
        return
    left, equals, right = statement.partition("=")
    left, derived = left.strip(), _DERIVATIVE.fullmatch(left.strip())
    sampled = _SAMPLE.fullmatch(guard)
    if not equals or (guard and not sampled):
        raise ValueError(f"{statement}: no equation that can be worked out")
    if sampled:
        law.sampled[left] = (_tree(right), _tree(sampled[1]))
    elif derived:
        law.rates[derived["name"]] = (_tree(right), _tree(derived["factor"] or "1"))
    elif re.fullmatch(r"\w+", left):
        law.values[left] = _tree(right)
    else:
        raise ValueError(f"{statement}: no equation for one name")


def _tree(text: str) -> ast.expr:
    text = re.sub(r"\bpre\((\w+)\)", r"pre_of_\1", text.strip())
    return ast.parse(_python(text), mode="eval").body


def _python(text: str) -> str:
    """An expression of Modelica as one of Python; `if` within brackets too."""
    text = text.strip().replace("^", "**").replace("<>", "!=").replace("\n", " ")
    text = re.sub(r"\b(true|false)\b", lambda word: word[0].capitalize(), text)
    return _conditional(_within(text))


def _within(text: str) -> str:
    """With every argument in brackets as one of Python."""
    found, depth, begun = [], 0, 0
    for k, letter in enumerate(text):
        if letter == ")":
            depth -= 1
            if depth < 0:
                raise ValueError("a bracket is closed that was not opened")
        if (depth == 1 and letter == ",") or (depth == 0 and letter == ")"):
            found.append(_python(text[begun:k]))
            begun = k
        depth += letter == "("
        if depth == 1 and letter in "(,":
            found.append(text[begun : k + 1])
            begun = k + 1
    return "".join([*found, text[begun:]])


def _conditional(text: str) -> str:
    """`if a then b else c`, each of which may be another."""
    if not text.startswith("if "):
        return text
    depth, ifs, begun = 0, 0, 3
    parts: list[str] = []
    for word in re.finditer(r"\b(?:if|then|else)\b|[()]", text):
        depth += {"(": 1, ")": -1}.get(word[0], 0)
        if depth or word[0] in "()":
            continue
        ifs += {"if": 1, "else": -1}.get(word[0], 0)
        if (word[0] == "then" and ifs == 1 and not parts) or (word[0] == "else" and ifs == 0):
            parts.append(text[begun : word.start()])
            begun = word.end()
            if word[0] == "else":
                break
    if len(parts) != 2:
        raise ValueError("an if without then and else")
    condition, then, other = (_conditional(part.strip()) for part in (*parts, text[begun:]))
    return f"(({then}) if ({condition}) else ({other}))"


def _names(tree: ast.expr) -> Iterator[str]:
    called = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and id(node) not in called:
            yield f"pre {node.id.removeprefix('pre_of_')}" if node.id.startswith("pre_of_") else node.id


class Moment:
    """All names of a law at one moment, each worked out when it is asked for.

    Args:
        law: its equations.
        known: numbers that are given: parameters, what the slot offers, states.
        before: of the moment before, for `pre`.
    """

    def __init__(self, law: Law, known: Mapping[str, float], before: Mapping[str, float]) -> None:
        self._law, self._known, self._before = law, dict(known), before

    def __getitem__(self, name: str) -> float:
        if name not in self._known:
            self._known[name] = self.value(self._law.values[name])
        return self._known[name]

    def value(self, node: ast.expr) -> float:
        """Of a tree of numbers, names and the few functions above; anything else is refused.

        Raises:
            ValueError, KeyError: what is none of these, or a name that nobody gives.
        """
        if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            return float(node.value)
        if isinstance(node, ast.Name):
            if node.id.startswith("pre_of_"):
                return self._before.get(node.id.removeprefix("pre_of_"), 0.0)
            return self[node.id]
        if isinstance(node, ast.BoolOp):
            test = all if isinstance(node.op, ast.And) else any
            return float(test(self.value(one) for one in node.values))
        if isinstance(node, ast.UnaryOp) and type(node.op) in _UNARY:
            return _UNARY[type(node.op)](self.value(node.operand))
        if isinstance(node, ast.BinOp):
            return _BINARY[type(node.op)](self.value(node.left), self.value(node.right))
        if isinstance(node, ast.IfExp):
            return self.value(node.body if self.value(node.test) else node.orelse)
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            return float(_COMPARED[type(node.ops[0])](self.value(node.left), self.value(node.comparators[0])))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
            return float(_FUNCTIONS[node.func.id](*(self.value(one) for one in node.args)))
        raise ValueError("not a law that can be drawn")


def _power(a: float, b: float) -> float:
    if abs(b) > 20:
        raise ValueError("not a law that can be drawn")
    if b != round(b):
        return float(a**b) if a >= 0 else math.nan
    return float(math.copysign(abs(a) ** b, a) if b % 2 else abs(a) ** b)


_BINARY: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b, ast.Pow: _power,
}  # fmt: skip
_UNARY: Mapping[type[ast.unaryop], Callable[[float], float]] = {
    ast.USub: lambda a: -a, ast.UAdd: lambda a: a, ast.Not: lambda a: float(not a),
}  # fmt: skip
_COMPARED: Mapping[type[ast.cmpop], Callable[[float, float], bool]] = {
    ast.Gt: lambda a, b: a > b, ast.Lt: lambda a, b: a < b, ast.GtE: lambda a, b: a >= b, ast.LtE: lambda a, b: a <= b,
    ast.Eq: lambda a, b: a == b, ast.NotEq: lambda a, b: a != b,
}  # fmt: skip
