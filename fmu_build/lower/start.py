"""Start values: kept from the user, calculated from parameters, or solved from the initial equations."""

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from fmu_build.errors import BuildError
from fmu_build.front.flat_model import FlatModel, Role
from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.continuous import Solved, square_blocks
from fmu_build.lower.equations import Definition, ScalarEquation, incidence
from fmu_build.lower.evaluate import Evaluator, Frame
from fmu_build.lower.parameters import Parameters, explicit, start_expression
from fmu_build.lower.scope import ScalarVariable, Scope
from fmu_build.lower.singular import Typical
from fmu_build.lower.solve import solve_block
from fmu_build.lower.sorting import Matching
from fmu_build.lower.values import Scalar, column, scalars


@dataclass(frozen=True)
class Start:
    """Values at the start. A state or discrete variable whose own symbol stands here keeps what the user sets.

    `residuals = 0` gives `unknowns`, from `guesses` on; `parameters` replaces the unknowns of free parameters.
    """

    states: list[Scalar]
    discretes: list[Scalar]
    iterations: list[Scalar]
    unknowns: list[Scalar]
    guesses: list[Scalar]
    residuals: list[Scalar]
    parameters: dict[int, Scalar]


@dataclass(frozen=True, eq=False)
class _Unknown:
    """Something the initial equations may determine. Free parameters and iteration variables have to be (`must`)."""

    symbol: Scalar
    guess: Scalar
    must: bool
    has_start: bool = False


def start_values(variables: Sequence[ScalarVariable], evaluator: Evaluator) -> list[Scalar]:
    """The attribute `start`, or what Modelica takes without it: the number nearest to zero between min and max.

    Of an enumeration, whose first literal is 1, it is the lowest. An input that is declared with a value starts there.
    """
    values = []
    for variable in variables:
        name = "start" if variable.flat.role is not Role.INPUT or variable.flat.binding is None else "binding"
        given, low, high = (attribute(variable, key, evaluator) for key in (name, "min", "max"))
        if given is None:
            given = ca.SX(int(variable.flat.scalar is ScalarKind.ENUMERATION))
            if variable.flat.scalar is not ScalarKind.BOOLEAN:
                given = given if low is None else ca.fmax(given, low)
                given = given if high is None else ca.fmin(given, high)
        values.append(given)
    return values


def attribute(variable: ScalarVariable, name: str, evaluator: Evaluator) -> Scalar | None:
    """start, binding, min, max or nominal of one scalar, in parameters; None where the model is silent."""
    size = 1
    for dimension in variable.flat.dimensions:
        size *= dimension
    return start_expression(getattr(variable.flat, name), evaluator, size)[variable.element]


def initial_conditions(
    flat: FlatModel,
    scope: Scope,
    parameters: Parameters,
    evaluator: Evaluator,
    solved: Solved,
    typical: Typical = dict,
) -> Start:
    """Decide for each state, discrete variable and iteration variable where its start value comes from.

    Args:
        typical: values of a run, for which the initial equations should not be singular.
    Raises:
        BuildError: more initial equations than they can determine, or a free parameter they do not determine.
    """
    equations = _show_free_parameters(_initial_equations(flat, scope, evaluator, solved), parameters)
    state_starts = start_values(scope.states, evaluator)
    guesses_q = _iteration_guesses(scope, solved, evaluator)
    candidates = _candidates(scope, parameters, evaluator, state_starts)
    if _uses(equations, solved.unknowns):
        blocks = [ScalarEquation(residual, flat.span) for residual in solved.residuals]
        equations += _show_free_parameters(blocks, parameters)
        candidates += [_Unknown(q, guess, True) for q, guess in zip(solved.unknowns, guesses_q, strict=True)]
    system = _InitialSystem(flat, equations, candidates)
    system.solve(parameters, typical)
    states = [
        system.value(v.symbol) if system.determines(v.symbol) else v.symbol if start.is_constant() else start
        for v, start in zip(scope.states, state_starts, strict=True)
    ]
    return Start(
        states=states,
        discretes=_discrete_starts(flat, scope, evaluator, solved),
        iterations=[
            system.value(q) if system.determines(q) else guess
            for q, guess in zip(solved.unknowns, guesses_q, strict=True)
        ],
        unknowns=system.unknowns,
        guesses=system.guesses,
        residuals=system.residuals,
        parameters={v.symbol.element_hash(): system.value(v.symbol) for v in parameters.free},
    )


