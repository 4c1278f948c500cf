"""What the front end hands to the lowering: one model without classes, connectors or inheritance."""

from dataclasses import dataclass
from enum import Enum

from fmu_build.front.expression import Expression, Span


class Scalar(Enum):
    REAL = "real"
    INTEGER = "integer"
    BOOLEAN = "boolean"
    ENUMERATION = "enumeration"
    STRING = "string"


class Role(Enum):
    """Part a variable plays in the equations."""

    CONSTANT = "constant"
    STRUCTURAL = "structural"  # a parameter the compiler has already used: array sizes, choice of equations
    PARAMETER = "parameter"
    INPUT = "input"
    STATE = "state"
    ALGEBRAIC = "algebraic"
    DISCRETE = "discrete"


class StateSelect(Enum):
    NEVER = 1
    AVOID = 2
    DEFAULT = 3
    PREFER = 4
    ALWAYS = 5


@dataclass(frozen=True)
class FlatVariable:
    """A scalar or array variable; the elements of an array come in row-major order.

    Attributes are expressions in parameters; one that is not written in the model is None.
    """

    name: str
    scalar: Scalar
    dimensions: tuple[int, ...]
    role: Role
    span: Span
    is_input: bool = False
    is_output: bool = False
    is_tunable: bool = False
    is_discrete: bool = False  # by prefix or by type
    is_protected: bool = False
    binding: Expression | None = None
    start: Expression | None = None
    fixed: tuple[bool, ...] | None = None
    min: Expression | None = None
    max: Expression | None = None
    nominal: Expression | None = None
    unit: str | None = None
    display_unit: str | None = None
    quantity: str | None = None
    description: str | None = None
    state_select: StateSelect = StateSelect.DEFAULT
    enumeration: tuple[str, ...] = ()


@dataclass(frozen=True)
class Loop:
    """Nested `for` loops: (lower, upper, step) of each iteration variable, outermost first."""

    ranges: tuple[tuple[int, int, int], ...]
    parent: int | None = None


@dataclass(frozen=True)
class Equation:
    """`residual = 0`: scalar, or elementwise for an array, once per step of the loop `domain` if there is one."""

    residual: Expression
    span: Span
    domain: int | None = None


@dataclass(frozen=True)
class WhenClause:
    """A branch of a when-clause, active when one of `conditions` becomes true and no branch before it is active.

    `initial()` and `sample()` stand as they are among the conditions. `previous` is the branch before an elsewhen.
    """

    conditions: tuple[Expression, ...]
    previous: int | None
    span: Span


@dataclass(frozen=True)
class Activation:
    """When an equation counts: its when-clause is active and `guard`, an `if` inside the clause, holds."""

    clause: int
    guard: Expression | None = None


@dataclass(frozen=True)
class DiscreteEquation:
    """`target = value`, always or while active; a target without an active equation keeps its value."""

    target: str
    value: Expression
    activation: Activation | None
    span: Span


@dataclass(frozen=True)
class Reinit:
    state: str
    value: Expression
    activation: Activation
    span: Span


@dataclass(frozen=True)
class Assertion:
    """`assert`: wrong where `violation` holds, always looked at or when a clause becomes active."""

    violation: Expression
    message: Expression
    is_warning: bool
    clause: int | None
    span: Span


@dataclass(frozen=True)
class Termination:
    message: Expression
    activation: Activation
    span: Span


@dataclass(frozen=True)
class Assignment:
    """One step of a function: all values are computed before any target changes."""

    targets: tuple[int, ...]
    values: tuple[Expression, ...]
    span: Span


@dataclass(frozen=True)
class ForStatement:
    domain: int
    targets: tuple[int, ...]
    statements: tuple["Assignment | ForStatement", ...]
    span: Span


@dataclass(frozen=True)
class Function:
    """A Modelica function; locals are numbered outputs first, then protected variables."""

    name: str
    n_inputs: int
    n_outputs: int
    dimensions: tuple[tuple[int, ...], ...]  # of each local
    statements: tuple[Assignment | ForStatement, ...]
    span: Span


@dataclass(frozen=True)
class Experiment:
    start: float | None = None
    stop: float | None = None
    tolerance: float | None = None
    interval: float | None = None


@dataclass(frozen=True)
class FlatModel:
    name: str
    description: str
    span: Span
    variables: tuple[FlatVariable, ...]
    loops: tuple[Loop, ...]
    functions: tuple[Function, ...]
    equations: tuple[Equation, ...]
    initial_equations: tuple[Equation, ...]
    discrete_equations: tuple[DiscreteEquation, ...]
    initial_values: tuple[DiscreteEquation, ...]  # given to discrete variables and parameters at the start
    clauses: tuple[WhenClause, ...]
    reinits: tuple[Reinit, ...]
    assertions: tuple[Assertion, ...]
    terminations: tuple[Termination, ...]
    experiment: Experiment
    documentation: str
