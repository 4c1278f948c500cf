"""The form between lowering and code generation: an explicit, sorted, event-aware system of ODEs."""

from dataclasses import dataclass
from enum import Enum
from typing import Literal

import casadi as ca

Vector = Literal["t", "p", "c", "x", "dx", "u", "d", "w"]
Causality = Literal["independent", "parameter", "calculatedParameter", "input", "output", "local"]
Variability = Literal["constant", "fixed", "tunable", "discrete", "continuous"]
Initial = Literal["exact", "calculated"]


class ScalarType(Enum):
    """Type a variable has in Modelica and FMI; inside, every value is a double (Boolean: 0 or 1)."""

    REAL = "Real"
    INTEGER = "Integer"
    BOOLEAN = "Boolean"


@dataclass(frozen=True)
class Variable:
    """One scalar variable: what the FMU says of it and where its value is kept.

    Aliases are variables that name the same `vector` and `index`.
    """

    name: str
    scalar_type: ScalarType
    causality: Causality
    variability: Variability
    initial: Initial | None
    vector: Vector
    index: int
    start: float | None = None
    unit: str | None = None
    display_unit: str | None = None
    quantity: str | None = None
    description: str | None = None
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    derivative_of: str | None = None
    enumeration: tuple[str, ...] = ()


@dataclass(frozen=True)
class Symbols:
    """The arguments every expression of an `OdeModel` is written in, each a column vector.

    The order of the fields is the order of the arguments of the generated C functions (runtime/include/model.h).
    """

    t: ca.SX  # (1)    time, s
    x: ca.SX  # (n_x)  continuous states
    u: ca.SX  # (n_u)  inputs
    p: ca.SX  # (n_p)  parameters a user may set
    c: ca.SX  # (n_c)  parameters calculated from p
    d: ca.SX  # (n_d)  discrete variables
    r: ca.SX  # (n_r)  relations, 0 or 1, constant between events
    v: ca.SX  # (n_v)  values of delay()
    q: ca.SX  # (n_q)  unknowns of the non-linear blocks
    i: ca.SX  # (n_i)  unknowns of initialisation
    pre_d: ca.SX  # (n_d)  discrete variables before the event iteration
    pre_b: ca.SX  # (n_b)  when-conditions before the event iteration
    e: ca.SX  # (2 + n_s)  1 where it holds now: initial(), terminal(), each sample() clock


@dataclass(frozen=True)
class Relation:
    """A comparison that may cause an event: `r = value > 0`, or `>= 0` where not strict.

    `instant` is set where the comparison is one of time alone: it changes at that time, so no crossing has to be
    searched for. It is an expression in p, c and d.
    """

    value: ca.SX
    strict: bool
    instant: ca.SX | None = None


@dataclass(frozen=True)
class Sample:
    """`sample(start, interval)`, both expressions in p and c, in s."""

    start: ca.SX
    interval: ca.SX


@dataclass(frozen=True)
class Delay:
    """`delay(source, time, maximum)`: times in s, in p and c; `maximum` bounds `time` and sizes the buffer."""

    source: ca.SX
    time: ca.SX
    maximum: ca.SX


@dataclass(frozen=True)
class Check:
    """A condition (1 holds) with the message shown when it does not: `assert`; for `terminate`, when it does."""

    condition: ca.SX
    message: str
    is_warning: bool = False


@dataclass(frozen=True)
class DefaultExperiment:
    start: float | None = None
    stop: float | None = None
    tolerance: float | None = None
    interval: float | None = None


@dataclass(frozen=True)
class OdeModel:
    """A model ready for code generation. Sizes are those of the vectors in `symbols`.

    Continuous time: `derivatives` and `outputs` are explicit in `symbols`, with `residual = 0` defining q (in block
    order; q enters `residual` through small dense Newton systems). Events: `updates_d`, `updates_x` and `updates_b`
    give the values after one pass of the event iteration. Initialisation: `initial_residual = 0` defines i;
    `calculated`, `start_x`, `start_d` and `start_q` follow from it explicitly.
    """

    name: str
    description: str
    symbols: Symbols
    variables: tuple[Variable, ...]

    derivatives: ca.SX  # (n_x)
    outputs: ca.SX  # (n_w)  every variable kept in w
    residual: ca.SX  # (n_q)

    relations: tuple[Relation, ...]  # n_r
    samples: tuple[Sample, ...]  # n_s
    delays: tuple[Delay, ...]  # n_v
    updates_d: ca.SX  # (n_d)
    updates_b: ca.SX  # (n_b)  when-conditions; a clause is active where it is 1 and pre_b is 0
    updates_x: ca.SX  # (n_x)  x itself where nothing is reinitialised
    checks: tuple[Check, ...]
    terminations: tuple[Check, ...]

    calculated: ca.SX  # (n_c)  in p, i
    start_x: ca.SX  # (n_x)  the symbol x_k itself where the user's start value is kept (initial = exact)
    start_d: ca.SX  # (n_d)  likewise
    start_q: ca.SX  # (n_q)  first guess
    initial_residual: ca.SX  # (n_i)
    guess_i: ca.SX  # (n_i)  first guess, in p and c

    nominal_x: tuple[float, ...]  # (n_x)
    default_experiment: DefaultExperiment
    constrained: tuple[bool, ...] = ()  # (n_q) where q is given by states that a constraint binds, or empty
    documentation: str = ""  # HTML of the class' Documentation annotation
