"""Slopes of built-in functions where they have a kink."""

import casadi as ca
import pytest

from fmu_build.lower.builtins import ELEMENTWISE


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
