"""Systems that are singular everywhere, and those that only look so at some point or in SI units."""

import casadi as ca
import pytest

from fmu_build.front.expression import Span
from fmu_build.lower.equations import ScalarEquation
from fmu_build.lower.singular import is_singular

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
        ([ca.sqrt(-(X**2)) - 1, ca.sqrt(-(Y**2)) + X], False),  # defined nowhere: no verdict
    ],
)
def test_verdicts(residuals, expected):
    unknowns = [X, Y, Z][: len(residuals)]
    assert is_singular([ScalarEquation(r, Span()) for r in residuals], unknowns) is expected
