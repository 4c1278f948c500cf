"""Symbolic execution of a flat model's expressions: loops, arrays and functions become plain CasADi expressions."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Protocol

import casadi as ca
import numpy as np

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.flat_model import Assignment, FlatModel, ForStatement, Function
from fmu_build.lower.builtins import ARITHMETIC, ELEMENTWISE, JUMPING, WHOLE
from fmu_build.lower.values import Scalar, Value, array, broadcast, choose, fixed_number, is_true, scalars

COMPARISONS = ("less", "less_equal", "greater", "greater_equal", "equal", "not_equal")
EVENT_FREE = ("no_event", "smooth")


class Shown(str):
    """A text with String(x) in it: fit for messages, where it shows the name of x, but for no comparison."""


class Surroundings(Protocol):
    """What the variables of a model and its events stand for."""

    @property
    def time(self) -> Scalar: ...

    def reference(self, name: str, form: ex.Form, span: ex.Span) -> Value: ...

    def relation(self, value: Scalar, strict: bool) -> Scalar:
        """`value > 0` (or `>= 0`), held between events where it may cause one."""

    def jump(self, name: str, arguments: list[Scalar], span: ex.Span) -> Scalar:
        """floor() and its kin, with an event at each jump."""

    def delay(self, node: ex.Delay, source: Scalar, time: Scalar, maximum: Scalar) -> Scalar: ...

    def flag(self, node: ex.Initial | ex.Terminal) -> Scalar: ...

    def sample(self, start: Scalar, interval: Scalar, node: ex.Sample) -> Scalar: ...


@dataclass(frozen=True)
class Frame:
    """Where an expression is evaluated: loop variables, a function's variables, and whether events are wanted."""

    with_events: bool = True
    loops: Mapping[tuple[int, int], int] = field(default_factory=dict)
    arguments: tuple[Value, ...] = ()
    locals: tuple[Value, ...] = ()
    done: dict[int | tuple[int, int], Value] = field(default_factory=dict)  # values of nodes in this frame, by identity


