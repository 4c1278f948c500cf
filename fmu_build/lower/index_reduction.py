"""Index reduction: differentiates constraints between states (Pantelides 1988) and gives up the states they fix
(dummy derivatives, Mattsson and Soderlind 1993, with a fixed choice made from StateSelect)."""

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from fmu_build.errors import BuildError, Underdetermined
from fmu_build.lower.equations import ScalarEquation
from fmu_build.lower.scope import ScalarVariable, Scope
from fmu_build.lower.sorting import Matching
from fmu_build.lower.values import Scalar, column

MOST_DIFFERENTIATIONS = 6  # of one equation; mechanics needs two


@dataclass(frozen=True)
class Reduced:
    """A system of index 1: as many equations as unknowns; `given_up` are states no more."""

    equations: list[ScalarEquation]
    unknowns: list[Scalar]
    given_up: list[ScalarVariable]


def is_regular(equations: Sequence[ScalarEquation], unknowns_of: Sequence[Sequence[int]], n_unknowns: int) -> bool:
    """Whether each equation can be matched with an unknown of its own."""
    matching = Matching(n_unknowns)
    return all(not matching.add(number, unknowns_of) for number in range(len(equations)))


def reduce_index(equations: Sequence[ScalarEquation], algebraics: Sequence[Scalar], scope: Scope) -> Reduced:
    """Differentiate until the highest derivatives can be solved for, then choose the states.

    Raises:
        BuildError: the equations contradict each other or leave something undetermined at any index, or an input
            would have to be differentiated.
    """
    system = _Pantelides(equations, algebraics, scope)
    system.run()
    return _choose_states(system, scope)


class _Pantelides:
    """Symbols and equations with their derivatives; `derivative[k]` is the number of the derivative of symbol k."""

    def __init__(self, equations: Sequence[ScalarEquation], algebraics: Sequence[Scalar], scope: Scope) -> None:
        self.equations = list(equations)
        self.symbols = [*(v.symbol for v in scope.states), *scope.derivatives, *algebraics]
        n_states = len(scope.states)
        self.derivative = {k: n_states + k for k in range(n_states)}
        self._number = {symbol.element_hash(): k for k, symbol in enumerate(self.symbols)}
        self.contains = [self._symbols_in(equation.residual) for equation in self.equations]
        self._scope = scope
        self._matching = Matching(len(self.symbols))
        self._depth = [0] * len(self.equations)

    def run(self) -> None:
        for number in range(len(self.equations)):
            current = number
            while met := self._matching.add(current, self._highest()):
                if self._depth[current] == MOST_DIFFERENTIATIONS:
                    raise self._singular(number, met)
                current = self._differentiate(met)[current]

    def _highest(self) -> list[list[int]]:
        return [[k for k in contained if k not in self.derivative] for contained in self.contains]

    def _differentiate(self, met: set[int]) -> dict[int, int]:
        """Differentiate the equations `met` and the unknowns in them; returns the numbers of the new equations."""
        highest = self._highest()
        for unknown in sorted({k for equation in met for k in highest[equation]}):
            symbol = ca.SX.sym(f"der({self.symbols[unknown].name()})")
            self.derivative[unknown] = len(self.symbols)
            self._number[symbol.element_hash()] = len(self.symbols)
            self.symbols.append(symbol)
            self._matching.grow()
        new = {}
        for equation in sorted(met):
            new[equation] = len(self.equations)
            residual = self._total_derivative(self.equations[equation])
            self.equations.append(ScalarEquation(residual, self.equations[equation].span))
            self.contains.append(self._symbols_in(residual))
            self._depth.append(self._depth[equation] + 1)
            if not self.contains[-1]:
                raise self._singular(equation, met)
        for unknown, derivative in self.derivative.items():
            owner = self._matching.equation_of[unknown]
            if owner in new and self._matching.equation_of[derivative] < 0:
                self._matching.match(derivative, new[owner])
        return new

    def _total_derivative(self, equation: ScalarEquation) -> Scalar:
        residual = equation.residual
        for variable in self._scope.inputs:
            if ca.depends_on(residual, variable.symbol):
                raise BuildError(
                    f"this constraint would need the derivative of the input {variable.name}",
                    equation.span.file,
                    equation.span.line,
                )
        contained = [k for k in self._symbols_in(residual) if k in self.derivative]
        before = column([self._scope.time, *(self.symbols[k] for k in contained)])
        rates = column([ca.SX(1), *(self.symbols[self.derivative[k]] for k in contained)])
        return ca.jtimes(residual, before, rates)

    def _symbols_in(self, expression: Scalar) -> list[int]:
        found = (self._number.get(symbol.element_hash()) for symbol in ca.symvar(expression))
        return sorted(k for k in found if k is not None)

    def _singular(self, number: int, met: set[int]) -> BuildError:
        spans = [self.equations[k].span for k in sorted(met)]
        lines = ", ".join(str(line) for line in sorted({s.line for s in spans if s.line is not None}))
        return Underdetermined(
            f"the system is singular: the equations of lines {lines} contradict each other or say the same twice",
            self.equations[number].span.file,
            self.equations[number].span.line,
        )


def _choose_states(system: _Pantelides, scope: Scope) -> Reduced:
    """Every equation needs an unknown: first what cannot be a state, then states, the least preferred first."""
    equations_of: list[list[int]] = [[] for _ in system.symbols]
    for number, contained in enumerate(system.contains):
        for k in contained:
            equations_of[k].append(number)
    candidates = range(len(scope.states))
    others = [k for k in range(len(system.symbols)) if k not in candidates]
    matching = Matching(len(system.equations))
    for k in others:
        if matching.add(k, equations_of):
            raise BuildError(
                f"the constraints between states leave {system.symbols[k].name()} undetermined; "
                "give the model fewer or other constraints"
            )
    ranked = sorted(candidates, key=lambda k: (_preference(scope.states[k]), -k))
    given_up = sorted(k for k in ranked if not matching.add(k, equations_of))
    unknowns = [system.symbols[k] for k in (*others, *given_up)]
    return Reduced(system.equations, unknowns, [scope.states[k] for k in given_up])


def _preference(variable: ScalarVariable) -> tuple[int, bool, bool]:
    """What a modeller wants to keep as a state comes last."""
    return variable.flat.state_select.value, bool(variable.is_fixed), variable.flat.start is not None
