"""Systems that are singular everywhere, and those that only look so at some point or in SI units."""

import casadi as ca
import pytest

from fmu_build.front.expression import Span
from fmu_build.lower.equations import ScalarEquation
from fmu_build.lower.singular import is_singular
from tests.fmu_build.lower.compiling import body
from tests.fmu_build.lower.reference_runner import Runner

A, B, X, Y, Z = (ca.SX.sym(name) for name in "abxyz")


@pytest.mark.parametrize(
    ("residuals", "expected"),
    [
        ([X + Y - 1, X + Y - 2], True),
        ([X + Y - 1, X + 2 * Y - 2], False),
        ([A * X + B * Y - 1, X + Y - 2], False),  # singular for a = b only
        ([A * X + B * Y - 1, B * A * X + B**2 * Y], True),
        ([X * Y - 1, ca.log(X) + ca.log(Y)], True),
        ([X * Y - 1, X + Y], False),
        ([X - 1e-14 * Y, X + 1e-14 * Y - A], False),  # a leakage in m3/(s.Pa)
        ([1e9 * X - Y, X + 1e9 * Y], False),
        ([ca.if_else(A, X, Y), ca.if_else(A, Y, X - 1)], False),  # an ideal switch
        ([ca.if_else(A, X, Y), ca.if_else(A, 2 * X, 2 * Y)], True),
        ([A * X + Y + Z, Y - Z, 1e-6 * X - B * Z], False),
        ([X * ca.if_else(A > 273.15, A - 273.15, 0) - 1], False),  # met by points of large sizes
        ([X * ca.if_else(ca.logic_and(A > 300, A < 310), A, 0) - 1], False),  # met by none: no verdict
        ([ca.if_else(A > 2e7, 2, 1) * X + Y, X + Y - 1], False),
        ([ca.sqrt(-(X**2)) - 1, ca.sqrt(-(Y**2)) + X], False),  # defined nowhere: no verdict
    ],
)
def test_verdicts(residuals, expected):
    unknowns = [X, Y, Z][: len(residuals)]
    assert is_singular([ScalarEquation(r, Span()) for r in residuals], unknowns) is expected


def test_the_values_a_model_starts_from_are_tried():
    window = ca.if_else(ca.logic_and(A > 300, A < 310), 2, 1)
    equations = [ScalarEquation(residual, Span()) for residual in (window * X + Y, X + Y - 1)]
    assert is_singular(equations, [X, Y], lambda: {A.element_hash(): 4000.0})
    assert not is_singular(equations, [X, Y], lambda: {A.element_hash(): 305.0})


@pytest.mark.parametrize(
    "declared",
    [
        "Real T(start = 305, fixed = true); equation der(T) = 1;",
        "Real T(start = 0, fixed = true, nominal = 305); equation der(T) = 1;",
        "parameter Real T = 305; equation",
        "parameter Real C = 32; parameter Real T = C + 273; equation",
        "input Real T(start = 305); equation",
        "discrete Real T(start = 305, fixed = true); equation when time > 1 then T = 301; end when;",
    ],
)
def test_start_nominal_and_parameter_values_are_tried(declared: str) -> None:
    model = body(f"""
        Real x; Real y; {declared}
        noEvent(if T > 300 and T < 310 then 2 else 1)*x + y = 0;
        x + y = 1;""")
    assert {"x", "y"} <= {variable.name for variable in model.variables}


@pytest.mark.parametrize("flow", ["noEvent(if T > 273.15 then T - 273.15 else 0)*q = 1", "max(0, T - 273.15)*q = 1"])
def test_a_coefficient_that_vanishes_in_the_cold_is_no_contradiction(flow: str) -> None:
    run = Runner(body(f"Real T(start = 300, fixed = true); Real q; equation der(T) = 1; {flow};"))
    assert run.at("q") == pytest.approx(1 / 26.85)
