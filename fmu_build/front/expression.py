"""Expressions of a flat Modelica model: a typed tree, each node with the place it was written at."""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from enum import Enum
from pathlib import Path


@dataclass(frozen=True)
class Span:
    """Place in the Modelica text; `file` is None for what the compiler made up."""

    file: Path | None = None
    line: int | None = None


class Form(Enum):
    """What of a variable is meant."""

    VALUE = "value"
    DERIVATIVE = "derivative"
    PRE = "pre"


# Nodes are compared by identity: a node that occurs twice is one value, computed once.
@dataclass(frozen=True, eq=False)
class Expression:
    span: Span


@dataclass(frozen=True, eq=False)
class Literal(Expression):
    value: float | int | bool | str


@dataclass(frozen=True, eq=False)
class Reference(Expression):
    """The whole variable `name`, scalar or array."""

    name: str
    form: Form = Form.VALUE


@dataclass(frozen=True, eq=False)
class Time(Expression):
    pass


@dataclass(frozen=True, eq=False)
class LoopVariable(Expression):
    """Iteration variable number `position` of the loop `domain`."""

    domain: int
    position: int


@dataclass(frozen=True, eq=False)
class Argument(Expression):
    """Input number `position` of the function in whose body this stands."""

    position: int


@dataclass(frozen=True, eq=False)
class Local(Expression):
    """Output or protected variable of a function, as its definition number `definition` left it."""

    position: int
    definition: int


@dataclass(frozen=True, eq=False)
class Unary(Expression):
    operator: str
    operand: Expression


@dataclass(frozen=True, eq=False)
class Binary(Expression):
    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, eq=False)
class Builtin(Expression):
    name: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, eq=False)
class Call(Expression):
    """Output number `output` of a call; calls with the same `owner` are one."""

    function: int
    arguments: tuple[Expression, ...]
    output: int
    owner: int


@dataclass(frozen=True, eq=False)
class Conditional(Expression):
    """`if c1 then v1 elseif c2 then v2 ... else otherwise`."""

    branches: tuple[tuple[Expression, Expression], ...]
    otherwise: Expression


@dataclass(frozen=True, eq=False)
class Slice(Expression):
    """A colon as subscript."""


@dataclass(frozen=True, eq=False)
class Index(Expression):
    base: Expression
    subscripts: tuple[Expression, ...]


@dataclass(frozen=True, eq=False)
class ArrayUpdate(Expression):
    """The array `base` with `value` put in at the subscripts: an assignment to elements inside a function."""

    base: Expression
    value: Expression
    subscripts: tuple[Expression, ...]


@dataclass(frozen=True, eq=False)
class Range(Expression):
    start: Expression
    step: Expression | None
    stop: Expression


@dataclass(frozen=True, eq=False)
class ArrayLiteral(Expression):
    elements: tuple[Expression, ...]


@dataclass(frozen=True, eq=False)
class RecordLiteral(Expression):
    fields: tuple[Expression, ...]


@dataclass(frozen=True, eq=False)
class Field(Expression):
    base: Expression
    position: int


@dataclass(frozen=True, eq=False)
class Comprehension(Expression):
    """`{body for ...}` over the loop `domain`."""

    domain: int
    body: Expression


@dataclass(frozen=True, eq=False)
class Delay(Expression):
    """`delay(source, time, maximum)`; `number` tells one delay line from another."""

    number: int
    source: Expression
    time: Expression
    maximum: Expression


@dataclass(frozen=True, eq=False)
class Initial(Expression):
    pass


@dataclass(frozen=True, eq=False)
class Terminal(Expression):
    pass


@dataclass(frozen=True, eq=False)
class Sample(Expression):
    """`sample(start, interval)`, 1 at the event instants."""

    start: Expression
    interval: Expression


def references(expression: Expression) -> Iterator[str]:
    """The names of the variables that an expression refers to, in written order."""
    waiting: list[object] = [expression]
    while waiting:
        part = waiting.pop()
        if isinstance(part, Reference):
            yield part.name
        elif isinstance(part, tuple):
            waiting += reversed(part)
        elif isinstance(part, Expression):
            waiting += [getattr(part, field.name) for field in reversed(fields(part))]
