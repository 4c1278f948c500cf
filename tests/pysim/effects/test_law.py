"""Equations of effects as numbers: what they give, what they remember, and that nothing else is run."""

import math
import re

import numpy as np
import pytest

from fmu_build.text.expressions import parse
from pysim.effects.law import Moment, check_unit, check_units, dimension, dimension_words, read_law


def test_equations_are_worked_out_in_whatever_order_they_stand() -> None:
    law = read_law("y = 2*a^2 + b;\na = max(s, 1);\nb = if s > 2 then -1 else noEvent(if s > 1 then 5 else 7);")
    for s, y in ((0.0, 9.0), (1.5, 9.5), (3.0, 17.0)):
        assert Moment(law, {"s": s})["y"] == y
    assert law.needs("y") == {"a", "b", "s"}
    assert not law.remembers("y")


@pytest.mark.parametrize(("s", "y"), [(-2.0, -1), (-0.5, 2), (0.5, 3), (5.0, 4)])
def test_conditions_stand_within_others_and_within_brackets(s: float, y: float) -> None:
    nested = "y = if s < 0 then if s < -1 then -1 else 2 else if s < 1 then 3 else 4;"
    inside = "y = 1*max(-1, if s < 0 then (if s < -1 then -1 else 2) else min(if s < 1 then 3 else 4, 9));"
    assert [Moment(read_law(text), {"s": s})["y"] for text in (nested, inside)] == [y, y]


def test_conditions_are_true_or_not() -> None:
    law = read_law("a = s > 0 and (pre(a) or s >= d);\nb = not s == 1 and s <> 2;")
    assert Moment(law, {"s": 0.5, "d": 1.0})["a"] == 0
    assert Moment(law, {"s": 0.5, "d": 1.0}, {"a": 1.0})["a"] == 1
    assert [Moment(law, {"s": s})["b"] for s in (0.0, 1.0, 2.0)] == [1, 0, 0]
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
    with pytest.raises(ValueError):  # noqa: PT011
        assert Moment(read_law(text), {"s": 1.0})["y"] is None


def test_many_values_are_worked_out_at_once() -> None:
    s = np.linspace(-2, 2, 9)
    law = read_law("y = if abs(s) > 1 then s - sign(s) else a*s; a = 0;")
    assert Moment(law, {"s": s})["y"] == pytest.approx(np.sign(s) * np.maximum(np.abs(s) - 1, 0))


@pytest.mark.parametrize(
    ("unit", "exponents"),
    [
        ("1", {}),
        ("rad/s", {"s": -1}),
        ("N.m", {"kg": 1, "m": 2, "s": -2}),
        ("N.s2/m2", {"kg": 1, "m": -1}),
        ("m3/(s.Pa)", {"kg": -1, "m": 4, "s": 1}),
        ("1/Pa", {"kg": -1, "m": 1, "s": 2}),
        ("V.A/W", {}),
    ],
)
def test_dimensions_of_units(unit: str, exponents: dict[str, int]) -> None:
    assert dimension(unit) == exponents


UNITS = {"x": "m", "v": "m/s", "c": "N.s2/m2", "F": "N", "w": "m/s", "n": "1", "A": "m2", "p": "Pa", "t": "s"}


@pytest.mark.parametrize(
    ("law", "unit"),
    [
        ("-c*v*abs(v)", "N"),
        ("-F*tanh(v/w)*(1 + n*exp(-abs(v)/w))", "N"),
        ("-F*tanh(v/1e-3)", "N"),
        ("if v > 0 then p*A else max(F, 2*F) - 3", "N"),
        ("sqrt(A)*x/t^2", "m2/s2"),
        ("v*t - x", "m"),
        ("F*(v/w)^n", "N"),
        ("F*(x/t)^(-2)*v^(1 + 1)", "N"),
    ],
)
def test_a_law_has_the_unit_of_what_it_gives(law: str, unit: str) -> None:
    assert check_units(parse(law), UNITS) == dimension(unit)


@pytest.mark.parametrize(
    ("law", "message"),
    [
        ("x + v", r"\+ takes m and m/s together"),
        ("if x > v then F else F", "> takes m and"),
        ("max(F, p)", "max takes"),
        ("F*tanh(v)", "tanh is given m/s; divide by a width"),
        ("F*v^n", r"\^ is given m/s; divide by a width"),
        ("F*v^99", "a power of 99 is no law"),
        ("c*v^(0/0)", "a power of nan is no law"),
        ("F*q", "q has no unit; the law may name x, v"),
        ("if v > 0 then F else x", "if takes"),
    ],
)
def test_units_that_do_not_agree_are_refused(law: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        check_units(parse(law), UNITS)


@pytest.mark.parametrize(
    "unit", ["m3/(s.Pa(1/2))", "m3/(s.Pa0.5)", "N*m", "m^2", "N.m/s/rad", "N m", "m³", "-", "m3/(s.Pa"]
)
def test_a_unit_that_modelica_cannot_read_is_refused_with_what_to_write(unit: str) -> None:
    with pytest.raises(
        ValueError, match=f"^{re.escape(unit)} is no unit of Modelica; write whole powers .* under a root"
    ):
        dimension(unit)


@pytest.mark.parametrize(
    "unit", ["", "1", "%", "l/min", "°C", "m3.s-1", "(N.m)/(rad.s)", "m/(N/s)", "m+2", "1/(V2.s2)"]
)
def test_a_unit_of_modelica_may_have_any_symbol(unit: str) -> None:
    check_unit(unit)


@pytest.mark.parametrize("unit", ["1", "N", "N.s/m", "Pa", "m3/s", "m3/(s.Pa)", "kg/m3", "1/s", "m/(K.s)", "kg.m3/s4"])
def test_dimensions_are_written_as_people_write_them(unit: str) -> None:
    assert dimension_words(dimension(unit)) == unit


def test_what_is_no_unit_is_refused() -> None:
    with pytest.raises(ValueError, match="furlong is no SI unit"):
        dimension("furlong")
