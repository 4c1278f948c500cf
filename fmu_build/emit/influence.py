"""What each expression of a model depends on, with the way through q, c, i, relations and discrete variables."""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import casadi as ca

from fmu_build.emit.graph import expression_graph
from fmu_build.lower.ode_model import OdeModel, Symbols
from fmu_build.lower.values import column

Masks = list[int]  # one per element: the set of symbols it depends on, bit by bit


@dataclass(frozen=True)
class Layout:
    """Where the bit of each symbol lies: all vectors of `Symbols`, one behind the other."""

    first: dict[str, int]

    @classmethod
    def of(cls, symbols: Symbols) -> "Layout":
        first, position = {}, 0
        for field in fields(symbols):
            first[field.name] = position
            position += getattr(symbols, field.name).numel()
        return cls(first)

    def bit(self, vector: str, index: int) -> int:
        return 1 << (self.first[vector] + index)

    def vector_mask(self, vector: str, size: int) -> int:
        return ((1 << size) - 1) << self.first[vector]


def direct_influence(symbols: Symbols, expression: ca.SX) -> Masks:
    """Per element of a dense column, the symbols it is written in, conditions included."""
    arguments = [getattr(symbols, field.name) for field in fields(symbols)]
    layout = Layout.of(symbols)
    offsets = list(layout.first.values())
    graph = expression_graph(arguments, [expression])
    masks: Masks = []
    for node in graph.nodes:
        if node.operation == ca.OP_INPUT:
            argument, element = node.operands
            masks.append(1 << (offsets[argument] + element))
        else:
            mask = 0
            for operand in node.operands:
                mask |= masks[operand]
            masks.append(mask)
    found = [0] * expression.numel()
    for position, k in graph.results[0]:
        found[position] = masks[k]
    return found


class Influence:
    """Follows symbols that are themselves functions of others until only free ones are left.

    `inner` maps a bit to the mask of what that symbol is a function of. A symbol may be free and a function at once
    (a discrete variable keeps its value and is updated).
    """

    def __init__(self, inner: dict[int, int]) -> None:
        self._inner = inner

    def followed(self, mask: int) -> int:
        """All symbols that `mask` leads to, inner ones included."""
        found, new = mask, mask
        while new:
            reached = 0
            for bit in _bits(new):
                reached |= self._inner.get(bit, 0)
            new = reached & ~found
            found |= reached
        return found


def running_influence(model: OdeModel, *, through_discrete: bool) -> Influence:
    """Between initialisation and end: x, u and t are free.

    Args:
        through_discrete: True where an event may update discrete variables first (outputs in event mode).
    """
    s, layout = model.symbols, Layout.of(model.symbols)
    inner = _held_inner(model, layout)
    inner |= _implicit(s, layout, "q", model.residual, s.q)
    time = layout.bit("t", 0)
    inner |= {layout.bit("v", k): time for k in range(s.v.numel())}
    if through_discrete:
        inner |= _explicit(s, layout, "d", model.updates_d)
        inner |= {layout.bit("e", k): time for k in range(s.e.numel())}
    return Influence(inner)


def initial_influence(model: OdeModel) -> Influence:
    """During initialisation: p, u, t and those x and d whose start values are the user's are free."""
    s, layout = model.symbols, Layout.of(model.symbols)
    inner = _held_inner(model, layout)
    inner |= _implicit(s, layout, "q", model.residual, s.q)
    inner |= _implicit(s, layout, "i", model.initial_residual, s.i)
    starts_x = direct_influence(s, model.start_x)
    reinitialised = direct_influence(s, ca.substitute(model.updates_x, s.e[0], ca.SX(1)))
    inner |= {layout.bit("x", k): starts_x[k] | reinitialised[k] for k in range(s.x.numel())}
    sources = column([delay.source for delay in model.delays])
    inner |= _explicit(s, layout, "v", sources)
    starts = direct_influence(s, model.start_d)
    updates = direct_influence(s, model.updates_d)
    inner |= {layout.bit("d", k): starts[k] | updates[k] for k in range(s.d.numel())}
    inner |= {layout.bit("pre_d", k): layout.bit("d", k) for k in range(s.d.numel())}
    return Influence(inner)


def _held_inner(model: OdeModel, layout: Layout) -> dict[int, int]:
    values = column([relation.value for relation in model.relations])
    return _explicit(model.symbols, layout, "c", model.calculated) | _explicit(model.symbols, layout, "r", values)


def _explicit(symbols: Symbols, layout: Layout, vector: str, expression: ca.SX) -> dict[int, int]:
    return {layout.bit(vector, k): mask for k, mask in enumerate(direct_influence(symbols, expression))}


def _implicit(symbols: Symbols, layout: Layout, vector: str, residual: ca.SX, unknowns: ca.SX) -> dict[int, int]:
    """Each unknown of residual = 0 depends on what the equations of its block contain."""
    if not unknowns.numel():
        return {}
    masks = direct_influence(symbols, residual)
    return {
        layout.bit(vector, column): _union([masks[row] for row in rows])
        for rows, columns in _blocks(ca.jacobian(residual, unknowns).sparsity())
        for column in columns
    }


def _blocks(sparsity: ca.Sparsity) -> list[tuple[list[int], list[int]]]:
    """(rows, columns) of the block triangular form."""
    count, rows, columns, row_starts, column_starts, *_ = sparsity.btf()
    return [
        (rows[row_starts[k] : row_starts[k + 1]], columns[column_starts[k] : column_starts[k + 1]])
        for k in range(count)
    ]


def _union(masks: Sequence[int]) -> int:
    result = 0
    for mask in masks:
        result |= mask
    return result


def _bits(mask: int) -> list[int]:
    bits = []
    while mask:
        bit = mask & -mask
        bits.append(bit)
        mask ^= bit
    return bits
