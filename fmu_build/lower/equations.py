"""Scalar equations, their incidence, and the elimination of aliases."""

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from fmu_build.front.expression import Span
from fmu_build.lower.values import Scalar, column

KNOWN = 99  # rank of what is no unknown


@dataclass(frozen=True, eq=False)
class ScalarEquation:
    """`residual = 0`"""

    residual: Scalar
    span: Span


@dataclass(frozen=True, eq=False)
class Definition:
    """`symbol = value`, in symbols defined before it."""

    symbol: Scalar
    value: Scalar


def incidence(equations: Sequence[ScalarEquation], unknowns: Sequence[Scalar]) -> list[list[int]]:
    """For each equation the numbers of the unknowns in it, ascending."""
    result: list[list[int]] = [[] for _ in equations]
    if equations and unknowns:
        pattern = ca.jacobian_sparsity(column(e.residual for e in equations), column(unknowns))
        for row, unknown in zip(pattern.row(), pattern.get_col(), strict=True):
            result[row].append(unknown)
    return result


def eliminate_aliases(
    equations: Sequence[ScalarEquation], unknowns: Sequence[Scalar], rank: Sequence[int]
) -> tuple[list[ScalarEquation], list[Scalar], list[Definition]]:
    """Take equations `a = b` and `a = -b` with an unknown out of the system.

    Args:
        rank: of two unknowns the one of the higher rank stays.
    Returns:
        the remaining equations and unknowns, and a definition for each eliminated unknown.
    """
    aliases = _Aliases(unknowns, rank)
    rest = [equation for equation in equations if not aliases.take(equation)]
    definitions = [Definition(symbol, aliases.value(symbol)) for symbol in unknowns if aliases.is_eliminated(symbol)]
    left = [symbol for symbol in unknowns if not aliases.is_eliminated(symbol)]
    if not definitions or not rest:
        return rest, left, definitions
    residuals = ca.substitute(
        column(equation.residual for equation in rest),
        column(definition.symbol for definition in definitions),
        column(definition.value for definition in definitions),
    )
    replaced = [ScalarEquation(residuals[k], equation.span) for k, equation in enumerate(rest)]
    return replaced, left, definitions


class _Aliases:
    """Union-find with signs: each eliminated symbol points at plus or minus another."""

    def __init__(self, unknowns: Sequence[Scalar], rank: Sequence[int]) -> None:
        self._rank = {symbol.element_hash(): r for symbol, r in zip(unknowns, rank, strict=True)}
        self._parent: dict[int, tuple[int, Scalar]] = {}

    def is_eliminated(self, symbol: Scalar) -> bool:
        return symbol.element_hash() in self._parent

    def root(self, symbol: Scalar) -> tuple[int, Scalar]:
        sign = 1
        while symbol.element_hash() in self._parent:
            factor, symbol = self._parent[symbol.element_hash()]
            sign *= factor
        return sign, symbol

    def value(self, symbol: Scalar) -> Scalar:
        sign, root = self.root(symbol)
        return root if sign > 0 else -root

    def take(self, equation: ScalarEquation) -> bool:
        """Use the equation to eliminate an unknown, if it is of that kind."""
        terms = _terms(equation.residual, 1)
        if terms is None or len(terms) != 2:
            return False
        (sign_a, a), (sign_b, b) = ((sign * self.root(leaf)[0], self.root(leaf)[1]) for sign, leaf in terms)
        if a.element_hash() == b.element_hash():
            return False
        if self._rank.get(a.element_hash(), KNOWN) > self._rank.get(b.element_hash(), KNOWN):
            a, b = b, a
        if a.element_hash() not in self._rank:
            return False
        self._parent[a.element_hash()] = (-sign_a * sign_b, b)
        return True


def _terms(expression: Scalar, sign: int) -> list[tuple[int, Scalar]] | None:
    """`a`, `-a`, `a + b`, `a - b` as signed symbols; None for anything else."""
    if expression.is_symbolic():
        return [(sign, expression)]
    if expression.is_constant() or expression.n_dep() == 0:
        return None
    operation = expression.op()
    if operation == ca.OP_NEG:
        return _terms(expression.dep(0), -sign)
    if operation in (ca.OP_ADD, ca.OP_SUB):
        left = _terms(expression.dep(0), sign)
        right = _terms(expression.dep(1), sign if operation == ca.OP_ADD else -sign)
        if left is not None and right is not None and len(left) + len(right) <= 2:
            return left + right
    return None