class Evaluator:
    """Evaluates expressions of one model in given surroundings."""

    def __init__(self, flat: FlatModel, surroundings: Surroundings) -> None:
        self._flat = flat
        self._around = surroundings
        self._methods: dict[type, Callable[..., Value]] = {
            kind: getattr(self, f"_{kind.__name__.lower()}")
            for kind in ex.Expression.__subclasses__()
            if kind is not ex.Slice
        }

    def value(self, node: ex.Expression, frame: Frame) -> Value:
        """The value of an expression, at most once per frame."""
        if id(node) not in frame.done:
            try:
                frame.done[id(node)] = self._methods[type(node)](node, frame)
            except RecursionError:
                raise
            except (ValueError, IndexError, TypeError, RuntimeError, NotImplementedError) as failure:
                raise BuildError(f"cannot evaluate: {failure}", node.span.file, node.span.line) from None
        return frame.done[id(node)]

    def elements(self, residual: ex.Expression, domain: int | None, frame: Frame) -> Iterator[Value]:
        """The values of `residual`, once per step of the loop `domain`."""
        if domain is None:
            yield self.value(residual, frame)
            return
        for loops in self._steps(domain, frame):
            yield self.value(residual, Frame(frame.with_events, loops))

    def _steps(self, domain: int, frame: Frame) -> Iterator[dict[tuple[int, int], int]]:
        parent = self._flat.loops[domain].parent
        outer = [dict(frame.loops)]
        if parent is not None and (parent, 0) not in frame.loops:
            outer = list(self._steps(parent, frame))
        for loops in outer:
            yield from self._own_steps(domain, loops)

    def _own_steps(self, domain: int, loops: Mapping[tuple[int, int], int]) -> Iterator[dict[tuple[int, int], int]]:
        """Without those of the loops around it."""
        for indices in product(*self._ranges(domain)):
            yield {**loops, **{(domain, position): index for position, index in enumerate(indices)}}

    def _ranges(self, domain: int) -> list[range]:
        return [range(low, high + (1 if step > 0 else -1), step) for low, high, step in self._flat.loops[domain].ranges]

    def _literal(self, node: ex.Literal, frame: Frame) -> Value:
        return node.value if isinstance(node.value, str) else ca.SX(node.value)

    def _reference(self, node: ex.Reference, frame: Frame) -> Value:
        return self._around.reference(node.name, node.form, node.span)

    def _time(self, node: ex.Time, frame: Frame) -> Value:
        return self._around.time

    def _loopvariable(self, node: ex.LoopVariable, frame: Frame) -> Value:
        return ca.SX(frame.loops[node.domain, node.position])

    def _argument(self, node: ex.Argument, frame: Frame) -> Value:
        return frame.arguments[node.position]

    def _local(self, node: ex.Local, frame: Frame) -> Value:
        return frame.locals[node.position]

    def _unary(self, node: ex.Unary, frame: Frame) -> Value:
        operand = self.value(node.operand, frame)
        if node.operator == "not":
            return broadcast(ca.logic_not, operand)
        if node.operator == "negate":
            return broadcast(lambda a: -a, operand)
        if node.operator == "plus":
            return operand
        raise BuildError(f"operator '{node.operator}' is not supported", node.span.file, node.span.line)

    def _binary(self, node: ex.Binary, frame: Frame) -> Value:
        left, right = self.value(node.left, frame), self.value(node.right, frame)
        if isinstance(left, str) and isinstance(right, str):
            return _of_texts(node, left, right)
        if node.operator in COMPARISONS:
            return self._comparison(node.operator, left, right, frame)
        if node.operator not in ARITHMETIC:
            raise BuildError(f"operator '{node.operator}' is not supported", node.span.file, node.span.line)
        return ARITHMETIC[node.operator](left, right)

    def _comparison(self, operator: str, left: Scalar, right: Scalar, frame: Frame) -> Scalar:
        """Opposite comparisons share one relation, so that both change together."""
        if operator in ("equal", "not_equal"):
            return ca.eq(left, right) if operator == "equal" else ca.ne(left, right)
        difference = left - right
        strict = operator in ("greater", "less_equal")
        is_opposite = operator in ("less", "less_equal")
        if frame.with_events:
            holds = self._around.relation(difference, strict)
        else:
            holds = difference > 0 if strict else difference >= 0
        return ca.logic_not(holds) if is_opposite else holds

    def _conditional(self, node: ex.Conditional, frame: Frame) -> Value:
        chosen: list[tuple[Scalar, Value]] = []
        for condition, value in node.branches:
            holds = self.value(condition, frame)
            if not holds.is_constant() or is_true(holds):
                chosen.append((holds, self.value(value, frame)))
            if is_true(holds):
                break
        else:
            chosen.append((ca.SX(1), self.value(node.otherwise, frame)))
        result = chosen[-1][1]
        for holds, value in reversed(chosen[:-1]):
            result = choose(holds, value, result)
        return result

    def _builtin(self, node: ex.Builtin, frame: Frame) -> Value:
        if node.name in EVENT_FREE and frame.with_events:
            return self.value(node.arguments[-1], Frame(False, frame.loops, frame.arguments, frame.locals))
        values = [self.value(argument, frame) for argument in node.arguments]
        if node.name in EVENT_FREE:
            return values[-1]
        if node.name == "string":
            return Shown(values[0])
        if node.name == "size":
            shape = values[0].shape
            return (
                ca.SX(shape[round(fixed_number(values[1])) - 1]) if len(values) == 2 else array(ca.SX(n) for n in shape)
            )
        if node.name in JUMPING and frame.with_events:
            return broadcast(lambda *scalars: self._around.jump(node.name, list(scalars), node.span), *values)
        if node.name in ELEMENTWISE:
            return broadcast(ELEMENTWISE[node.name], *values)
        if node.name in WHOLE:
            return WHOLE[node.name](*values)
        raise BuildError(f"function {node.name} is not supported", node.span.file, node.span.line)

    def _index(self, node: ex.Index, frame: Frame) -> Value:
        base = self.value(node.base, frame)
        for axis, subscript in reversed(list(enumerate(node.subscripts))):
            if not isinstance(subscript, ex.Slice):
                base = self._take(base, axis, self.value(subscript, frame), subscript.span)
        return base

    def _take(self, base: np.ndarray, axis: int, index: Value, span: ex.Span) -> Value:
        if isinstance(index, np.ndarray):
            taken = array(self._take(base, axis, i, span) for i in index)
            return np.moveaxis(taken, 0, axis)
        if index.is_constant():
            return np.take(base, self._position(index, base.shape[axis], span), axis=axis)
        result = _undefined(base.shape[:axis] + base.shape[axis + 1 :])  # for an index outside the array
        for k in range(base.shape[axis]):
            result = choose(ca.eq(index, k + 1), np.take(base, k, axis=axis), result)
        return result

    def _arrayupdate(self, node: ex.ArrayUpdate, frame: Frame) -> Value:
        base, value = self.value(node.base, frame), self.value(node.value, frame)
        indices = [None if isinstance(s, ex.Slice) else self.value(s, frame) for s in node.subscripts]
        result = base.ravel().copy()
        if any(isinstance(i, ca.SX) and not i.is_constant() for i in indices):
            is_inside = _is_inside(base.shape, indices)
            for k, place in enumerate(np.ndindex(*base.shape)):
                written = choose(_is_at(place, indices), value, result[k])
                result[k] = choose(is_inside, written, _undefined(()))
            return result.reshape(base.shape)
        chosen: np.ndarray | np.int64 = np.arange(base.size).reshape(base.shape)
        for axis, (index, subscript) in reversed(list(enumerate(zip(indices, node.subscripts, strict=True)))):
            if index is not None:
                wanted = [self._position(i, base.shape[axis], subscript.span) for i in scalars(index)]
                chosen = np.take(chosen, wanted if isinstance(index, np.ndarray) else wanted[0], axis=axis)
        result[np.ravel(chosen)] = scalars(value)
        return result.reshape(base.shape)

    def _position(self, index: Scalar, size: int, span: ex.Span) -> int:
        position = round(fixed_number(index)) - 1
        if not 0 <= position < size:
            raise BuildError(f"index {position + 1} is outside 1 to {size}", span.file, span.line)
        return position

    def _range(self, node: ex.Range, frame: Frame) -> Value:
        start, stop = fixed_number(self.value(node.start, frame)), fixed_number(self.value(node.stop, frame))
        step = 1.0 if node.step is None else fixed_number(self.value(node.step, frame))
        count = max(0, int((stop - start) / step + 1e-9) + 1)
        return array(ca.SX(start + k * step) for k in range(count))

    def _arrayliteral(self, node: ex.ArrayLiteral, frame: Frame) -> Value:
        return array(self.value(element, frame) for element in node.elements)

    def _recordliteral(self, node: ex.RecordLiteral, frame: Frame) -> Value:
        return tuple(self.value(item, frame) for item in node.fields)

    def _field(self, node: ex.Field, frame: Frame) -> Value:
        return self.value(node.base, frame)[node.position]

    def _comprehension(self, node: ex.Comprehension, frame: Frame) -> Value:
        shape = tuple(len(steps) for steps in self._ranges(node.domain))
        values = array(
            self.value(node.body, Frame(frame.with_events, loops, frame.arguments, frame.locals))
            for loops in self._own_steps(node.domain, frame.loops)
        )
        return values.reshape(shape + values.shape[1:])

    def _delay(self, node: ex.Delay, frame: Frame) -> Value:
        source, time, maximum = (self.value(part, frame) for part in (node.source, node.time, node.maximum))
        return self._around.delay(node, source, time, maximum)

    def _initial(self, node: ex.Initial, frame: Frame) -> Value:
        return self._around.flag(node)

    def _terminal(self, node: ex.Terminal, frame: Frame) -> Value:
        return self._around.flag(node)

    def _sample(self, node: ex.Sample, frame: Frame) -> Value:
        return self._around.sample(self.value(node.start, frame), self.value(node.interval, frame), node)

    def _call(self, node: ex.Call, frame: Frame) -> Value:
        key = (-1, node.owner)
        if key not in frame.done:  # all outputs of one call come from one execution
            arguments = tuple(self.value(argument, frame) for argument in node.arguments)
            frame.done[key] = self._run(self._flat.functions[node.function], arguments)
        return frame.done[key][node.output]

    def _run(self, function: Function, arguments: tuple[Value, ...]) -> list[Value]:
        """Execute a function body; inside there are no events."""
        values: list[Value] = [_undefined(shape) for shape in function.dimensions]
        for statement in function.statements:
            self._execute(statement, Frame(False, {}, arguments), values)
        return values[: function.n_outputs]

    def _execute(self, statement: Assignment | ForStatement, frame: Frame, values: list[Value]) -> None:
        if isinstance(statement, Assignment):
            now = Frame(False, frame.loops, frame.arguments, tuple(values))
            results = [self.value(value, now) for value in statement.values]
            for target, result in zip(statement.targets, results, strict=True):
                values[target] = result
            return
        for loops in self._steps(statement.domain, frame):
            for inner in statement.statements:
                self._execute(inner, Frame(False, loops, frame.arguments), values)


