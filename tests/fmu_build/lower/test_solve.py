"""Blocks of equations: what is solved symbolically and what is left to Newton."""

import casadi as ca
import numpy as np
import pytest

from fmu_build.front.expression import Span
from fmu_build.lower.equations import ScalarEquation
from fmu_build.lower.parameters import explicit
from fmu_build.lower.solve import solve_block


def solved(residuals, unknowns):
    solution = solve_block([ScalarEquation(r, Span()) for r in residuals], unknowns, [False] * len(unknowns))
    values, _ = explicit([d.symbol for d in solution.definitions], [d.value for d in solution.definitions], [])
    return solution, {d.symbol.name(): value for d, value in zip(solution.definitions, values, strict=True)}


@pytest.mark.parametrize("n", [1, 2, 3])
def test_dense_linear_block_against_numpy(n):
    matrix, right = ca.SX.sym("A", n, n), ca.SX.sym("b", n)
    unknowns = [ca.SX.sym(f"z{k}") for k in range(n)]
    residual = matrix @ ca.vertcat(*unknowns) - right
    solution, values = solved([residual[k] for k in range(n)], unknowns)
    assert solution.unknowns == []
    numbers = np.random.default_rng(3).normal(size=(n, n + 1))
    function = ca.Function("f", [matrix, right], [ca.vertcat(*(values[f"z{k}"] for k in range(n)))])
    expected = np.linalg.solve(numbers[:, :n], numbers[:, n])
    assert function(numbers[:, :n], numbers[:, n]).full().ravel() == pytest.approx(expected, rel=1e-10)


def test_large_dense_linear_block_is_left_to_newton():
    n = 5
    unknowns = [ca.SX.sym(f"z{k}") for k in range(n)]
    residual = ca.SX.sym("A", n, n) @ ca.vertcat(*unknowns) - 1
    solution, _ = solved([residual[k] for k in range(n)], unknowns)
    assert len(solution.unknowns) == len(solution.residuals) == n


def test_constant_coefficients_are_eliminated_however_many():
    n = 12
    unknowns = [ca.SX.sym(f"z{k}") for k in range(n)]
    load = ca.SX.sym("load")
    residuals = [2 * unknowns[k] - unknowns[k - 1] - unknowns[(k + 1) % n] - (k == 0) * load for k in range(n)]
    residuals[-1] = unknowns[-1] + unknowns[0]
    solution, values = solved(residuals, unknowns)
    assert solution.unknowns == []
    numbers = ca.Function("f", [load], [ca.vertcat(*(values[f"z{k}"] for k in range(n)))])(3.0)
    check = ca.Function("g", [ca.vertcat(*unknowns), load], [ca.vertcat(*residuals)])(numbers, 3.0)
    assert check.full() == pytest.approx(np.zeros((n, 1)), abs=1e-10)


def test_never_divides_by_what_may_be_zero():
    a, x, y = (ca.SX.sym(name) for name in "axy")
    _, values = solved([a * x + y - 1, x - y], [x, y])
    assert float(ca.Function("f", [a], [values["x"]])(0.0)) == 1.0


def test_the_unknown_with_a_start_value_is_iterated():
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    equations = [ScalarEquation(x - y, Span()), ScalarEquation(x**3 + y - 2, Span())]
    assert [str(u) for u in solve_block(equations, [x, y], [True, False]).unknowns] == ["x"]
    assert [str(u) for u in solve_block(equations, [x, y], [False, True]).unknowns] == ["y"]
