"""Decides in which vector each variable is kept; variables with one and the same value share their place."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

import casadi as ca

from fmu_build.front.flat_model import FlatVariable, Role
from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.continuous import Solved
from fmu_build.lower.evaluate import Evaluator
from fmu_build.lower.ode_model import Causality, Initial, Variability, Vector
from fmu_build.lower.parameters import Parameters
from fmu_build.lower.scope import ScalarVariable, Scope, scalar_names
from fmu_build.lower.start import Start, start_values
from fmu_build.lower.table import Entry
from fmu_build.lower.values import Scalar


@dataclass
class Places:
    """`entries` in the model's order, derivatives last; `outputs` is what is kept in w."""

    entries: list[Entry] = field(default_factory=list)
    outputs: list[Scalar] = field(default_factory=list)

    def calculate(self, changed: Collection[int]) -> None:
        """Take "exact" from the states and discrete variables, by hash, that hold another value once initialised.

        They begin the initialisation with their start value nevertheless, which pre() gives there.
        """
        self.entries = [
            replace(entry, initial="calculated")
            if entry.vector in ("x", "d") and entry.variable.symbol.element_hash() in changed
            else entry
            for entry in self.entries
        ]


def place_variables(
    shown: Sequence[FlatVariable],
    scope: Scope,
    parameters: Parameters,
    calculated: Sequence[Scalar],
    solved: Solved,
    derivatives: Sequence[Scalar],
    start: Start,
    evaluator: Evaluator,
) -> Places:
    """The place of every scalar of the variables `shown`: the model's, and the lowering's own discrete ones."""
    places = Places()
    entry_of = {
        entry.variable.name: entry
        for entries in (
            _parameter_entries(parameters, calculated),
            _state_entries(scope, start, evaluator),
            _input_entries(scope, evaluator),
            _discrete_entries(scope, start, evaluator),
            _algebraic_entries(scope, solved, derivatives, places),
        )
        for entry in entries
    }
    for variable in shown:
        if variable.scalar is not ScalarKind.STRING:
            places.entries += [entry_of[name] for name in scalar_names(variable)]
    places.entries += [
        Entry(state, "local", "continuous", "calculated", "dx", k, derivative_of=state.name)
        for k, state in enumerate(scope.states)
    ]
    return places


def _causality(variable: ScalarVariable) -> Causality:
    return "output" if variable.flat.is_output else "local"


def _parameter_entries(parameters: Parameters, explicit: Sequence[Scalar]) -> list[Entry]:
    entries = []
    for k, variable in enumerate(parameters.settable):
        variability: Variability = "tunable" if variable.flat.is_tunable else "fixed"
        start = ca.SX(parameters.starts[k])
        entries.append(Entry(variable, "parameter", variability, "exact", "p", k, start))
    tunable = {v.symbol.element_hash() for v in parameters.settable if v.flat.is_tunable}
    for k, (calculated, value) in enumerate(zip(parameters.calculated, explicit, strict=True)):
        if calculated.variable.flat.role is Role.CONSTANT:
            entries.append(Entry(calculated.variable, "local", "constant", "exact", "c", k, value))
            continue
        follows = any(symbol.element_hash() in tunable for symbol in ca.symvar(value))
        variability = "tunable" if follows else "fixed"
        entries.append(Entry(calculated.variable, "calculatedParameter", variability, "calculated", "c", k))
    return entries


def _with_start(
    variable: ScalarVariable, variability: Variability, vector: Vector, index: int, start: Scalar | None
) -> Entry:
    """A state or discrete variable; with a start value it keeps what the user sets."""
    initial: Initial = "calculated" if start is None else "exact"
    return Entry(variable, _causality(variable), variability, initial, vector, index, start)


def _state_entries(scope: Scope, start: Start, evaluator: Evaluator) -> list[Entry]:
    entries = []
    for k, (variable, value) in enumerate(zip(scope.states, start_values(scope.states, evaluator), strict=True)):
        is_kept = start.states[k] is variable.symbol
        entries.append(_with_start(variable, "continuous", "x", k, value if is_kept else None))
    return entries


def _input_entries(scope: Scope, evaluator: Evaluator) -> list[Entry]:
    entries = []
    for k, (variable, value) in enumerate(zip(scope.inputs, start_values(scope.inputs, evaluator), strict=True)):
        variability: Variability = "discrete" if variable.flat.is_discrete else "continuous"
        entries.append(Entry(variable, "input", variability, None, "u", k, value))
    return entries


def _discrete_entries(scope: Scope, start: Start, evaluator: Evaluator) -> list[Entry]:
    entries = []
    values = start_values(scope.discretes, evaluator)
    for k, (variable, value) in enumerate(zip(scope.discretes, values, strict=True)):
        is_kept = start.discretes[k].element_hash() == variable.symbol.element_hash()
        entries.append(_with_start(variable, "discrete", "d", k, value if is_kept else None))
    return entries


def _algebraic_entries(scope: Scope, solved: Solved, derivatives: Sequence[Scalar], places: Places) -> list[Entry]:
    known: dict[int, tuple[Vector, int]] = {}
    known |= {v.symbol.element_hash(): ("x", k) for k, v in enumerate(scope.states)}
    known |= {v.symbol.element_hash(): ("u", k) for k, v in enumerate(scope.inputs)}
    for k, derivative in enumerate(derivatives):
        if derivative.n_dep() > 0:
            known.setdefault(derivative.element_hash(), ("dx", k))
    values = solved.replace([variable.symbol for variable in scope.algebraics])
    entries = []
    for variable, value in zip(scope.algebraics, values, strict=True):
        key = value.element_hash()
        if value.is_constant() or key not in known:
            known[key] = ("w", len(places.outputs))
            places.outputs.append(value)
        entries.append(Entry(variable, _causality(variable), "continuous", "calculated", *known[key]))
    return entries