def _of_texts(node: ex.Binary, left: str, right: str) -> Value:
    is_shown = isinstance(left, Shown) or isinstance(right, Shown)
    if node.operator == "add":
        return Shown(left + right) if is_shown else left + right
    if node.operator not in ("equal", "not_equal") or is_shown:
        raise BuildError(
            "texts are joined by + and compared by == and <>, but not the text of a value, String(...); "
            "use an Integer or an enumeration",
            node.span.file,
            node.span.line,
        )
    return ca.SX(int((left == right) == (node.operator == "equal")))


def _undefined(shape: tuple[int, ...]) -> Value:
    nothing = ca.SX.nan()
    return array([nothing] * int(np.prod(shape))).reshape(shape) if shape else nothing


def _is_at(place: tuple[int, ...], indices: list[Scalar | None]) -> Scalar:
    """Whether the subscripts, known at run time only, mean this element."""
    holds = ca.SX(1)
    for position, index in zip(place, indices, strict=True):
        if index is not None:
            holds = ca.logic_and(holds, ca.eq(index, position + 1))
    return holds


def _is_inside(shape: tuple[int, ...], indices: list[Scalar | None]) -> Scalar:
    """Whether the subscripts, known at run time only, mean an element at all."""
    holds = ca.SX(1)
    for size, index in zip(shape, indices, strict=True):
        if index is not None:
            holds = ca.logic_and(holds, ca.logic_and(index >= 1, index <= size))
    return holds
