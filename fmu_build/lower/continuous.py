"""The continuous equations in an order in which each block follows from those before it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import casadi as ca

from fmu_build.errors import BuildError, Underdetermined
from fmu_build.front.flat_model import FlatModel
from fmu_build.lower.equations import Definition, ScalarEquation, eliminate_aliases, incidence
from fmu_build.lower.evaluate import Evaluator, Frame
from fmu_build.lower.index_reduction import is_regular, reduce_index
from fmu_build.lower.parameters import explicit
from fmu_build.lower.scope import Scope
from fmu_build.lower.singular import Typical
from fmu_build.lower.solve import solve_block
from fmu_build.lower.sorting import Matching, blocks
from fmu_build.lower.values import Scalar, column, scalars


@dataclass(frozen=True)
class Solved:
    """Derivatives and algebraic variables in terms of what is known and of the iteration variables.

    `symbols[k]` may be replaced by `values[k]`, which is explicit; `residuals = 0` gives `unknowns`. Those that are
    `constrained` belong to a block that gives former states from states.
    """

    symbols: list[Scalar]
    values: list[Scalar]
    unknowns: list[Scalar]
    residuals: list[Scalar]
    constrained: list[bool]

    def replace(self, expressions: Sequence[Scalar]) -> list[Scalar]:
        """The same expressions without derivatives and algebraic variables."""
        if not self.symbols or not expressions:
            return list(expressions)
        result = ca.substitute(column(expressions), column(self.symbols), column(self.values))
        return [result[k] for k in range(len(expressions))]


def scalar_equations(flat: FlatModel, evaluator: Evaluator) -> list[ScalarEquation]:
    """The continuous equations of the model, one per scalar."""
    return [
        ScalarEquation(residual, equation.span)
        for equation in flat.equations
        for value in evaluator.elements(equation.residual, equation.domain, Frame())
        for residual in scalars(value)
    ]


def solve_continuous(
    flat: FlatModel, scope: Scope, equations: Sequence[ScalarEquation], typical: Typical = dict
) -> Solved:
    """Sort and solve the equations for derivatives and algebraic variables.

    Args:
        typical: values of a run, for which the system should not be singular.
    Raises:
        BuildError: not as many equations as unknowns, or a part of the system is singular.
    """
    algebraics = [variable.symbol for variable in scope.algebraics]
    if len(equations) != len(algebraics) + len(scope.derivatives):
        raise Underdetermined(
            f"{flat.name} has {len(equations)} equations for {len(algebraics) + len(scope.derivatives)} unknowns",
            flat.span.file,
            flat.span.line,
        )
    has_start = {v.symbol.element_hash(): v.flat.start is not None for v in (*scope.algebraics, *scope.states)}
    equations, unknowns, aliases = _index_one(equations, algebraics, scope, has_start)
    given_up = {variable.symbol.element_hash() for variable in scope.given_up}
    definitions: list[Definition] = []
    iterated: list[Scalar] = []
    residuals: list[Scalar] = []
    constrained: list[bool] = []
    for block_equations, block_unknowns in square_blocks(equations, unknowns):
        keep = [has_start.get(symbol.element_hash(), False) for symbol in block_unknowns]
        solution = solve_block(block_equations, block_unknowns, keep, typical)
        definitions += solution.definitions
        iterated += solution.unknowns
        residuals += solution.residuals
        is_constrained = any(symbol.element_hash() in given_up for symbol in block_unknowns)
        constrained += [is_constrained] * len(solution.unknowns)
    definitions += aliases
    symbols = [definition.symbol for definition in definitions]
    values, residuals = explicit(symbols, [definition.value for definition in definitions], residuals)
    return Solved(symbols, values, iterated, residuals, constrained)


def _index_one(
    equations: Sequence[ScalarEquation], algebraics: Sequence[Scalar], scope: Scope, has_start: Mapping[int, bool]
) -> tuple[list[ScalarEquation], list[Scalar], list[Definition]]:
    """Equations that determine the unknowns, without aliases; differentiated where states constrain each other."""

    def rank(symbols: Sequence[Scalar]) -> list[int]:
        # Derivatives go first: an algebraic variable may carry a start value and can be asked for.
        return [1 + has_start[s.element_hash()] if s.element_hash() in has_start else 0 for s in symbols]

    unknowns = [*scope.derivatives, *algebraics]
    plain = eliminate_aliases(equations, unknowns, rank(unknowns))
    if is_regular(plain[0], incidence(plain[0], plain[1]), len(plain[1])):
        return plain
    # Derivatives have to stay visible while equations are differentiated.
    equations, algebraics, first = eliminate_aliases(equations, algebraics, rank(algebraics))
    reduced = reduce_index(equations, algebraics, scope)
    scope.give_up(reduced.given_up)
    equations, unknowns, second = eliminate_aliases(reduced.equations, reduced.unknowns, rank(reduced.unknowns))
    return equations, unknowns, [*second, *first]


def square_blocks(
    equations: Sequence[ScalarEquation], unknowns: Sequence[Scalar]
) -> list[tuple[list[ScalarEquation], list[Scalar]]]:
    """Square blocks in solution order."""
    unknowns_of = incidence(equations, unknowns)
    matching = Matching(len(unknowns))
    for number, equation in enumerate(equations):
        met = matching.add(number, unknowns_of)
        if met:
            raise _singular(equation, [equations[k] for k in sorted(met)], len(met))
    unknown_of = {equation: unknown for unknown, equation in enumerate(matching.equation_of)}
    successors = [
        [matching.equation_of[unknown] for unknown in unknowns_of[number] if matching.equation_of[unknown] != number]
        for number in range(len(equations))
    ]
    return [([equations[k] for k in block], [unknowns[unknown_of[k]] for k in block]) for block in blocks(successors)]


def _singular(equation: ScalarEquation, together: list[ScalarEquation], count: int) -> BuildError:
    lines = sorted({e.span.line for e in together if e.span.line is not None})
    return Underdetermined(
        f"{count} equations (lines {', '.join(map(str, lines))}) determine too few unknowns: the system is singular",
        equation.span.file,
        equation.span.line,
    )