def _initial_equations(flat: FlatModel, scope: Scope, evaluator: Evaluator, solved: Solved) -> list[ScalarEquation]:
    raw = [
        ScalarEquation(residual, equation.span)
        for equation in flat.initial_equations
        for value in evaluator.elements(equation.residual, equation.domain, Frame(False))
        for residual in scalars(value)
    ]
    # A fixed start of what is no state (any more) is a condition on the states.
    fixed = [variable for variable in scope.algebraics if variable.is_fixed]
    starts = start_values(fixed, evaluator)
    raw += [ScalarEquation(v.symbol - start, v.flat.span) for v, start in zip(fixed, starts, strict=True)]
    replaced = solved.replace([equation.residual for equation in raw])
    return [ScalarEquation(r, equation.span) for r, equation in zip(replaced, raw, strict=True)]


def _show_free_parameters(equations: list[ScalarEquation], parameters: Parameters) -> list[ScalarEquation]:
    """Put the calculated parameters in, where some of them depend on free ones."""
    if not parameters.free or not equations:
        return equations
    symbols = [c.variable.symbol for c in parameters.calculated]
    values = [c.value for c in parameters.calculated]
    _, residuals = explicit(symbols, values, [equation.residual for equation in equations])
    return [ScalarEquation(r, equation.span) for r, equation in zip(residuals, equations, strict=True)]


def _iteration_guesses(scope: Scope, solved: Solved, evaluator: Evaluator) -> list[Scalar]:
    variables = {v.symbol.element_hash(): v for v in scope.algebraics}
    guesses = []
    for unknown in solved.unknowns:
        variable = variables.get(unknown.element_hash())
        guesses.append(ca.SX(0) if variable is None else start_values([variable], evaluator)[0])
    return guesses


def _candidates(
    scope: Scope, parameters: Parameters, evaluator: Evaluator, state_starts: Sequence[Scalar]
) -> list[_Unknown]:
    """What initial equations may determine: those that have to be first, states with a start value last."""
    free = start_values(parameters.free, evaluator)
    states = [
        _Unknown(v.symbol, start, False, v.flat.start is not None)
        for v, start in zip(scope.states, state_starts, strict=True)
        if not v.is_fixed
    ]
    must = [_Unknown(v.symbol, guess, True) for v, guess in zip(parameters.free, free, strict=True)]
    return must + sorted(states, key=lambda unknown: unknown.has_start)


def _uses(equations: Sequence[ScalarEquation], symbols: Sequence[Scalar]) -> bool:
    if not equations or not symbols:
        return False
    return bool(ca.depends_on(column(e.residual for e in equations), column(symbols)))


