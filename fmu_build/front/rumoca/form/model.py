"""rumoca's model storage -> `FlatModel`; refuses whatever it does not know."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.expression import Span
from fmu_build.front.flat_model import (
    Assertion,
    DiscreteEquation,
    Equation,
    Experiment,
    FlatModel,
    Loop,
    Reinit,
    Termination,
)
from fmu_build.front.rumoca.form.clauses import Clauses
from fmu_build.front.rumoca.form.expressions import Node
from fmu_build.front.rumoca.form.flat_form import FlatForm
from fmu_build.front.rumoca.form.functions import convert_function
from fmu_build.front.rumoca.form.places import Places
from fmu_build.front.rumoca.form.variables import convert_variable

SCHEMA_VERSION = 43

# Every key of the storage: read here, or without meaning for us (event roots and instants are found again from the
# expressions, so that they keep following the parameters). Anything else is refused.
READ = {
    "value_types", "variables", "functions", "domains", "expressions", "continuous_equation_operations",
    "initialization_equation_operations", "initial_discrete_values", "initial_parameter_values",
    "discrete_real_equations", "discrete_value_owners", "relations", "conditions", "event_actions", "clocks",
    "terminals", "delays",
}  # fmt: skip
IGNORED = {
    "predefined_string_declaration", "flat_type_ids", "value_type_provenance", "roots", "structured_roots",
    "time_events", "clock_ownerships",
}  # fmt: skip

MEANT = {
    "model_event_transactions": "a when-clause of an algorithm in which an if sets some variables only in some of its "
    "branches, or twice, which is not supported; write equations: variable = if ... then ... else pre(variable)"
}


Check = Callable[[Mapping[str, Any], Places], None]


def to_flat_model(
    dae: Mapping[str, Any],
    flat: Mapping[str, Any],
    *,
    name: str,
    span: Span,
    experiment: Experiment,
    documentation: str,
    description: str,
    checks: Sequence[Check] = (),
) -> FlatModel:
    """Convert one compiled class.

    Args:
        checks: of the form, ahead of its conversion; they raise a BuildError.
    Raises:
        BuildError: another rumoca schema, or a construct outside the supported subset.
    """
    if dae["schema_version"] != SCHEMA_VERSION:
        raise BuildError(f"rumoca's schema {dae['schema_version']} is not {SCHEMA_VERSION}; install rumoca==0.10.2")
    storage = dae["storage"]
    unknown = sorted(key for key in storage if key not in READ | IGNORED and storage[key])
    if unknown:
        what = MEANT.get(unknown[0], f"what the compiler calls '{unknown[0]}', which is not supported")
        raise BuildError(f"{name} uses {what}", span.file, span.line)
    places = Places(dae["source_map"])
    for check in checks:
        check(dae, places)
    try:
        converter = _Converter(storage, FlatForm(flat, places), places)
        return converter.model(name, span, experiment, documentation, description)
    except (AssertionError, AttributeError, IndexError, KeyError, TypeError, ValueError) as failure:
        what = f"{type(failure).__name__}: {failure}"
        raise BuildError(f"the compiler's form of {name} is not known here ({what})", span.file, span.line) from failure


class _Converter:
    def __init__(self, storage: Mapping[str, Any], flat: FlatForm, places: Places) -> None:
        self._storage = storage
        self._flat = flat
        self._places = places
        self._clauses = Clauses(storage, flat, places)
        self._arena = self._clauses.arena
        self._names = [variable["name"] for variable in storage["variables"]]

    def model(self, name: str, span: Span, experiment: Experiment, documentation: str, description: str) -> FlatModel:
        storage = self._storage
        reinits, assertions, terminations = self._actions()
        discrete = tuple(self._discrete_equations())
        return FlatModel(
            name=name,
            description=description,
            span=span,
            variables=tuple(
                convert_variable(v, storage, self._arena, self._flat, self._places)
                for v in storage["variables"]
                if not self._is_stand_in(v)
            ),
            loops=tuple(_loop(domain) for domain in storage["domains"]),
            functions=tuple(convert_function(f, storage, self._arena, self._places) for f in storage["functions"]),
            equations=tuple(self._equations("continuous_equation_operations")),
            initial_equations=tuple(self._equations("initialization_equation_operations")),
            discrete_equations=discrete,
            initial_values=tuple(self._initial_values()),
            reinits=reinits,
            assertions=assertions,
            terminations=terminations,
            clauses=tuple(self._clauses.clauses),
            experiment=experiment,
            documentation=documentation,
        )

    def _is_stand_in(self, variable: Node) -> bool:
        """An outer parameter: rumoca refers to the inner one wherever it is used, and lists it nevertheless."""
        has_value = self._flat.is_start_written(variable["name"]) or variable["attributes"]["binding"] is not None
        is_parameter = variable["role"] in ("parameter", "constant")
        return is_parameter and not has_value and self._places.is_outer(variable["declaration"])

    def _equations(self, key: str) -> list[Equation]:
        equations = []
        for operation in self._storage[key]:
            ((kind, what),) = operation.items()
            if kind == "residual":
                residual = self._arena.expression(what["residual"])
                equations.append(Equation(residual, self._places.span(what["provenance"])))
            elif kind == "structured":
                span = self._places.span(what.get("provenance"))
                # Elements of an array equation, or one scalar equation per loop step.
                domain = what["domain"] if what["scalar_view"] == "BinderSubstitution" else None
                equations += [Equation(self._arena.expression(body), span, domain) for body in what["bodies"]]
            else:
                raise BuildError(f"equation of kind '{kind}' is not supported")
        return equations

    def _discrete_equations(self) -> list[DiscreteEquation]:
        equations = []
        for equation in self._storage["discrete_real_equations"]:
            target, value = self._clauses.real_target(equation)
            equations.append(self._discrete(target, value, equation))
        for owner in self._storage["discrete_value_owners"]:
            for branch in owner["branches"]:
                for target, value in zip(owner["targets"], branch["values"], strict=True):
                    expression = self._arena.expression(value["value"])
                    equations.append(self._discrete(self._names[target], expression, branch))
        return equations

    def _discrete(self, target: str, value: Any, form: Node) -> DiscreteEquation:
        span = self._places.span(form["provenance"])
        if form["activation"] == "always":
            return DiscreteEquation(target, value, None, span)
        when = form["activation"]["when"]
        return DiscreteEquation(target, value, self._clauses.activation(when["trigger"], when["guard"]), span)

    def _initial_values(self) -> list[DiscreteEquation]:
        values = self._storage["initial_discrete_values"] + self._storage["initial_parameter_values"]
        return [
            DiscreteEquation(
                self._names[item["target"]],
                self._arena.expression(item["value"]),
                None,
                self._places.span(item.get("provenance")),
            )
            for item in values
        ]

    def _actions(self) -> tuple[tuple[Reinit, ...], tuple[Assertion, ...], tuple[Termination, ...]]:
        reinits, assertions, terminations = [], [], []
        for action in self._storage["event_actions"]:
            ((kind, what),) = action["kind"].items()
            span = self._places.span(action["provenance"])
            if kind == "reinitialize":
                activation = self._clauses.activation(action["trigger"], action["guard"])
                value = self._arena.expression(what["value"])
                reinits.append(Reinit(self._names[what["state"]], value, activation, span))
            elif kind in ("assert", "warning"):
                assertions.append(self._assertion(action, what, kind == "warning", span))
            elif kind == "terminate":
                activation = self._clauses.activation(action["trigger"], action["guard"])
                terminations.append(Termination(self._arena.expression(what["message"]), activation, span))
            else:
                raise BuildError(f"action of kind '{kind}' is not supported", span.file, span.line)
        return tuple(reinits), tuple(assertions), tuple(terminations)

    def _assertion(self, action: Node, what: Node, is_warning: bool, span: Span) -> Assertion:
        trigger, guard = action["trigger"], action["guard"]
        violation = self._clauses.violation(trigger, guard)
        if "condition" in what:
            violated = ex.Unary(span, "not", self._arena.expression(what["condition"]))
            violation = ex.Binary(span, "and", violation, violated)
        clause = None if self._clauses.is_always(trigger) else self._clauses.clause(trigger)
        return Assertion(violation, self._arena.expression(what["message"]), is_warning, clause, span)


def _loop(domain: Node) -> Loop:
    ranges = tuple((b["lower"], b["upper"], b["step"]) for b in domain["domain"]["binders"])
    return Loop(ranges, domain["parent"])
