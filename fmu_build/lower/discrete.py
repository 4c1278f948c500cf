"""Discrete equations, when-clauses and their actions: what one pass of the event iteration changes."""

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.flat_model import Activation, FlatModel
from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.continuous import Solved
from fmu_build.lower.evaluate import Evaluator, Frame
from fmu_build.lower.events import Events
from fmu_build.lower.ode_model import Check
from fmu_build.lower.parameters import explicit
from fmu_build.lower.scope import ScalarVariable, Scope
from fmu_build.lower.sorting import blocks
from fmu_build.lower.values import Scalar, Value, choose, column, scalars


@dataclass(frozen=True)
class Updates:
    """Results of one pass: discrete variables, when-conditions with their earlier values, states, and messages."""

    discretes: list[Scalar]
    conditions: list[Scalar]
    pre_conditions: list[Scalar]
    states: list[Scalar]
    checks: list[Check]
    terminations: list[Check]

    def changed_at_start(self, scope: Scope, initial: Scalar) -> set[int]:
        """Hashes of the states and discrete variables that the event of initialisation may change."""
        symbols = [v.symbol for v in (*scope.states, *scope.discretes)]
        if not symbols:
            return set()
        before = [*(v.symbol for v in scope.states), *scope.pre_discretes]
        after = ca.substitute(column([*self.states, *self.discretes]), initial, ca.SX(1))
        return {s.element_hash() for k, s in enumerate(symbols) if not ca.is_equal(after[k], before[k])}