class _InitialSystem:
    """The initial equations and the unknowns they determine, solved as far as possible."""

    def __init__(self, flat: FlatModel, equations: list[ScalarEquation], candidates: list[_Unknown]) -> None:
        self._flat, self._equations = flat, equations
        self._chosen = self._choose(candidates)
        self._values: dict[int, Scalar] = {}
        self.unknowns: list[Scalar] = []
        self.guesses: list[Scalar] = []
        self.residuals: list[Scalar] = []

    def determines(self, symbol: Scalar) -> bool:
        return symbol.element_hash() in self._values

    def value(self, symbol: Scalar) -> Scalar:
        return self._values[symbol.element_hash()]

    def _choose(self, candidates: list[_Unknown]) -> list[_Unknown]:
        """As many unknowns as equations; greedy in order of preference, which is optimal for matchings."""
        order = [c for c in candidates if c.must] + [c for c in candidates if not c.must]
        unknowns_of = incidence(self._equations, [c.symbol for c in order])
        equations_of: list[list[int]] = [[] for _ in order]
        for equation, unknowns in enumerate(unknowns_of):
            for unknown in unknowns:
                equations_of[unknown].append(equation)
        matching = Matching(len(self._equations))
        chosen = [c for k, c in enumerate(order) if not matching.add(k, equations_of)]
        left_over = [e for e, owner in zip(self._equations, matching.equation_of, strict=True) if owner < 0]
        if left_over:
            raise BuildError(
                "too many initial conditions: nothing is left for this initial equation to determine; "
                "take it out or set fixed = false somewhere",
                left_over[0].span.file,
                left_over[0].span.line,
            )
        if any(c.must and c not in chosen for c in order):
            name = next(c.symbol.name() for c in order if c.must and c not in chosen).removeprefix("initial ")
            raise BuildError(
                f"{name} has fixed = false, but no initial equation determines it",
                self._flat.span.file,
                self._flat.span.line,
            )
        return chosen

    def solve(self, parameters: Parameters, typical: Typical) -> None:
        """Block by block; what is not linear is left to Newton as an unknown of initialisation."""
        symbols = [c.symbol for c in self._chosen]
        definitions: list[Definition] = []
        iterated: list[Scalar] = []
        residuals: list[Scalar] = []
        free = {v.symbol.element_hash() for v in parameters.free}
        for block_equations, block_unknowns in square_blocks(self._equations, symbols):
            keep = [s.element_hash() in free for s in block_unknowns]
            solution = solve_block(block_equations, block_unknowns, keep, typical)
            definitions += solution.definitions
            iterated += solution.unknowns
            residuals += solution.residuals
        values, residuals = explicit([d.symbol for d in definitions], [d.value for d in definitions], residuals)
        for definition, value in zip(definitions, values, strict=True):
            if definition.symbol.element_hash() in free and not _is_parametric(value, parameters, iterated):
                iterated.append(definition.symbol)
                residuals.append(definition.symbol - value)
            else:
                self._values[definition.symbol.element_hash()] = value
        self._name_unknowns(iterated, residuals)

    def _name_unknowns(self, iterated: list[Scalar], residuals: list[Scalar]) -> None:
        """Each iterated quantity becomes an element of i, under its own name."""
        self.unknowns = [ca.SX.sym(symbol.name().removeprefix("initial ")) for symbol in iterated]
        guess_of = {c.symbol.element_hash(): c.guess for c in self._chosen}
        self.guesses = [guess_of[symbol.element_hash()] for symbol in iterated]
        keys = list(self._values)
        everything = [*residuals, *(self._values[key] for key in keys)]
        if iterated and everything:
            replaced = ca.substitute(column(everything), column(iterated), column(self.unknowns))
            everything = [replaced[k] for k in range(len(everything))]
        self.residuals = everything[: len(residuals)]
        self._values = dict(zip(keys, everything[len(residuals) :], strict=True))
        self._values |= {s.element_hash(): i for s, i in zip(iterated, self.unknowns, strict=True)}


def _is_parametric(value: Scalar, parameters: Parameters, iterated: Sequence[Scalar]) -> bool:
    allowed = {v.symbol.element_hash() for v in parameters.settable} | {s.element_hash() for s in iterated}
    return all(symbol.element_hash() in allowed for symbol in ca.symvar(value))


def _discrete_starts(flat: FlatModel, scope: Scope, evaluator: Evaluator, solved: Solved) -> list[Scalar]:
    """A user's value counts for what only when-clauses change; the rest follows from its equation anyway."""
    given = {value.target: value.value for value in flat.initial_values}
    by_when = {equation.target for equation in flat.discrete_equations}
    by_when -= {equation.target for equation in flat.discrete_equations if equation.activation is None}
    starts = start_values(scope.discretes, evaluator)
    result = []
    for variable, start in zip(scope.discretes, starts, strict=True):
        name = variable.flat.name
        if name in given:
            result.append(scalars(evaluator.value(given[name], Frame(False)))[variable.element])
        elif name in by_when and start.is_constant():
            result.append(variable.symbol)
        else:
            result.append(start)
    return solved.replace(result)
