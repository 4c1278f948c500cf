"""Collects what makes events: relations, samples, delays; and stands for the variables during evaluation."""

from dataclasses import dataclass, field

import casadi as ca

from fmu_build.front import expression as ex
from fmu_build.front.flat_model import FlatVariable, Role
from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.parameters import Parameters
from fmu_build.lower.scope import Scope
from fmu_build.lower.values import Scalar, Value, choose

_Key = tuple[str, tuple[int, ...]]


@dataclass
class RawRelation:
    """A relation and its symbol, before the unknowns in it are replaced by their solution."""

    symbol: Scalar
    value: Scalar
    strict: bool


@dataclass
class RawSample:
    """A clock: `ticks` is 1 in the first pass of the event it makes, `flag` during the whole event."""

    flag: Scalar
    before: Scalar
    start: Scalar
    interval: Scalar

    @property
    def ticks(self) -> Scalar:
        return ca.logic_and(self.flag, ca.logic_not(self.before))


@dataclass
class RawDelay:
    symbol: Scalar
    source: Scalar
    time: Scalar
    maximum: Scalar


@dataclass
class Events:
    """The surroundings expressions are evaluated in (see `evaluate.Surroundings`)."""

    scope: Scope
    parameters: Parameters = field(init=False)
    relations: list[RawRelation] = field(default_factory=list)
    samples: list[RawSample] = field(default_factory=list)
    delays: list[RawDelay] = field(default_factory=list)
    hidden: dict[str, Scalar] = field(default_factory=dict)
    hidden_variables: list[FlatVariable] = field(default_factory=list)
    initial: Scalar = field(default_factory=lambda: ca.SX.sym("initial()"))
    terminal: Scalar = field(default_factory=lambda: ca.SX.sym("terminal()"))

    def __post_init__(self) -> None:
        self._relation_of: dict[tuple[_Key, bool], Scalar] = {}
        self._sample_of: dict[tuple[_Key, _Key], Scalar] = {}
        self._delay_of: dict[int, Scalar] = {}
        self._floor_of: dict[_Key, Scalar] = {}
        scope = self.scope
        fast = [scope.time, *(v.symbol for v in (*scope.states, *scope.algebraics, *scope.inputs)), *scope.derivatives]
        self._fast = {symbol.element_hash() for symbol in fast}

    @property
    def time(self) -> Scalar:
        return self.scope.time

    def reference(self, name: str, form: ex.Form, span: ex.Span) -> Value:
        if form is ex.Form.VALUE and name in self.parameters:
            return self.parameters.value(name)
        return self.scope.reference(name, form, span)

    def relation(self, value: Scalar, strict: bool) -> Scalar:
        """The symbol of a relation; one between values that change at events only is no relation."""
        if not self._is_fast(value):
            return value > 0 if strict else value >= 0
        key = _key(value), strict
        if key not in self._relation_of:
            symbol = ca.SX.sym(f"r{len(self.relations)}")
            self.relations.append(RawRelation(symbol, value, strict))
            self._relation_of[key] = symbol
        return self._relation_of[key]

    def _is_fast(self, value: Scalar) -> bool:
        """Whether the value can change between events."""
        return any(symbol.element_hash() in self._fast for symbol in ca.symvar(value))

    def jump(self, name: str, arguments: list[Scalar], span: ex.Span) -> Scalar:
        """floor(), ceil(), integer(), div(), mod() and rem(), held between the events at their jumps."""
        if name in ("floor", "integer"):
            return self._floor(arguments[0], span)
        if name == "ceil":
            return -self._floor(-arguments[0], span)
        x, y = arguments
        if name == "mod":
            return x - self._floor(x / y, span) * y
        truncated = choose(self.relation(x / y, strict=False), self._floor(x / y, span), -self._floor(-x / y, span))
        return truncated if name == "div" else x - truncated * y

    def _floor(self, value: Scalar, span: ex.Span) -> Scalar:
        """A discrete variable m with m <= value < m + 1."""
        if not self._is_fast(value):
            return ca.floor(value)
        key = _key(value)
        if key not in self._floor_of:
            floor, before = self.hide(f"'floor {len(self._floor_of) + 1}'", ScalarKind.INTEGER, span)
            self._floor_of[key] = floor
            exact = ca.floor(value)
            above, below = self.relation(value - (floor + 1), strict=False), self.relation(floor - value, strict=True)
            stepped = choose(below, ca.fmin(exact, before - 1), before)
            stepped = choose(above, ca.fmax(exact, before + 1), stepped)
            self.hidden[floor.name()] = choose(self.initial, exact, stepped)
        return self._floor_of[key]

    def hide(self, name: str, kind: ScalarKind, span: ex.Span) -> tuple[Scalar, Scalar]:
        """A discrete variable of the lowering's own: its symbol and that of its value before the event.

        Its new value goes to `hidden`.
        """
        variable = FlatVariable(name, kind, (), Role.DISCRETE, span, is_protected=True)
        self.hidden_variables.append(variable)
        self.scope.add(variable)
        return self.scope.discretes[-1].symbol, self.scope.pre_discretes[-1]

    def delay(self, node: ex.Delay, source: Scalar, time: Scalar, maximum: Scalar) -> Scalar:
        if node.number not in self._delay_of:
            symbol = ca.SX.sym(f"delayed{len(self.delays)}")
            self.delays.append(RawDelay(symbol, source, time, maximum))
            self._fast.add(symbol.element_hash())
            self._delay_of[node.number] = symbol
        return self._delay_of[node.number]

    def flag(self, node: ex.Initial | ex.Terminal) -> Scalar:
        return self.initial if isinstance(node, ex.Initial) else self.terminal

    def sample(self, start: Scalar, interval: Scalar, node: ex.Sample) -> Scalar:
        key = _key(start), _key(interval)
        if key not in self._sample_of:
            number = len(self.samples)
            sample = RawSample(ca.SX.sym(f"tick{number}"), ca.SX.sym(f"ticked{number}"), start, interval)
            self.samples.append(sample)
            self._sample_of[key] = sample.ticks
        return self._sample_of[key]


def _key(value: Scalar) -> _Key:
    """Equal for equal expressions only: `str` would round their numbers to six digits."""
    return value.serialize(), tuple(symbol.element_hash() for symbol in ca.symvar(value))
