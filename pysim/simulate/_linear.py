"""Small dense linear systems, by elimination with row pivoting; LAPACK's overhead exceeds the work for ten unknowns."""

from __future__ import annotations

from pysim.simulate._native import doubles, longs, native


@native
def factorise(matrix: int, pivots: int, n: int) -> bool:
    """Replace the (n, n) matrix, rows one after the other, by its factors; False if it is singular or not finite."""
    a, p = doubles(matrix), longs(pivots)
    for c in range(n):
        best = c
        for r in range(c + 1, n):
            if abs(a[r * n + c]) > abs(a[best * n + c]):
                best = r
        p[c] = best
        if not (0.0 < abs(a[best * n + c]) < 1e300):
            return False
        if best != c:
            for j in range(c, n):  # not the factors to the left: `solve` swaps as it goes
                a[c * n + j], a[best * n + j] = a[best * n + j], a[c * n + j]
        for r in range(c + 1, n):
            factor = a[r * n + c] / a[c * n + c]
            a[r * n + c] = factor
            if factor != 0.0:
                for j in range(c + 1, n):
                    a[r * n + j] -= factor * a[c * n + j]
    return True


@native
def solve(matrix: int, pivots: int, right: int, n: int) -> None:
    """Replace the right-hand side (n,) by the solution; `matrix` and `pivots` come from `factorise`."""
    a, p, b = doubles(matrix), longs(pivots), doubles(right)
    for c in range(n):
        b[c], b[p[c]] = b[p[c]], b[c]
        for r in range(c + 1, n):
            b[r] -= a[r * n + c] * b[c]
    for c in range(n - 1, -1, -1):
        for j in range(c + 1, n):
            b[c] -= a[c * n + j] * b[j]
        b[c] /= a[c * n + c]
