"""The expression graph of several results: CasADi's instruction list, with every value computed once."""

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

_COMMUTATIVE = frozenset({ca.OP_ADD, ca.OP_MUL, ca.OP_EQ, ca.OP_NE, ca.OP_AND, ca.OP_OR, ca.OP_FMIN, ca.OP_FMAX})
_LARGEST_POWER = 5  # up to here x^n is a few products
SELECT = -1  # operands (condition, value where it is not 0, value where it is 0); CasADi has no such operation


@dataclass(frozen=True)
class Node:
    """One value. Operands are numbers of earlier nodes, but for an input: (argument, element)."""

    operation: int
    operands: tuple[int, ...] = ()
    constant: float = 0.0


@dataclass(frozen=True)
class Graph:
    """Nodes in an order of evaluation, and per result its non-zero elements as (dense position, node)."""

    nodes: tuple[Node, ...]
    results: tuple[tuple[tuple[int, int], ...], ...]
    sizes: tuple[int, ...]

    def users(self) -> list[frozenset[int]]:
        """For each node the results that need it."""
        found: list[set[int]] = [set() for _ in self.nodes]
        for k, elements in enumerate(self.results):
            for _, node in elements:
                found[node].add(k)
        for k in range(len(self.nodes) - 1, -1, -1):
            if self.nodes[k].operation != ca.OP_INPUT:
                for operand in self.nodes[k].operands:
                    found[operand] |= found[k]
        return [frozenset(f) for f in found]


class _Numbering:
    """Gives equal values the same number, after a few rewritings that save work at run time."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._known: dict[tuple[int, tuple[int, ...], str], int] = {}

    def add(self, operation: int, operands: tuple[int, ...] = (), constant: float = 0.0) -> int:
        if operation in (ca.OP_ASSIGN, ca.OP_LIFT):
            return operands[0]
        if operation in (ca.OP_CONSTPOW, ca.OP_POW):
            number = self._power_by_roots(*operands)
            if number is not None:
                return number
        if operation == ca.OP_ADD:
            number = self._selection(*operands)
            if number is not None:
                return number
        if operation in _COMMUTATIVE:
            operands = (min(operands), max(operands))
        key = (operation, operands, repr(constant))
        if key not in self._known:
            self._known[key] = len(self.nodes)
            self.nodes.append(Node(operation, operands, constant))
        return self._known[key]

    def _power_by_roots(self, base: int, exponent: int) -> int | None:
        """x^0.25, x^-1.5 and their like: products and roots cost a few ns each, pow() 20 ns."""
        node = self.nodes[exponent]
        quarters = 4 * abs(node.constant)
        if node.operation != ca.OP_CONST or quarters not in range(1, _LARGEST_POWER * 4 + 1):
            return None
        whole, rest = divmod(int(quarters), 4)
        factors = [base] * whole
        if rest:
            root = self.add(ca.OP_SQRT, (base,))
            factors += [root] * (rest >= 2) + [self.add(ca.OP_SQRT, (root,))] * (rest % 2)
        value = factors[-1]
        for factor in factors[:-1]:
            value = self.add(ca.OP_MUL, (value, factor))
        return value if node.constant > 0 else self.add(ca.OP_INV, (value,))

    def _selection(self, a: int, b: int) -> int | None:
        """`if_else` reaches us as (c ? x : 0) + (!c ? y : 0): one choice instead of two and a sum."""
        first, second = self.nodes[a], self.nodes[b]
        if first.operation != ca.OP_IF_ELSE_ZERO or second.operation != ca.OP_IF_ELSE_ZERO:
            return None
        for yes, no in ((first, second), (second, first)):
            condition = self.nodes[no.operands[0]]
            if condition.operation == ca.OP_NOT and condition.operands[0] == yes.operands[0]:
                return self.add(SELECT, (yes.operands[0], yes.operands[1], no.operands[1]))
        return None


def expression_graph(arguments: Sequence[ca.SX], results: Sequence[ca.SX]) -> Graph:
    """The graph of `results`, each of any shape and sparsity.

    Args:
        arguments: dense column vectors of symbols.
        results: expressions in these symbols.

    Dense positions are column-major. Raises RuntimeError (from CasADi) when a result holds another symbol.
    """
    function = ca.Function("graph", list(arguments), list(results))
    numbering = _Numbering()
    register: dict[int, int] = {}
    values: list[dict[int, int]] = [{} for _ in results]
    for k in range(function.n_instructions()):
        operation = function.instruction_id(k)
        if operation == ca.OP_INPUT:
            argument, element = function.instruction_input(k)
            register[function.instruction_output(k)[0]] = numbering.add(ca.OP_INPUT, (argument, element))
        elif operation == ca.OP_CONST:
            constant = function.instruction_constant(k)
            register[function.instruction_output(k)[0]] = numbering.add(ca.OP_CONST, (), constant)
        elif operation == ca.OP_OUTPUT:
            result, element = function.instruction_output(k)
            values[result][element] = register[function.instruction_input(k)[0]]
        else:
            operands = tuple(register[j] for j in function.instruction_input(k))
            register[function.instruction_output(k)[0]] = numbering.add(operation, operands)
    return Graph(
        nodes=tuple(numbering.nodes),
        results=tuple(_elements(numbering, result, found) for result, found in zip(results, values, strict=True)),
        sizes=tuple(result.numel() for result in results),
    )


def _elements(numbering: _Numbering, result: ca.SX, found: dict[int, int]) -> tuple[tuple[int, int], ...]:
    """(dense position, node) of every element that is not a constant zero."""
    zero = Node(ca.OP_CONST)
    positions = _dense_positions(result)
    return tuple((positions[k], node) for k, node in sorted(found.items()) if numbering.nodes[node] != zero)


def _dense_positions(matrix: ca.SX) -> list[int]:
    rows, columns = matrix.sparsity().get_triplet()
    return [row + column * matrix.size1() for row, column in zip(rows, columns, strict=True)]
