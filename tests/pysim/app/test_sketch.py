"""Sketches of laws: right where a law is a function of one variable, and none at all where it is not."""

import math

import pytest

from pysim.app.sketch import sketch


def test_a_dead_zone_is_flat_in_its_middle() -> None:
    law = "y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));"
    found = sketch(law, ["s"], {"u_0": 0.016})
    assert found is not None
    x, y = found
    assert (x[0], x[-1], y[0], y[-1]) == pytest.approx((-1, 1, -1, 1))
    assert all(b == 0 for a, b in zip(x, y, strict=True) if abs(a) < 0.33)
    assert all(b != 0 for a, b in zip(x, y, strict=True) if abs(a) > 0.34)


def test_dry_friction_acts_against_the_motion() -> None:
    found = sketch("f = -F_c*tanh(v/v_t);", ["x", "v"], {"F_c": 80.0})
    assert found is not None
    x, y = found
    assert y == pytest.approx([-math.tanh(25 * at) for at in x], abs=1e-3)


def test_a_cubic_spring_is_odd() -> None:
    found = sketch("f = -k_3*x^3;", ["x", "v"], {"k_3": 2.5e7})
    assert found is not None
    assert found[1] == pytest.approx([-(at**3) for at in found[0]])


@pytest.mark.parametrize(
    "law",
    [
        "der(y) = (s - y)/T;",
        "when sample(0, T) then y = s; end when;",
        "y = s*v;",
        "y = __import__('os').system('true');",
        "y = (1).real;",
        "y = s^999999999;",
        "",
    ],
)
def test_what_is_no_such_function_is_not_drawn_nor_run(law: str) -> None:
    assert sketch(law, ["s", "v"], {"T": 1.0}) is None
