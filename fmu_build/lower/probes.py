"""Probes: further inputs, each added to the right-hand side of one equation, to ask what a missing term would do."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches

import casadi as ca

from fmu_build.errors import BuildError, WrongCall
from fmu_build.front.flat_model import FlatModel, FlatVariable, Role
from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.continuous import square_blocks
from fmu_build.lower.equations import ScalarEquation, incidence
from fmu_build.lower.index_reduction import is_regular, reduce_index
from fmu_build.lower.scope import ScalarVariable, Scope, scalar_names
from fmu_build.lower.shared_units import unit_of
from fmu_build.lower.table import derivative_unit
from fmu_build.lower.values import Scalar

PREFIX = "probe."
GIVEN = "="  # "NAME=VARIABLE": a variable of the class in place of a new input
_MOST_NEAR = 3
_WHY_NOT = {
    Role.CONSTANT: "a constant; a probe goes to a continuous variable",
    Role.STRUCTURAL: "a parameter the compiler has used up; a probe goes to a continuous variable",
    Role.PARAMETER: "a parameter; set it itself (--set, or in the FMU)",
    Role.INPUT: "an input; drive it itself",
    Role.DISCRETE: "a discrete variable; a probe goes to a continuous one",
}


def with_probe_inputs(flat: FlatModel, probes: Sequence[str]) -> FlatModel:
    """The model with an input "probe.NAME" for each name; nothing depends on them yet.

    A probe "NAME=VARIABLE" gets no input: what is added is a variable of the class, with an equation of its own.

    Raises:
        WrongCall: a name is unknown, not that of a continuous variable, or given twice.
    """
    if not probes:
        return flat
    owner = {name: variable for variable in flat.variables for name in scalar_names(variable)}
    added = []
    names = [probe.partition(GIVEN)[0] for probe in probes]
    for k, (name, probe) in enumerate(zip(names, probes, strict=True)):
        if name in names[:k]:
            raise WrongCall(f"the probe {name} is asked for twice; give it once.")
        if name not in owner:
            raise WrongCall(_unknown(name, owner, flat))
        variable = owner[name]
        if variable.role in _WHY_NOT or variable.scalar is not ScalarKind.REAL:
            raise WrongCall(f"no probe can be added to {name}: it is {_WHY_NOT.get(variable.role, 'not Real')}.")
        if GIVEN in probe:
            given = probe.partition(GIVEN)[2]
            if given not in owner or owner[given].role is not Role.ALGEBRAIC:
                raise WrongCall(f"{flat.name} has no continuous variable {given} to add to {name}.")
            continue
        if PREFIX + name in owner:
            raise WrongCall(f"{flat.name} has a variable {PREFIX}{name} already; rename the component 'probe'.")
        added.append(_input(name, variable, unit_of(variable.name, flat)))
    return replace(flat, variables=(*flat.variables, *added))


def add_probes(
    flat: FlatModel, scope: Scope, equations: Sequence[ScalarEquation], probes: Sequence[str]
) -> list[ScalarEquation]:
    """Add each probe to the equation that the sorting solves for its variable, or for a state's derivative.

    That equation, r(NAME) = 0, becomes r(NAME - probe.NAME) = 0: its solution is what it was plus the probe. The
    sorting is that of the model as written, before aliases go: `y = s` is an equation of y like any other.

    Raises:
        BuildError: the variable belongs to an algebraic loop that does not say which equation is its own, or follows
            from a constraint between states.
    """
    if not probes:
        return list(equations)
    owners = _Owners(equations, scope)
    symbols = {v.name: v.symbol for v in scope.algebraics}
    symbols |= {v.name: rate for v, rate in zip(scope.states, scope.derivatives, strict=True)}
    inputs = {v.name: v.symbol for v in scope.inputs}
    result = list(equations)
    for probe in probes:
        name, _, given = probe.partition(GIVEN)
        number = owners.equation(name, symbols[name], flat)
        shifted = symbols[name] - (symbols[given] if given else inputs[PREFIX + name])
        residual = ca.substitute(result[number].residual, symbols[name], shifted)
        result[number] = replace(result[number], residual=residual)
    return result


def _input(name: str, variable: FlatVariable, unit: str | None) -> FlatVariable:
    is_state = variable.role is Role.STATE
    return FlatVariable(
        name=PREFIX + name,
        scalar=ScalarKind.REAL,
        dimensions=(),
        role=Role.INPUT,
        span=variable.span,
        is_input=True,
        unit=derivative_unit(unit) if is_state else unit,
        description=f"Added to {f'der({name})' if is_state else name}; 0 leaves the model as it is",
    )


def _unknown(name: str, owner: dict[str, FlatVariable], flat: FlatModel) -> str:
    candidates = [n for n, v in owner.items() if v.role in (Role.STATE, Role.ALGEBRAIC)]
    near = get_close_matches(name, candidates, _MOST_NEAR)
    last = name.rpartition(".")[2]
    near += [n for n in candidates if n.rpartition(".")[2] == last and n not in near][: _MOST_NEAR - len(near)]
    hint = f"; near it: {', '.join(near)}." if near else "; the FMU's own variable table lists the names."
    return f"{flat.name} has no variable {name} to probe{hint}"


@dataclass(frozen=True)
class _Block:
    equations: list[ScalarEquation]
    unknowns: list[Scalar]


class _Owners:
    """Which equation is solved for which unknown."""

    def __init__(self, equations: Sequence[ScalarEquation], scope: Scope) -> None:
        self._number = {id(equation): k for k, equation in enumerate(equations)}
        unknowns = [*scope.derivatives, *(v.symbol for v in scope.algebraics)]
        self._lost: list[ScalarVariable] = []
        everything = list(equations)
        if not is_regular(everything, incidence(everything, unknowns), len(unknowns)):
            reduced = reduce_index(equations, [v.symbol for v in scope.algebraics], scope)
            everything, unknowns, self._lost = reduced.equations, reduced.unknowns, reduced.given_up
        self._block_of: dict[int, _Block] = {}
        for block in square_blocks(everything, unknowns):
            for symbol in block[1]:
                self._block_of[symbol.element_hash()] = _Block(*block)

    def equation(self, name: str, symbol: Scalar, flat: FlatModel) -> int:
        """The number of the equation solved for `symbol`, which is der(name) where `name` is a state."""
        block = self._block_of.get(symbol.element_hash())
        if block is None or any(state.name == name for state in self._lost):
            raise BuildError(
                f"no probe can be added to {name}: it follows from a constraint between states and has no equation of "
                "its own; probe a force or a flow in its place.",
                flat.span.file,
                flat.span.line,
            )
        own = block.equations if len(block.equations) == 1 else [e for e in block.equations if _gives(e, symbol)]
        if len(own) != 1 or id(own[0]) not in self._number:
            raise _ambiguous(name, block)
        return self._number[id(own[0])]


def _gives(equation: ScalarEquation, symbol: Scalar) -> bool:
    """Whether it is written `symbol = ...`, with more than another name at the right, and without the symbol there."""
    residual = equation.residual
    if residual.is_symbolic() or residual.is_constant() or residual.op() != ca.OP_SUB:
        return False
    left, right = residual.dep(0), residual.dep(1)
    return (
        left.is_symbolic()
        and left.element_hash() == symbol.element_hash()
        and not right.is_symbolic()
        and not ca.depends_on(right, symbol)
    )


def _ambiguous(name: str, block: _Block) -> BuildError:
    names = [symbol.name() for symbol in block.unknowns if symbol.name() not in (name, f"der({name})")]
    more = f" and {len(names) - 4} more" if len(names) > 4 else ""
    lines = ", ".join(map(str, sorted({e.span.line for e in block.equations if e.span.line is not None})))
    with_others = f" (with {', '.join(names[:4])}{more}; lines {lines})" if names else f" (line {lines})"
    return BuildError(
        f"no probe can be added to {name}: it belongs to an algebraic loop{with_others} in which no single equation "
        f"gives it; write one as {name.rpartition('.')[2]} = ..., or probe a variable ahead of the loop.",
        block.equations[0].span.file,
        block.equations[0].span.line,
    )
