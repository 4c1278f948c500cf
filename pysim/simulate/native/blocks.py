"""Sparse linear systems with many right-hand sides: four of them at a time in one vector register."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from pysim.simulate.native.compiled import doubles, longs, native

VECTOR = 4  # right-hand sides; their number has to be a multiple
_intrinsic: Any = intrinsic


@native
def solve_shifted_rows(job: Any, right: int, width: int) -> None:
    """Replace the right-hand sides (n, width) by the solutions of the system that `factorise_shifted` took apart."""
    if job.run.is_sparse != 0:
        _substitute_rows(job, right, width)
    else:
        _solve_rows(job.work.matrix, job.work.pivots, right, job.work.n, width)


@native
def _substitute_rows(job: Any, right: int, width: int) -> None:
    work, n = job.work, job.work.n
    v, states, first, diagonal = doubles(work.factors), longs(work.states), longs(work.row_first), longs(work.diagonal)
    for r in range(n):
        row, count = right + 8 * width * states[r], diagonal[r] - first[r]
        place = 8 * first[r]
        for j in range(0, width, VECTOR):
            _sum_four(row + 8 * j, 1.0, work.factors + place, work.columns + place, count, right + 8 * j, width)
    for r in range(n - 1, -1, -1):
        middle = diagonal[r]
        row, count, place = right + 8 * width * states[r], first[r + 1] - middle - 1, 8 * (middle + 1)
        for j in range(0, width, VECTOR):
            _sum_four(row + 8 * j, v[middle], work.factors + place, work.columns + place, count, right + 8 * j, width)


@native
def _solve_rows(matrix: int, pivots: int, right: int, n: int, width: int) -> None:
    """The same with dense factors, from `factorise`."""
    p = longs(pivots)
    for c in range(n):
        column = doubles(matrix + 8 * n * c)
        row = right + 8 * width * c
        if p[c] != c:
            _swap(row, right + 8 * width * p[c], width)
        for r in range(c + 1, n):
            if column[r] != 0.0:
                add_row(right + 8 * width * r, row, -column[r], width)
    for c in range(n - 1, -1, -1):
        column = doubles(matrix + 8 * n * c)
        row = right + 8 * width * c
        scaled, inverse = doubles(row), column[c]
        for k in range(width):
            scaled[k] *= inverse
        for r in range(c):
            if column[r] != 0.0:
                add_row(right + 8 * width * r, row, -column[r], width)


@native
def add_row(target: int, source: int, factor: float, width: int) -> None:
    """target += factor * source, width doubles."""
    a, b = doubles(target), doubles(source)
    for k in range(width):
        a[k] += factor * b[k]


@native
def _swap(first: int, second: int, width: int) -> None:
    a, b = doubles(first), doubles(second)
    for k in range(width):
        a[k], b[k] = b[k], a[k]


@_intrinsic
def _sum_four(
    typing_context: Any, row: Any, factor: Any, weights: Any, numbers: Any, count: Any, rows: Any, stride: Any
) -> Any:
    """row = factor row - sum_i weights_i rows[numbers_i], four columns; `stride` doubles lie between two rows."""

    def emit(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        row, factor, weights, numbers, count, rows, stride = values
        long, four = ir.IntType(64), ir.VectorType(ir.DoubleType(), VECTOR)

        def load(address: Any, kind: Any) -> Any:
            return builder.load(builder.inttoptr(address, kind.as_pointer()), align=8)

        def spread(number: Any) -> Any:
            first = builder.insert_element(ir.Constant(four, ir.Undefined), number, ir.Constant(ir.IntType(32), 0))
            lanes = ir.Constant(ir.VectorType(ir.IntType(32), VECTOR), [0] * VECTOR)
            return builder.shuffle_vector(first, ir.Constant(four, ir.Undefined), lanes)

        def eight(number: Any) -> Any:
            return builder.shl(number, ir.Constant(long, 3))

        total = cgutils.alloca_once_value(builder, builder.fmul(spread(factor), load(row, four)))
        with cgutils.for_range(builder, count, intp=long) as loop:
            weight = load(builder.add(weights, eight(loop.index)), ir.DoubleType())
            number = load(builder.add(numbers, eight(loop.index)), long)
            source = builder.add(rows, eight(builder.mul(number, stride)))
            term = builder.fmul(spread(weight), load(source, four))
            builder.store(builder.fsub(builder.load(total), term), total)
        builder.store(builder.load(total), builder.inttoptr(row, four.as_pointer()), align=8)
        return context.get_dummy_value()

    whole = types.int64
    return types.void(whole, types.float64, whole, whole, whole, whole, whole), emit
