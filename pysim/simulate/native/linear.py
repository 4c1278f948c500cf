"""Small dense linear systems, by elimination with row pivoting; LAPACK's overhead exceeds the work for ten unknowns."""

from __future__ import annotations

from pysim.simulate.native.compiled import doubles, longs, native


@native
def factorise(matrix: int, pivots: int, n: int) -> bool:
    """Replace the (n, n) matrix, columns one after the other, by its factors; False if singular or not finite."""
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
        pivot_column[c] = inverse  # `solve` multiplies by it
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
def solve(matrix: int, pivots: int, right: int, n: int) -> None:
    """Replace the right-hand side (n,) by the solution; `matrix` and `pivots` come from `factorise`."""
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
