"""Slopes of built-in functions where they have a kink, and powers of matrices."""

import casadi as ca
import pytest

from fmu_build.errors import BuildError
from fmu_build.lower.builtins import ELEMENTWISE
from tests.fmu_build.lower.compiling import body
from tests.fmu_build.lower.reference_runner import Runner


def test_the_slope_of_abs_at_zero_is_that_of_the_branch_for_positive_arguments() -> None:
    """A law on each side of u >= 0, such as a valve's K(abs(u)), has the slope there that it has beside it."""
    u = ca.SX.sym("u")
    size = ELEMENTWISE["abs"](u)
    slope, value = (ca.Function("f", [u], [e]) for e in (ca.jacobian(size, u), size))
    for x, expected in ((-2.0, -1.0), (-1e-300, -1.0), (0.0, 1.0), (3.0, 1.0)):
        assert float(slope(x)) == expected
        assert float(value(x)) == abs(x)
    flow = ca.if_else(u >= 0, size, -size) * 7.0
    gain = ca.Function("g", [u], [ca.jacobian(flow, u)])
    assert [float(gain(x)) for x in (-0.1, 0.0, 0.1)] == pytest.approx([7.0] * 3)


@pytest.mark.parametrize(
    ("power", "expected"),
    [
        ("A^2", [7, 10, 15, 22]),
        ("A^3", [37, 54, 81, 118]),
        ("A^1", [1, 2, 3, 4]),
        ("A^0", [1, 0, 0, 1]),
        ("A^n", [7, 10, 15, 22]),
        ("A.^2", [1, 4, 9, 16]),
        ("2 .^A", [2, 4, 8, 16]),
    ],
)
def test_the_power_of_a_matrix_is_its_repeated_product(power: str, expected: list[float]) -> None:
    run = Runner(
        body(f"""
        parameter Real A[2,2] = {{{{1, 2}}, {{3, 4}}}}; final parameter Integer n = 2; Real B[2,2];
      equation
        B = {power};""")
    )
    assert [run.at(f"B[{row},{col}]") for row in (1, 2) for col in (1, 2)] == expected


@pytest.mark.parametrize(
    ("power", "message"),
    [
        ("A^n", "make the parameter final"),
        ("A^(-1)", "whole number from 0 on"),
        ("A^0.5", "must be a scalar Integer"),
        ("C^2", "must be a square matrix"),
    ],
)
def test_a_power_without_meaning_is_refused(power: str, message: str) -> None:
    with pytest.raises(BuildError, match=message) as caught:
        body(
            f"parameter Real A[2,2] = {{{{1, 2}}, {{3, 4}}}}; parameter Real C[2,3] = ones(2, 3);\n"
            f"parameter Integer n = 2; Real y;\nequation\ny = sum({power});"
        )
    assert caught.value.line == 5
