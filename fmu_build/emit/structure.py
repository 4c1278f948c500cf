"""ModelStructure of FMI: the outputs, derivatives, event indicators and initial unknowns with what they depend on."""

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca

from fmu_build.emit.influence import Influence, Layout, direct_influence, initial_influence, running_influence
from fmu_build.emit.table import derivative_rows, indicator_rows
from fmu_build.lower.ode_model import OdeModel, ScalarType, Variable


@dataclass(frozen=True)
class Unknown:
    """A row of the variable table, the rows it depends on (ascending), and how; no kinds where none are claimed."""

    row: int
    dependencies: tuple[int, ...]
    kinds: tuple[str, ...] | None


@dataclass(frozen=True)
class ModelStructure:
    outputs: tuple[Unknown, ...]
    derivatives: tuple[Unknown, ...]  # in the order of x
    event_indicators: tuple[Unknown, ...]
    initial_unknowns: tuple[Unknown, ...]  # by row
    held: tuple[int, ...] = ()  # rows that depend on a Real which an event set and which stays until the next
    delayed: tuple[int, ...] = ()  # rows that depend on what delay() remembers


def model_structure(model: OdeModel) -> ModelStructure:
    """The structure of a model whose variable table is complete (`complete_table`)."""
    states = derivative_rows(model)
    outputs = [row for row, variable in enumerate(model.variables) if variable.causality == "output"]
    knowns = _running_knowns(model, [state for state, _ in states])
    frozen = _Running(model, knowns, running_influence(model, through_discrete=False))
    updated = _Running(model, knowns, running_influence(model, through_discrete=True))
    return ModelStructure(
        outputs=tuple(updated.unknown(row) for row in outputs),
        derivatives=tuple(frozen.unknown(row) for _, row in states),
        event_indicators=tuple(frozen.unknown(row) for row in indicator_rows(model)),
        initial_unknowns=_initial_unknowns(model, states),
        held=frozen.held(),
        delayed=frozen.delayed(),
    )


class _Expressions:
    """The value of a variable as an expression, and as a set of symbols."""

    def __init__(self, model: OdeModel) -> None:
        s = model.symbols
        self.layout = Layout.of(s)
        self._values = {name: getattr(s, name) for name in ("t", "p", "c", "x", "u", "d")}
        self._values |= {"dx": model.derivatives, "w": model.outputs}
        self._masks = {name: direct_influence(s, value) for name, value in self._values.items()}

    def mask(self, variable: Variable) -> int:
        return self._masks[variable.vector][variable.index]

    def value(self, variable: Variable) -> ca.SX:
        return self._values[variable.vector][variable.index]


def _running_knowns(model: OdeModel, states: list[int]) -> list[int]:
    """Time, inputs and continuous states."""
    inputs = [row for row, variable in enumerate(model.variables) if variable.causality == "input"]
    return sorted({0, *inputs, *states})


class _Running:
    """Dependencies and their kinds after initialisation."""

    def __init__(self, model: OdeModel, knowns: list[int], influence: Influence) -> None:
        self._model = model
        self._knowns = knowns
        self._influence = influence
        self._expressions = _Expressions(model)
        self._bits = {row: _bit(self._expressions.layout, model.variables[row]) for row in knowns}
        s = model.symbols
        mask = self._expressions.layout.vector_mask
        self._implicit = mask("q", s.q.numel()) | mask("v", s.v.numel()) | mask("d", s.d.numel())
        self._relations = mask("r", s.r.numel())
        self._fixed = _parameter_bits(model, self._expressions.layout, {"constant", "fixed"})
        self._tunable = _parameter_bits(model, self._expressions.layout, {"constant", "fixed", "tunable"})
        self._discrete = self._tunable | self._relations | mask("d", s.d.numel())

    def unknown(self, row: int) -> Unknown:
        variable = self._model.variables[row]
        direct = self._expressions.mask(variable)
        reached = self._influence.followed(direct)
        rows = tuple(known for known in self._knowns if self._bits[known] & reached)
        return Unknown(row, rows, tuple(self._kind(variable, direct, known) for known in rows))

    def held(self) -> tuple[int, ...]:
        """Rows whose value depends on a Real that events set, conditions included."""
        s, layout = self._model.symbols, self._expressions.layout
        counts = {v.index for v in self._model.variables if v.vector == "d" and v.scalar_type is not ScalarType.REAL}
        held = [k for k in range(s.d.numel()) if k not in counts]
        return self._reaching(sum(layout.bit(vector, k) for vector in ("d", "pre_d") for k in held))

    def delayed(self) -> tuple[int, ...]:
        """Rows whose value depends on a delayed one."""
        return self._reaching(self._expressions.layout.vector_mask("v", self._model.symbols.v.numel()))

    def _reaching(self, bits: int) -> tuple[int, ...]:
        """Rows whose value depends on one of these symbols."""
        reached = (self._influence.followed(self._expressions.mask(one)) for one in self._model.variables)
        return tuple(row for row, mask in enumerate(reached) if mask & bits)

    def _kind(self, variable: Variable, direct: int, known: int) -> str:
        """How the factor of the known variable may change; "dependent" where the relation is not linear."""
        bit = self._bits[known]
        if variable.scalar_type is not ScalarType.REAL or bit & self._influence.followed(direct & self._implicit):
            return "dependent"
        symbol = self._expressions.value(self._model.variables[known])
        factor = ca.jacobian(self._expressions.value(variable), symbol)
        mask = direct_influence(self._model.symbols, ca.densify(factor))[0]
        if bit & self._influence.followed(direct & self._relations):
            return "discrete" if not mask & ~self._discrete else "dependent"
        for kind, allowed in (
            ("constant", 0),
            ("fixed", self._fixed),
            ("tunable", self._tunable),
            ("discrete", self._discrete),
        ):
            if not mask & ~allowed:
                return kind
        return "dependent"


def _initial_unknowns(model: OdeModel, states: list[tuple[int, int]]) -> tuple[Unknown, ...]:
    """What initialisation computes, in terms of what the user may set before it; no kinds are claimed."""
    influence, expressions = initial_influence(model), _Expressions(model)
    knowns = [
        (row, _bit(expressions.layout, variable))
        for row, variable in enumerate(model.variables)
        if variable.causality in ("independent", "input") or variable.initial == "exact"
        if variable.vector in ("t", "u", "p", "x", "d")
    ]
    unknowns = []
    for row in _initial_rows(model, states):
        reached = influence.followed(expressions.mask(model.variables[row]))
        unknowns.append(Unknown(row, tuple(known for known, bit in knowns if bit & reached and known != row), None))
    return tuple(unknowns)


def _initial_rows(model: OdeModel, states: list[tuple[int, int]]) -> list[int]:
    in_states = {row for pair in states for row in pair}
    return [
        row
        for row, variable in enumerate(model.variables)
        if variable.causality == "calculatedParameter"
        or (variable.initial == "calculated" and (variable.causality == "output" or row in in_states))
    ]


def _bit(layout: Layout, variable: Variable) -> int:
    return layout.bit(variable.vector, variable.index)


def _parameter_bits(model: OdeModel, layout: Layout, variabilities: Iterable[str]) -> int:
    """Symbols of p and c that are known to change no more often than that."""
    allowed = set(variabilities)
    result = 0
    for variable in model.variables:
        if variable.vector in ("p", "c") and variable.variability in allowed:
            result |= _bit(layout, variable)
    return result
