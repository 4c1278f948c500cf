"""rumoca's arena of expression nodes -> the expression tree. Every node kind is named here or refused."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.rumoca.form.places import Places

Node = Mapping[str, Any]

VALUE_COORDINATES = ("parameter", "input", "state", "algebraic", "discrete_real", "discrete_value")
PRE_COORDINATES = ("pre_state", "pre_algebraic", "pre_discrete_real", "pre_discrete_value")

# mod, div and rem in equations, but not in functions, bring nodes for their event roots that the list leaves out.
HIDDEN_NODES_OF_A_QUOTIENT = 6


class Arena:
    """The expressions of one model; `expression(k)` converts node k once.

    `condition` converts rumoca's numbered conditions, which expressions may refer to.
    """

    def __init__(self, storage: Mapping[str, Any], places: Places, condition: Callable[[int], ex.Expression]) -> None:
        self._storage = storage
        self._places = places
        self._condition = condition
        self._arena = storage["expressions"]
        self._nodes, self._operands, self._subscripts = _layout(self._arena)
        self._provenance = dict(zip(self._nodes, self._arena["provenance"], strict=True))
        self._done: dict[int, ex.Expression] = {}

    def expression(self, number: int) -> ex.Expression:
        if number not in self._done:
            self._done[number] = self._convert(number)
        return self._done[number]

    def span(self, number: int) -> ex.Span:
        return self._places.span(self._provenance.get(number))

    def _convert(self, number: int) -> ex.Expression:
        if number not in self._nodes:
            raise BuildError("an expression refers to one that rumoca did not list; is this rumoca 0.10.2?")
        kind, node = next(iter(self._nodes[number].items()))
        convert = getattr(self, f"_{kind}", None)
        if convert is None:
            raise BuildError(
                f"expression kind '{kind}' is not supported", self.span(number).file, self.span(number).line
            )
        result: ex.Expression = convert(number, node, self.span(number))
        return result

    def _all(self, number: int) -> tuple[ex.Expression, ...]:
        return tuple(self.expression(k) for k in self._operands[number])

    def _literal(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        ((kind, value),) = node.items()
        if kind not in ("real", "integer", "boolean", "enumeration", "string"):
            raise BuildError(f"literal of type '{kind}' is not supported", span.file, span.line)
        return ex.Literal(span, value)

    def _coordinate(self, number: int, node: Node | str, span: ex.Span) -> ex.Expression:
        if node == "time":
            return ex.Time(span)
        assert not isinstance(node, str), node
        ((kind, what),) = node.items()
        if kind in VALUE_COORDINATES:
            return ex.Reference(span, self._storage["variables"][what]["name"])
        if kind == "derivative":
            return ex.Reference(span, self._storage["variables"][what]["name"], ex.Form.DERIVATIVE)
        if kind in PRE_COORDINATES:
            return ex.Reference(span, self._storage["variables"][what]["name"], ex.Form.PRE)
        if kind == "binder":
            return ex.LoopVariable(span, what["domain"], what["ordinal"])
        if kind == "function_parameter":
            return ex.Argument(span, what["ordinal"])
        if kind == "condition":
            return self._condition(what)
        if kind == "terminal":
            return ex.Terminal(span)
        if kind == "delay":
            return self._delay(what, span)
        raise BuildError(f"reference of kind '{kind}' is not supported", span.file, span.line)

    def _delay(self, number: int, span: ex.Span) -> ex.Expression:
        delay = self._storage["delays"][number]
        ((kind, what),) = delay["kind"].items()
        source = self.expression(delay["source"])
        if kind == "parameter_delay":
            time = self.expression(what["delay_time"]["expression"])
            return ex.Delay(span, number, source, time, time)
        if kind == "bounded_delay":
            time = self.expression(what["delay_time"])
            return ex.Delay(span, number, source, time, self.expression(what["delay_max"]["expression"]))
        raise BuildError(f"delay of kind '{kind}' is not supported", span.file, span.line)

    def _unary(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Unary(span, node["operator"], self.expression(node["operand"]))

    def _binary(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Binary(span, node["operator"], self.expression(node["lhs"]), self.expression(node["rhs"]))

    def _runtime_quotient_owner(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Builtin(span, node["builtin"], (self.expression(node["lhs"]), self.expression(node["rhs"])))

    def _builtin(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Builtin(span, node["builtin"], self._all(number))

    def _call(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        if node["derivative"] is not None:
            raise BuildError("the derivative of a function call is not supported", span.file, span.line)
        return ex.Call(span, node["function"], self._all(node["owner"]), node["output"], node["owner"])

    def _conditional(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        *pairs, otherwise = self._all(number)
        branches = tuple(zip(pairs[0::2], pairs[1::2], strict=True))
        return ex.Conditional(span, branches, otherwise)

    def _index(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        subscripts = tuple(self._subscript(item) for item in self._subscripts[number])
        return ex.Index(span, self.expression(node["base"]), subscripts)

    def _array_update(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        subscripts = tuple(self._subscript(item) for item in self._subscripts[number])
        return ex.ArrayUpdate(span, self.expression(node["base"]), self.expression(node["value"]), subscripts)

    def _subscript(self, item: Node) -> ex.Expression:
        span = self._places.span(item["provenance"])
        if item["kind"] == "whole":
            return ex.Slice(span)
        ((kind, what),) = item["kind"].items()
        if kind in ("index", "slice"):
            return self.expression(what)
        raise BuildError(f"subscript of kind '{kind}' is not supported", span.file, span.line)

    def _range(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        step = node["explicit_step_expression"]
        start, stop = self.expression(node["start_expression"]), self.expression(node["stop_expression"])
        return ex.Range(span, start, None if step is None else self.expression(step), stop)

    def _array(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.ArrayLiteral(span, self._all(number))

    def _record(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.RecordLiteral(span, self._all(number))

    def _field(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Field(span, self.expression(node["base"]), node["field"])

    def _comprehension(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Comprehension(span, node["domain"], self.expression(node["body"]))

    def _function_value(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Local(span, node["value"], node["definition_ordinal"])

    def _string_conversion(self, number: int, node: Node, span: ex.Span) -> ex.Expression:
        return ex.Builtin(span, "string", (self.expression(node["value"]),))


def _layout(
    arena: Mapping[str, Any],
) -> tuple[dict[int, Node], dict[int, Sequence[int]], dict[int, Sequence[Node]]]:
    """Node numbers, and each node's share of the common operand and subscript lists, which follow node order."""
    nodes: dict[int, Node] = {}
    operands: dict[int, Sequence[int]] = {}
    subscripts: dict[int, Sequence[Node]] = {}
    number = at_operand = at_subscript = 0
    for node in arena["nodes"]:
        kind, content = next(iter(node.items()))
        nodes[number] = node
        if isinstance(content, Mapping):
            n_operands, n_subscripts = content.get("operand_count", 0), content.get("subscript_count", 0)
            operands[number] = arena["operands"][at_operand : at_operand + n_operands]
            subscripts[number] = arena["subscripts"][at_subscript : at_subscript + n_subscripts]
            at_operand += n_operands
            at_subscript += n_subscripts
        is_with_events = kind == "runtime_quotient_owner" and "model" in content["kind"]
        number += 1 + is_with_events * HIDDEN_NODES_OF_A_QUOTIENT
    if (at_operand, at_subscript) != (len(arena["operands"]), len(arena["subscripts"])):
        raise BuildError("rumoca's expression list does not add up; is this rumoca 0.10.2?")
    return nodes, operands, subscripts
