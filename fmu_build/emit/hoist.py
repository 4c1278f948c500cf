"""Moves work that depends on parameters alone out of the functions that run at every step.

Each largest subexpression of p and c becomes another calculated parameter, without a row in the variable table: the
run-time system evaluates those once after each change of a parameter.
"""

from dataclasses import dataclass, field, fields, replace

import casadi as ca

from fmu_build.lower.ode_model import OdeModel, Relation
from fmu_build.lower.values import column


def hoist_parameters(model: OdeModel) -> OdeModel:
    """`model` with a longer c, and derivatives, outputs, residual and relations that make use of it."""
    s = model.symbols
    parts = (model.derivatives, model.outputs, model.residual, column([r.value for r in model.relations]))
    hoist = _Hoist([getattr(s, f.name) for f in fields(s)], {f.name: k for k, f in enumerate(fields(s))})
    derivatives, outputs, residual, relations = hoist.rewrite(parts)
    if not hoist.found:
        return model
    follow = ca.Function("follow", [s.p, s.c, s.i], [column(hoist.found)])
    added = follow(s.p, model.calculated, s.i)
    return replace(
        model,
        symbols=replace(s, c=ca.vertcat(s.c, *hoist.symbols)),
        derivatives=derivatives,
        outputs=outputs,
        residual=residual,
        relations=tuple(_with_value(r, relations[k]) for k, r in enumerate(model.relations)),
        calculated=ca.vertcat(model.calculated, added),
    )


def _with_value(relation: Relation, value: ca.SX) -> Relation:
    return replace(relation, value=value)


@dataclass
class _Value:
    """What a register of CasADi's instruction list holds."""

    expression: ca.SX
    is_leaf: bool
    is_constant: bool
    of_parameters: bool  # of p and c, or constant
    name: ca.SX | None = None  # the symbol that stands for it once it is hoisted
    reciprocal: "_Value | None" = None

    def inverse(self) -> "_Value":
        """A division by what does not change becomes a multiplication, which is four times as fast."""
        if self.reciprocal is None:
            self.reciprocal = _Value(1 / self.expression, False, self.is_constant, self.of_parameters)
        return self.reciprocal


@dataclass
class _Hoist:
    arguments: list[ca.SX]
    position: dict[str, int]
    found: list[ca.SX] = field(default_factory=list)
    symbols: list[ca.SX] = field(default_factory=list)

    def rewrite(self, parts: tuple[ca.SX, ...]) -> list[ca.SX]:
        """The same expressions, with symbols in the place of what was hoisted."""
        function = ca.Function("parts", self.arguments, list(parts))
        register: dict[int, _Value] = {}
        results = [ca.SX(part.sparsity(), 0) if part.nnz() else part for part in parts]
        for k in range(function.n_instructions()):
            operation = function.instruction_id(k)
            if operation == ca.OP_OUTPUT:
                result, element = function.instruction_output(k)
                results[result].nz[element] = self._used(register[function.instruction_input(k)[0]])
            else:
                register[function.instruction_output(k)[0]] = self._evaluated(function, k, operation, register)
        return results

    def _evaluated(self, function: ca.Function, k: int, operation: int, register: dict[int, _Value]) -> _Value:
        if operation == ca.OP_CONST:
            return _Value(ca.SX(function.instruction_constant(k)), True, True, True)
        if operation == ca.OP_INPUT:
            argument, element = function.instruction_input(k)
            of_parameters = argument in (self.position["p"], self.position["c"])
            return _Value(self.arguments[argument].nz[element], True, False, of_parameters)
        operands = [register[j] for j in function.instruction_input(k)]
        if all(operand.of_parameters for operand in operands):
            constant = all(operand.is_constant for operand in operands)
            return _Value(_apply(operation, [o.expression for o in operands]), False, constant, True)
        if operation == ca.OP_DIV and operands[1].of_parameters:
            return _Value(self._used(operands[0]) * self._used(operands[1].inverse()), False, False, False)
        return _Value(_apply(operation, [self._used(o) for o in operands]), False, False, False)

    def _used(self, value: _Value) -> ca.SX:
        """How an expression that changes all the time refers to a value: here the largest ones end."""
        if not value.of_parameters or value.is_leaf or value.is_constant:
            return value.expression
        if value.name is None:
            value.name = ca.SX.sym(f"hoisted_{len(self.found)}")
            self.found.append(value.expression)
            self.symbols.append(value.name)
        return value.name


def _apply(operation: int, operands: list[ca.SX]) -> ca.SX:
    if len(operands) == 1:
        return ca.SX.unary(operation, *operands)
    return ca.SX.binary(operation, *operands)
