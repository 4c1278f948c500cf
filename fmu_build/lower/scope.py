"""The scalar variables of a flat model and the symbols they stand for."""

from dataclasses import dataclass

import casadi as ca
import numpy as np

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.flat_model import FlatModel, FlatVariable, Role
from fmu_build.lower.values import Scalar, Value, array


@dataclass(frozen=True, eq=False)
class ScalarVariable:
    """One element of a variable; `element` counts row-major from 0."""

    name: str
    flat: FlatVariable
    element: int
    symbol: Scalar

    @property
    def is_fixed(self) -> bool | None:
        """The attribute `fixed`, None where it is not given."""
        fixed = self.flat.fixed
        return None if fixed is None else fixed[self.element if len(fixed) > 1 else 0]


def scalar_names(variable: FlatVariable) -> list[str]:
    """`A[1,2]` and so on, row-major; the bare name of a scalar."""
    if not variable.dimensions:
        return [variable.name]
    return [f"{variable.name}[{','.join(str(i + 1) for i in index)}]" for index in np.ndindex(*variable.dimensions)]


def shaped(values: list[Scalar], variable: FlatVariable) -> Value:
    return array(values).reshape(variable.dimensions) if variable.dimensions else values[0]


class Scope:
    """Symbols of everything that is not a parameter, by name and as lists in the model's order."""

    def __init__(self, flat: FlatModel) -> None:
        self.time = ca.SX.sym("time")
        self.states: list[ScalarVariable] = []
        self.algebraics: list[ScalarVariable] = []
        self.inputs: list[ScalarVariable] = []
        self.discretes: list[ScalarVariable] = []
        self.derivatives: list[Scalar] = []
        self.given_up: list[ScalarVariable] = []
        self.pre_discretes: list[Scalar] = []
        self._values: dict[tuple[str, ex.Form], Value] = {}
        for variable in flat.variables:
            self.add(variable)

    def reference(self, name: str, form: ex.Form, span: ex.Span) -> Value:
        found = self._values.get((name, form))
        if found is None:
            raise BuildError(f"{form.value} of {name} is not supported here", span.file, span.line)
        return found

    def give_up(self, variables: list[ScalarVariable]) -> None:
        """Turn states that index reduction found to follow from others into algebraic variables."""
        kept = [k for k, state in enumerate(self.states) if state not in variables]
        self.algebraics += variables
        self.given_up += variables
        self.states = [self.states[k] for k in kept]
        self.derivatives = [self.derivatives[k] for k in kept]

    def add(self, variable: FlatVariable) -> None:
        """Give a variable its symbols; parameters are not kept here."""
        lists = {
            Role.STATE: self.states,
            Role.ALGEBRAIC: self.algebraics,
            Role.INPUT: self.inputs,
            Role.DISCRETE: self.discretes,
        }
        if variable.role not in lists:
            return
        names = scalar_names(variable)
        symbols = [ca.SX.sym(name) for name in names]
        lists[variable.role] += [
            ScalarVariable(name, variable, element, symbol)
            for element, (name, symbol) in enumerate(zip(names, symbols, strict=True))
        ]
        self._values[variable.name, ex.Form.VALUE] = shaped(symbols, variable)
        if variable.role is Role.STATE:
            derivatives = [ca.SX.sym(f"der({name})") for name in names]
            self.derivatives += derivatives
            self._values[variable.name, ex.Form.DERIVATIVE] = shaped(derivatives, variable)
            # At an event the state is its own left limit until it is reinitialised.
            self._values[variable.name, ex.Form.PRE] = shaped(symbols, variable)
        if variable.role is Role.DISCRETE:
            before = [ca.SX.sym(f"pre({name})") for name in names]
            self.pre_discretes += before
            self._values[variable.name, ex.Form.PRE] = shaped(before, variable)
