"""Solution of one block of equations: by elimination as far as it goes, the rest by Newton at run time."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import casadi as ca

from fmu_build.errors import Underdetermined
from fmu_build.lower.equations import Definition, ScalarEquation
from fmu_build.lower.singular import Typical, is_singular
from fmu_build.lower.values import Scalar, column

# Larger linear systems go to the run time, whose Newton solves them with pivoting in one step.
LARGEST_SYMBOLIC = 3


@dataclass
class Solution:
    """`definitions` in order; `unknowns` are left to Newton, by `residuals = 0`."""

    definitions: list[Definition] = field(default_factory=list)
    unknowns: list[Scalar] = field(default_factory=list)
    residuals: list[Scalar] = field(default_factory=list)


def solve_block(
    equations: Sequence[ScalarEquation], unknowns: Sequence[Scalar], keep: Sequence[bool], typical: Typical = dict
) -> Solution:
    """Solve a square block; where an iteration variable has to be chosen, one with `keep` is preferred.

    Unknowns that an equation gives with a constant coefficient are eliminated first (tearing): this never divides by
    something that may become zero. A linear rest of up to three is solved by Cramer's rule.

    Raises:
        BuildError: the equations contradict or repeat each other for whatever values of the variables in them.
    """
    if is_singular(equations, unknowns, typical):
        raise _contradictory(equations)
    rest = _Rest([equation.residual for equation in equations], list(unknowns), list(keep))
    eliminated: list[Definition] = []
    while len(rest.unknowns) > 1 and (pivot := rest.pivot()) is not None:
        eliminated.append(rest.eliminate(*pivot))
    solution = _solve_rest(rest)
    solution.definitions += reversed(eliminated)
    return solution


def _contradictory(equations: Sequence[ScalarEquation]) -> Underdetermined:
    span = next((e.span for e in equations if e.span.line is not None), equations[0].span)
    lines = sorted({e.span.line for e in equations if e.span.line is not None})
    return Underdetermined(
        f"{len(equations)} equations (lines {', '.join(map(str, lines))}) contradict or repeat each other: the system "
        "is singular; take one out and say something else in its place",
        span.file,
        span.line,
    )


class _Rest:
    """What is left of a block during elimination."""

    def __init__(self, residuals: list[Scalar], unknowns: list[Scalar], keep: list[bool]) -> None:
        self.residuals, self.unknowns, self._keep = residuals, unknowns, keep

    def jacobian(self) -> ca.SX:
        return ca.jacobian(column(self.residuals), column(self.unknowns))

    def pivot(self) -> tuple[int, int, float] | None:
        """Row, column and value of the constant entry whose elimination spreads least."""
        jacobian = self.jacobian()
        rows, columns = jacobian.sparsity().row(), jacobian.sparsity().get_col()
        in_row, in_column = _counts(rows), _counts(columns)
        best = None
        for k, (row, col) in enumerate(zip(rows, columns, strict=True)):
            entry = jacobian.nz[k]
            if not entry.is_constant() or float(entry) == 0:
                continue
            cost = (self._keep[col], (in_row[row] - 1) * (in_column[col] - 1), row, col)
            if best is None or cost < best[0]:
                best = cost, float(entry)
        return None if best is None else (best[0][2], best[0][3], best[1])

    def eliminate(self, row: int, col: int, coefficient: float) -> Definition:
        symbol = self.unknowns.pop(col)
        self._keep.pop(col)
        residual = self.residuals.pop(row)
        value = -ca.substitute(residual, symbol, ca.SX(0)) / coefficient
        self.residuals = [ca.substitute(other, symbol, value) for other in self.residuals]
        return Definition(symbol, value)


def _counts(numbers: list[int]) -> dict[int, int]:
    counts: dict[int, int] = {}
    for number in numbers:
        counts[number] = counts.get(number, 0) + 1
    return counts


def _solve_rest(rest: _Rest) -> Solution:
    unknowns = column(rest.unknowns)
    jacobian = rest.jacobian()
    if len(rest.unknowns) <= LARGEST_SYMBOLIC and not ca.depends_on(jacobian, unknowns):
        constant = ca.substitute(column(rest.residuals), unknowns, ca.SX.zeros(unknowns.numel()))
        values = _cramer(ca.densify(jacobian), -constant)
        return Solution([Definition(symbol, values[k]) for k, symbol in enumerate(rest.unknowns)])
    return Solution([], list(rest.unknowns), list(rest.residuals))


def _cramer(matrix: ca.SX, right: ca.SX) -> list[Scalar]:
    determinant = ca.det(matrix)
    values = []
    for k in range(matrix.shape[0]):
        replaced = ca.SX(matrix)
        replaced[:, k] = right
        values.append(ca.det(replaced) / determinant)
    return values
