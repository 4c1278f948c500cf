"""Constants and parameters: which a user may set (p), which follow from others (c), which are plain numbers."""

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.flat_model import FlatModel, FlatVariable, Role
from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.evaluate import Evaluator, Frame
from fmu_build.lower.scope import ScalarVariable, scalar_names, shaped
from fmu_build.lower.sorting import blocks
from fmu_build.lower.values import Scalar, Value, scalars

PARAMETER_ROLES = (Role.CONSTANT, Role.STRUCTURAL, Role.PARAMETER)


@dataclass(frozen=True, eq=False)
class Calculated:
    """A parameter kept in c; `value` is in p, c and unknowns of initialisation."""

    variable: ScalarVariable
    value: Scalar


class Parameters:
    """The parameters of a model, evaluated when first referred to, so that their order does not matter.

    `settable` become p with the numbers in `starts`; `calculated` become c, in an order in which each follows from
    those before it; `free` are those of the latter that the initial equations determine (fixed = false).
    """

    def __init__(self, flat: FlatModel, evaluator: Evaluator) -> None:
        self._evaluator = evaluator
        self._variables = {v.name: v for v in flat.variables if v.role in PARAMETER_ROLES}
        self._given = {value.target: value.value for value in flat.initial_values if value.target in self._variables}
        self._values: dict[str, Value] = {}
        self._in_progress: list[str] = []
        self.settable: list[ScalarVariable] = []
        self.starts: list[float] = []
        self.calculated: list[Calculated] = []
        self.free: list[ScalarVariable] = []

    def evaluate_all(self) -> None:
        for name in self._in_order():
            if self._variables[name].scalar is not ScalarKind.STRING:
                self.value(name)

    def __contains__(self, name: str) -> bool:
        return name in self._variables

    def value(self, name: str) -> Value:
        """The symbol or number of a parameter."""
        if name not in self._values:
            variable = self._variables[name]
            if name in self._in_progress:
                raise BuildError(
                    f"the values of {', '.join(self._in_progress)} depend on each other",
                    variable.span.file,
                    variable.span.line,
                )
            self._in_progress.append(name)
            self._values[name] = self._evaluate(variable)
            self._in_progress.pop()
        return self._values[name]

    def _in_order(self) -> list[str]:
        """All names, each behind those that its value refers to: a long chain needs no deep recursion."""
        names = list(self._variables)
        numbers = {name: k for k, name in enumerate(names)}
        values = [self._value_of(variable) for variable in self._variables.values()]
        used = [() if value is None else ex.references(value) for value in values]
        order = blocks([[numbers[name] for name in found if name in numbers] for found in used])
        return [names[k] for block in order for k in block]

    def _value_of(self, variable: FlatVariable) -> ex.Expression | None:
        return self._given.get(variable.name, variable.binding) or variable.start

    def _evaluate(self, variable: FlatVariable) -> Value:
        if variable.scalar is ScalarKind.STRING:
            return self._text(variable)
        names = scalar_names(variable)
        bindings = self._bindings(variable, len(names))
        values = [self._scalar(variable, k, name, bindings[k]) for k, name in enumerate(names)]
        return shaped(values, variable)

    def _text(self, variable: FlatVariable) -> str:
        binding = variable.binding or variable.start
        return "" if binding is None else str(self._evaluator.value(binding, Frame(False)))

    def _bindings(self, variable: FlatVariable, size: int) -> list[Scalar | None]:
        is_free = variable.fixed is not None and not all(variable.fixed)
        if is_free and variable.name not in self._given and variable.binding is None:
            return [None] * size
        expression = self._value_of(variable)
        if expression is None:
            raise BuildError(
                f"{variable.name} has no value; give one in the model, or with --set {variable.name}=",
                variable.span.file,
                variable.span.line,
            )
        values = scalars(self._evaluator.value(expression, Frame(False)))
        return list(values) if len(values) == size else [values[0]] * size

    def _scalar(self, variable: FlatVariable, element: int, name: str, binding: Scalar | None) -> Scalar:
        """Sorts one scalar in and returns what stands for it in expressions."""
        scalar = ScalarVariable(name, variable, element, ca.SX.sym(name))
        if binding is None:
            unknown = ca.SX.sym(f"initial {name}")
            self.free.append(ScalarVariable(name, variable, element, unknown))
            self.calculated.append(Calculated(scalar, unknown))
            return scalar.symbol
        if binding.is_constant() and variable.role is Role.PARAMETER and variable.name not in self._given:
            self.settable.append(scalar)
            self.starts.append(float(binding))
            return scalar.symbol
        self.calculated.append(Calculated(scalar, binding))
        return binding if binding.is_constant() else scalar.symbol

    def explicit(self, free: Mapping[int, Scalar]) -> list[Scalar]:
        """c (n_c), each in p and unknowns of initialisation alone; `free` gives the free parameters."""
        symbols = [*(v.symbol for v in self.free), *(c.variable.symbol for c in self.calculated)]
        values = [*(free[v.symbol.element_hash()] for v in self.free), *(c.value for c in self.calculated)]
        return explicit(symbols, values, [])[0][len(self.free) :]


def explicit(symbols: list[Scalar], values: list[Scalar], others: list[Scalar]) -> tuple[list[Scalar], list[Scalar]]:
    """Replace `symbols[k]` by `values[k]`, which may use the symbols before it, in all values and in `others`."""
    if not symbols:
        return [], others
    solved, rest = ca.substitute_inplace(list(symbols), list(values), list(others), False)
    return list(solved), list(rest)


def start_expression(node: ex.Expression | None, evaluator: Evaluator, size: int) -> list[Scalar | None]:
    """An attribute, element by element; None where the model is silent."""
    if node is None:
        return [None] * size
    values = scalars(evaluator.value(node, Frame(False)))
    return list(values) if len(values) == size else [values[0]] * size
