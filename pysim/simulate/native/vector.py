"""Sums of rows, four columns at a time in one vector register.

Numba compiles a loop over columns that adds up row after row into one that goes through memory for every row, because
the result might overlap the rows; and it does not join four local numbers into a vector.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from pysim.simulate.native.compiled import doubles, native

_WIDTH = 4
_intrinsic: Any = intrinsic


@native
def add_rows(base: int, rows: int, weights: int, count: int, scale: float, result: int, n: int) -> None:
    """result = base + scale sum_i weights_i rows_i over the first `count` of the rows, all (n,); addresses of doubles.

    The result may be the base; it must not be one of the rows.
    """
    w, b, k, y = doubles(weights), doubles(base), doubles(rows), doubles(result)
    whole = n - n % _WIDTH
    for j in range(0, whole, _WIDTH):
        _add_four(base + 8 * j, rows + 8 * j, weights, count, scale, result + 8 * j, n)
    for j in range(whole, n):
        total = b[j]
        for i in range(count):
            total += scale * w[i] * k[i * n + j]
        y[j] = total


@_intrinsic
def _add_four(
    typing_context: Any, base: Any, rows: Any, weights: Any, count: Any, scale: Any, result: Any, stride: Any
) -> Any:
    """The same for four columns; `stride` doubles lie between two rows."""

    def emit(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        base, rows, weights, count, scale, result, stride = values
        four = ir.VectorType(ir.DoubleType(), _WIDTH)

        def load(address: Any, kind: Any) -> Any:
            return builder.load(builder.inttoptr(address, kind.as_pointer()), align=8)

        total = cgutils.alloca_once_value(builder, load(base, four))
        row = cgutils.alloca_once_value(builder, rows)
        with cgutils.for_range(builder, count, intp=ir.IntType(64)) as loop:
            place = builder.add(weights, builder.shl(loop.index, ir.Constant(ir.IntType(64), 3)))
            weight = builder.fmul(scale, load(place, ir.DoubleType()))
            first = builder.insert_element(ir.Constant(four, ir.Undefined), weight, ir.Constant(ir.IntType(32), 0))
            lanes = ir.Constant(ir.VectorType(ir.IntType(32), _WIDTH), [0] * _WIDTH)
            spread = builder.shuffle_vector(first, ir.Constant(four, ir.Undefined), lanes)
            term = builder.fmul(spread, load(builder.load(row), four))
            builder.store(builder.fadd(builder.load(total), term), total)
            builder.store(builder.add(builder.load(row), builder.shl(stride, ir.Constant(ir.IntType(64), 3))), row)
        builder.store(builder.load(total), builder.inttoptr(result, four.as_pointer()), align=8)
        return context.get_dummy_value()

    numbers = types.int64
    return types.void(numbers, numbers, numbers, numbers, types.float64, numbers, numbers), emit
