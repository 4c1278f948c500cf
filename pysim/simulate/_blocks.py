"""Linear systems with many right-hand sides, laid out so that the innermost loop runs over those."""

from __future__ import annotations

from pysim.simulate._native import doubles, longs, native


@native
def factorise_sparse(matrix: int, pivots: int, n: int) -> bool:
    """Replace the (n, n) matrix, columns one after the other, by its factors; False if singular or not finite.

    Elimination with row pivoting that passes over zeros: a model's states form chains, and stay chains in the factors.
    """
    p = longs(pivots)
    for c in range(n):
        pivot_column = doubles(matrix + 8 * n * c)
        best = c
        for r in range(c + 1, n):
            if abs(pivot_column[r]) > abs(pivot_column[best]):
                best = r
        p[c] = best
        if not 0.0 < abs(pivot_column[best]) < 1e300:
            return False
        pivot_column[c], pivot_column[best] = pivot_column[best], pivot_column[c]
        inverse = 1.0 / pivot_column[c]
        pivot_column[c] = inverse  # `solve_rows` multiplies by it
        for r in range(c + 1, n):
            pivot_column[r] *= inverse
        for j in range(c + 1, n):
            column = doubles(matrix + 8 * n * j)
            top = column[best]
            column[best] = column[c]
            column[c] = top
            if top != 0.0:
                for r in range(c + 1, n):
                    column[r] -= top * pivot_column[r]
    return True


@native
def solve_one(matrix: int, pivots: int, right: int, n: int) -> None:
    """Replace the right-hand side (n,) by the solution; factors and pivots come from `factorise_sparse`."""
    p, b = longs(pivots), doubles(right)
    for c in range(n):
        column, top = doubles(matrix + 8 * n * c), b[p[c]]
        b[p[c]] = b[c]
        b[c] = top
        for r in range(c + 1, n):
            b[r] -= top * column[r]
    for c in range(n - 1, -1, -1):
        column = doubles(matrix + 8 * n * c)
        b[c] *= column[c]
        for r in range(c):
            b[r] -= b[c] * column[r]


@native
def solve_rows(matrix: int, pivots: int, right: int, n: int, width: int) -> None:
    """Replace the right-hand sides (n, width) by the solutions; factors and pivots come from `factorise_sparse`."""
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
