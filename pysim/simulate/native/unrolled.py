"""Elimination in one sparsity pattern as straight-line machine code: the arithmetic of `elimination`, and nothing else.

In the loops there, most of the time goes into indices and into numbers that pass through memory from one row to the
next. Here every index is known when the code is made, and numbers stay in registers. Operations and their order are the
same, and so are the results, bit by bit. LLVM is asked directly: it takes milliseconds where Numba takes seconds.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, NamedTuple

from llvmlite import binding, ir

_LONGEST = 4000  # operations: beyond, machine code is large and slow to make, and the loops serve

_INT, _LONG, _DOUBLE = ir.IntType(32), ir.IntType(64), ir.DoubleType()
_LOCK = threading.Lock()
_ENGINES: list[Any] = []  # machine code lives as long as its engine

Numbers = list[Any]  # of LLVM, values in the order of entries, rows or states
Operation = Callable[[Any, Any], Any]


class Layout(NamedTuple):
    """Where entries lie, by the names of `state.WORK`."""

    sources: tuple[int, ...]
    states: tuple[int, ...]
    row_first: tuple[int, ...]
    diagonal: tuple[int, ...]
    places: tuple[int, ...]
    targets: tuple[int, ...]

    def left(self, row: int) -> range:
        """Entries of a row ahead of its diagonal."""
        return range(self.row_first[row], self.diagonal[row])

    def right(self, row: int) -> range:
        """Entries of a row behind its diagonal."""
        return range(self.diagonal[row] + 1, self.row_first[row + 1])

    def whole(self, row: int) -> range:
        """Entries of a row."""
        return range(self.row_first[row], self.row_first[row + 1])


def unrolled(arrays: Mapping[str, Any], loss: float) -> dict[str, int]:
    """Addresses of two functions for what `elimination_arrays` found; 0 where the loops serve.

    eliminate(jacobian, shift, factors, x, nominal) is 1 where the factors give back the matrix, else 0;
    substitute(factors, right) is 1. All but the shift are addresses of doubles, as in `elimination`.

    Args:
        loss: of a row's size, what rounding may change in it.
    """
    if arrays["entries"] + arrays["targets"].size > _LONGEST:
        return {"eliminate": 0, "substitute": 0}
    return dict(_compiled(Layout(*(tuple(arrays[name].tolist()) for name in Layout._fields)), loss))


@cache
def _compiled(layout: Layout, loss: float) -> Mapping[str, int]:
    module = ir.Module("elimination")
    module.triple = binding.get_process_triple()
    eliminate = ir.FunctionType(_INT, [_LONG, _DOUBLE, _LONG, _LONG, _LONG])
    _define(module, "eliminate", eliminate, lambda builder, given: _eliminate(builder, layout, loss, *given))
    substitute = ir.FunctionType(_INT, [_LONG, _LONG])
    _define(module, "substitute", substitute, lambda builder, given: _substitute(builder, layout, *given))
    with _LOCK:
        binding.initialize_native_target()
        binding.initialize_native_asmprinter()
        machine = binding.Target.from_triple(module.triple).create_target_machine(cpu=binding.get_host_cpu_name())
        engine = binding.create_mcjit_compiler(binding.parse_assembly(str(module)), machine)
        engine.finalize_object()
        _ENGINES.append(engine)
        return {name: engine.get_function_address(name) for name in ("eliminate", "substitute")}


def _define(module: ir.Module, name: str, kind: ir.FunctionType, body: Operation) -> None:
    """A function whose body yields the truth that it returns."""
    function = ir.Function(module, kind, name)
    builder = ir.IRBuilder(function.append_basic_block())
    builder.ret(builder.zext(body(builder, function.args), _INT))


def _eliminate(builder: Any, layout: Layout, loss: float, *given: Any) -> Any:
    """Factors L D U of shift I - J; whether they give back the matrix."""
    jacobian, shift, factors, x, nominal = given
    entries = [_load(builder, jacobian, source) for source in layout.sources]
    v = [builder.fneg(entry) for entry in entries]
    pivots = _factorise(builder, layout, shift, v)
    for q, value in enumerate(v):
        _store(builder, value, factors, q)
    moved = [builder.fadd(_load(builder, nominal, s), _absolute(builder, _load(builder, x, s))) for s in layout.states]
    return _reproduces(builder, layout, loss, shift, entries, v, pivots, moved)


def _factorise(builder: Any, layout: Layout, shift: Any, v: Numbers) -> Numbers:
    """As `elimination._eliminate`, v in place; the pivots."""
    pivots, targets = [], iter(layout.targets)
    for r, middle in enumerate(layout.diagonal):
        v[middle] = builder.fadd(v[middle], shift)
        for q in layout.left(r):
            weight = v[q]
            for u in layout.right(layout.places[q]):
                target = next(targets)
                v[target] = builder.fsub(v[target], builder.fmul(weight, v[u]))
            v[q] = builder.fmul(weight, v[layout.diagonal[layout.places[q]]])
        pivots.append(v[middle])
        v[middle] = builder.fdiv(ir.Constant(_DOUBLE, 1.0), v[middle])
        for u in layout.right(r):
            v[u] = builder.fmul(v[u], v[middle])
    return pivots


def _reproduces(
    builder: Any, layout: Layout, loss: float, shift: Any, entries: Numbers, v: Numbers, pivots: Numbers, moved: Numbers
) -> Any:
    """As `elimination._reproduces`, with states of the size `moved`."""
    places, probe = layout.places, []
    for r, pivot in enumerate(pivots):  # D U times the vector
        y = moved[r]
        for u in layout.right(r):
            y = builder.fadd(y, builder.fmul(v[u], moved[places[u]]))
        probe.append(builder.fmul(y, pivot))
    good = ir.Constant(ir.IntType(1), 1)
    for r in range(len(pivots)):
        own = builder.fmul(shift, moved[r])
        rest, size = builder.fsub(probe[r], own), _absolute(builder, own)
        for q in layout.left(r):
            rest = builder.fadd(rest, builder.fmul(v[q], probe[places[q]]))
        for q in layout.whole(r):
            change = builder.fmul(entries[q], moved[places[q]])
            rest, size = builder.fadd(rest, change), builder.fadd(size, _absolute(builder, change))
        limit = builder.fmul(ir.Constant(_DOUBLE, loss), size)
        good = builder.and_(good, builder.fcmp_ordered("<=", _absolute(builder, rest), limit))
    return good


def _substitute(builder: Any, layout: Layout, factors: Any, right: Any) -> Any:
    """The right-hand side replaced by the solution, as `elimination._substitute` does."""
    v = [_load(builder, factors, q) for q in range(layout.row_first[-1])]
    b = [_load(builder, right, state) for state in layout.states]
    for r in range(len(b)):
        for q in layout.left(r):
            b[r] = builder.fsub(b[r], builder.fmul(v[q], b[layout.places[q]]))
    for r in reversed(range(len(b))):
        b[r] = builder.fmul(b[r], v[layout.diagonal[r]])
        for u in layout.right(r):
            b[r] = builder.fsub(b[r], builder.fmul(v[u], b[layout.places[u]]))
    for state, value in zip(layout.states, b, strict=True):
        _store(builder, value, right, state)
    return ir.Constant(ir.IntType(1), 1)


def _load(builder: Any, address: Any, index: int) -> Any:
    return builder.load(_pointer(builder, address, index))


def _store(builder: Any, value: Any, address: Any, index: int) -> None:
    builder.store(value, _pointer(builder, address, index))


def _pointer(builder: Any, address: Any, index: int) -> Any:
    return builder.inttoptr(builder.add(address, ir.Constant(_LONG, 8 * index)), _DOUBLE.as_pointer())


def _absolute(builder: Any, value: Any) -> Any:
    return builder.call(builder.module.declare_intrinsic("llvm.fabs", [_DOUBLE]), [value])
