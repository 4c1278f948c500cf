"""Equations of effects as numbers: what they give, what they remember, and that nothing else is run."""

import math

import pytest

pytest.importorskip("nicegui", reason="the extra app is not installed")

from pysim.app.law import FAILED, Moment, read_law


def test_equations_are_worked_out_in_whatever_order_they_stand() -> None:
    law = read_law("y = 2*a^2 + b;\na = max(s, 1);\nb = if s > 2 then -1 else noEvent(if s > 1 then 5 else 7);")
    for s, y in ((0.0, 9.0), (1.5, 9.5), (3.0, 17.0)):
        assert Moment(law, {"s": s}, {})["y"] == y
    assert law.needs("y") == {"a", "b", "s"}
    assert not law.remembers("y")


@pytest.mark.parametrize(("s", "y"), [(-2.0, -1), (-0.5, 2), (0.5, 3), (5.0, 4)])
def test_conditions_stand_within_others_and_within_brackets(s: float, y: float) -> None:
    nested = "y = if s < 0 then if s < -1 then -1 else 2 else if s < 1 then 3 else 4;"
    inside = "y = 1*max(-1, if s < 0 then (if s < -1 then -1 else 2) else min(if s < 1 then 3 else 4, 9));"
    assert [Moment(read_law(text), {"s": s}, {})["y"] for text in (nested, inside)] == [y, y]


def test_conditions_are_true_or_not() -> None:
    law = read_law("a = s > 0 and (pre(a) or s >= d);\nb = not s == 1 and s <> 2;")
    assert Moment(law, {"s": 0.5, "d": 1.0}, {})["a"] == 0
    assert Moment(law, {"s": 0.5, "d": 1.0}, {"a": 1.0})["a"] == 1
    assert [Moment(law, {"s": s}, {})["b"] for s in (0.0, 1.0, 2.0)] == [1, 0, 0]
    assert law.remembers("a")
    assert not law.remembers("b")


def test_derivatives_samples_and_resets_are_told_apart() -> None:
    text = "T*der(y) = s - y;\nwhen sample(0, T_s) then\n  z = s;\nend when;\n"
    text += "when {s > 1, s < -1} then\n  reinit(y, 0);\nend when;"
    law = read_law(text)
    assert (list(law.rates), list(law.sampled), list(law.resets)) == (["y"], ["z"], ["y"])
    now = Moment(law, {"s": 3.0, "y": 1.0, "T": 0.5, "T_s": 0.1}, {})
    right, factor = law.rates["y"]
    assert now.value(right) / now.value(factor) == 4
    assert now.value(law.sampled["z"][1]) == 0.1
    assert [now.value(one) for one in law.resets["y"][1]] == [1, 0]


def test_powers_keep_the_sign_that_modelica_s_have() -> None:
    law = read_law("y = s^3; z = s^2; r = s^(1/1.4);")
    now = Moment(law, {"s": -2.0}, {})
    assert (now["y"], now["z"]) == (-8, 4)
    assert math.isnan(now["r"])


@pytest.mark.parametrize(
    "text",
    [
        "y = __import__('os').system('true');",
        "y = (1).real;",
        "y = [s for s in (1, 2)];",
        "y = s^999999999;",
        "y = unknown(s);",
        "y = y + 1;",
        "y = nobody;",
        "2*y = s;",
        "connect(a, b);",
        "when s > 1 then y = s; end when;",
        "y = " + "(" * 3000,
    ],
)
def test_anything_else_is_refused_and_not_run(text: str) -> None:
    with pytest.raises(FAILED):
        assert Moment(read_law(text), {"s": 1.0}, {})["y"] is None