class DiscretePart:
    """Reads the discrete part of a model; `updates` gives it in terms of what is known at an event."""

    def __init__(self, flat: FlatModel, scope: Scope, events: Events, evaluator: Evaluator) -> None:
        self._flat, self._scope, self._events, self._evaluator = flat, scope, events, evaluator
        self._frame = Frame()
        self.conditions: list[Scalar] = []
        self.pre_conditions: list[Scalar] = []
        self._active = self._read_clauses()
        self._raw_checks = [self._check(k) for k in range(len(flat.assertions))]
        self._raw_terminations = [
            Check(self._is_active(t.activation), self._message(t.message)) for t in flat.terminations
        ]

    def updates(self, solved: Solved) -> Updates:
        """One pass, with algebraic variables, derivatives and new discrete values put in."""
        raw_states = self._reinitialised_states()
        raw_discretes = self._new_discretes()
        samples = self._events.samples
        parts = [
            raw_discretes,
            [*self.conditions, *(sample.flag for sample in samples)],
            raw_states,
            [check.condition for check in self._raw_terminations],
        ]
        flat_list = solved.replace([value for part in parts for value in part])
        n_d = len(raw_discretes)
        new, rest = self._sorted_discretes(flat_list[:n_d], flat_list[n_d:])
        sizes = [len(part) for part in parts[1:]]
        conditions, states, terminations = rest[: sizes[0]], rest[sizes[0] : sum(sizes[:2])], rest[sum(sizes[:2]) :]
        checked = solved.replace([check.condition for check in self._raw_checks])
        return Updates(
            discretes=new,
            conditions=conditions,
            pre_conditions=[*self.pre_conditions, *(sample.before for sample in samples)],
            states=states,
            checks=[Check(c, k.message, k.is_warning) for c, k in zip(checked, self._raw_checks, strict=True)],
            terminations=[Check(c, k.message) for c, k in zip(terminations, self._raw_terminations, strict=True)],
        )

    def _read_clauses(self) -> list[Scalar]:
        """For each when-branch whether it is active: a condition has become true, and no branch before it is."""
        active: list[Scalar] = []
        taken: list[Scalar] = []  # this branch or one before it in its chain
        for clause in self._flat.clauses:
            rises = ca.SX(0)
            for condition in clause.conditions:
                rises = ca.logic_or(rises, self._rise(condition))
            before = ca.SX(0) if clause.previous is None else taken[clause.previous]
            active.append(ca.logic_and(rises, ca.logic_not(before)))
            taken.append(ca.logic_or(before, rises))
        return active

    def _rise(self, condition: ex.Expression) -> Scalar:
        """The condition has just become true. During initialisation only initial() counts (Modelica 8.6)."""
        holds = self._evaluator.value(condition, self._frame)
        before = ca.SX.sym(f"pre(when {len(self.conditions)})")
        self.conditions.append(holds)
        self.pre_conditions.append(before)
        edge = ca.logic_and(holds, ca.logic_not(before))
        return edge if isinstance(condition, ex.Initial) else ca.logic_and(edge, ca.logic_not(self._events.initial))

    def _is_active(self, activation: Activation) -> Scalar:
        active = self._active[activation.clause]
        if activation.guard is None:
            return active
        return ca.logic_and(active, self._evaluator.value(activation.guard, self._frame))

    def _new_discretes(self) -> list[Scalar]:
        """New values in the order of `scope.discretes`, to which evaluation may add hidden variables."""
        values: list[Scalar] = []
        while len(values) < len(self._scope.discretes):
            first = self._scope.discretes[len(values)]
            values += self._new_values(first)
        return values

    def _new_values(self, first: ScalarVariable) -> list[Scalar]:
        """New values of all elements of the variable whose first element is given."""
        name, span = first.flat.name, first.flat.span
        if name in self._events.hidden:
            return [self._events.hidden[name]]
        equations = [equation for equation in self._flat.discrete_equations if equation.target == name]
        if not equations:
            raise BuildError(f"there is no equation for the discrete variable {name}", span.file, span.line)
        result: Value = self._scope.reference(name, ex.Form.PRE, span)
        for equation in reversed(equations):
            value = self._evaluator.value(equation.value, self._frame)
            activation = equation.activation
            result = value if activation is None else choose(self._is_active(activation), value, result)
        return scalars(result)

    def _reinitialised_states(self) -> list[Scalar]:
        for reinit in self._flat.reinits:
            if any(variable.flat.name == reinit.state for variable in self._scope.given_up):
                raise BuildError(
                    f"{reinit.state} cannot be reinitialised: it follows from others; give it StateSelect.always",
                    reinit.span.file,
                    reinit.span.line,
                )
        return [self._reinitialised(variable) for variable in self._scope.states]

    def _reinitialised(self, variable: ScalarVariable) -> Scalar:
        result = variable.symbol
        for reinit in reversed(self._flat.reinits):
            if reinit.state == variable.flat.name:
                value = scalars(self._evaluator.value(reinit.value, self._frame))[variable.element]
                result = choose(self._is_active(reinit.activation), value, result)
        return result

    def _check(self, number: int) -> Check:
        """Inside a when-clause the outcome is kept in a hidden variable, as checks are looked at after the event."""
        assertion = self._flat.assertions[number]
        violated = self._evaluator.value(assertion.violation, Frame(False))
        if assertion.clause is not None:
            kept, before = self._events.hide(f"'violated {number + 1}'", ScalarKind.BOOLEAN, assertion.span)
            self._events.hidden[kept.name()] = choose(self._active[assertion.clause], violated, before)
            violated = kept
        holds: Scalar = ca.logic_not(violated)
        return Check(holds, self._message(assertion.message), assertion.is_warning)

    def _message(self, message: ex.Expression) -> str:
        text = self._evaluator.value(message, Frame(False))
        return text if isinstance(text, str) else str(text)

    def _sorted_discretes(self, values: Sequence[Scalar], others: list[Scalar]) -> tuple[list[Scalar], list[Scalar]]:
        """Put the new discrete values into each other, so that one pass sees them all."""
        variables = self._scope.discretes
        if not variables:
            return [], others
        number = {variable.symbol.element_hash(): k for k, variable in enumerate(variables)}
        successors = [
            sorted({number[s.element_hash()] for s in ca.symvar(value) if s.element_hash() in number})
            for value in values
        ]
        order = []
        for block in blocks(successors):
            if len(block) > 1 or block[0] in successors[block[0]]:
                raise self._loop([variables[k] for k in block])
            order.append(block[0])
        symbols = [variables[k].symbol for k in order]
        solved, rest = explicit(symbols, [values[k] for k in order], others)
        new = dict(zip(order, solved, strict=True))
        return [new[k] for k in range(len(variables))], rest

    def _loop(self, variables: list[ScalarVariable]) -> BuildError:
        names = ", ".join(variable.name for variable in variables)
        span = variables[0].flat.span
        return BuildError(f"the discrete variables {names} depend on each other; use pre()", span.file, span.line)
