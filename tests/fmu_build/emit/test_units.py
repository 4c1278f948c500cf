"""Unit strings against the definitions of the units."""

import math

import pytest

from fmu_build.emit.units import BASE_UNITS, conversion, parse_unit


def described(text):
    """{base: exponent}, factor, offset of the unit."""
    unit = parse_unit(text)
    return {b: e for b, e in zip(BASE_UNITS, unit.exponents, strict=True) if e}, unit.factor, unit.offset


@pytest.mark.parametrize(
    ("text", "exponents", "factor"),
    [
        ("1", {}, 1),
        ("%", {}, 0.01),
        ("m3/s", {"m": 3, "s": -1}, 1),
        ("N.s/m", {"kg": 1, "s": -1}, 1),
        ("kg/m3", {"kg": 1, "m": -3}, 1),
        ("1/s", {"s": -1}, 1),
        ("s-1", {"s": -1}, 1),
        ("m^2", {"m": 2}, 1),
        ("rad/s", {"rad": 1, "s": -1}, 1),
        ("rad/s2", {"rad": 1, "s": -2}, 1),
        ("Pa", {"kg": 1, "m": -1, "s": -2}, 1),
        ("bar", {"kg": 1, "m": -1, "s": -2}, 1e5),
        ("MPa", {"kg": 1, "m": -1, "s": -2}, 1e6),
        ("deg", {"rad": 1}, math.pi / 180),
        ("rev/min", {"rad": 1, "s": -1}, 2 * math.pi / 60),
        ("l/min", {"m": 3, "s": -1}, 1e-3 / 60),
        ("cm3", {"m": 3}, 1e-6),
        ("min", {"s": 1}, 60),
        ("ms", {"s": 1}, 1e-3),
        ("mm2/s", {"m": 2, "s": -1}, 1e-6),
        ("cSt", {"m": 2, "s": -1}, 1e-6),
        ("kg.m2", {"kg": 1, "m": 2}, 1),
        ("N.m/rad", {"kg": 1, "m": 2, "s": -2, "rad": -1}, 1),
        ("m3/(s.Pa)", {"m": 4, "s": 1, "kg": -1}, 1),
        ("1/(Pa.s)", {"m": 1, "s": 1, "kg": -1}, 1),
        ("kW.h", {"kg": 1, "m": 2, "s": -2}, 3.6e6),
        ("V", {"kg": 1, "m": 2, "s": -3, "A": -1}, 1),
        ("degC", {"K": 1}, 1),
        ("kvar", {"kg": 1, "m": 2, "s": -3}, 1e3),
        ("mSv", {"m": 2, "s": -2}, 1e-3),
        ("Hz", {"s": -1}, 1),
        ("t", {"kg": 1}, 1e3),
        ("kt/s", {"kg": 1, "s": -1}, 1e6),
        ("ft", {"m": 1}, 0.3048),
        ("in2", {"m": 2}, 0.0254**2),
        ("Pa/(m3/s)", {"kg": 1, "m": -4, "s": -1}, 1),
        ("(Pa/(l/min))/s", {"kg": 1, "m": -4, "s": -2}, 6e4),
        ("(m/s)/(rad/s)", {"m": 1, "rad": -1}, 1),
    ],
)
def test_units_in_si_base_units(text, exponents, factor):
    found = described(text)
    assert found[0] == exponents
    assert found[1] == pytest.approx(factor, rel=1e-14)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "furlong",
        "m3/ss",
        "m/",
        "/s",
        "m/s.kg",
        "m2.5",
        "mmin",
        "kg m",
        "at",
        "mt",
        "N/m/s",
        "Pa/(m3/s",
        "m(s)",
        "()",
        "Pa/(m)(s)",
    ],
)
def test_what_is_not_a_unit_is_not_understood(text):
    assert parse_unit(text) is None


@pytest.mark.parametrize(
    ("unit", "display", "value", "shown"),
    [
        ("Pa", "bar", 3e5, 3.0),
        ("K", "degC", 300.0, 26.85),
        ("K", "degF", 273.15, 32.0),
        ("rad", "deg", math.pi, 180.0),
        ("m3/s", "l/min", 1e-3, 60.0),
        ("rad/s", "rev/min", 2 * math.pi, 60.0),
        ("bar", "Pa", 1.0, 1e5),
        ("Hz", "rpm", 25.0, 1500.0),
        ("kHz", "rev/min", 0.025, 1500.0),
        ("rpm", "Hz", 1500.0, 25.0),
        ("Hz", "1/s", 25.0, 25.0),
        ("1/s", "rev/min", 25.0, 1500.0),
        ("1/min", "rpm", 1500.0, 1500.0),
        ("rad/s", "Hz", 2 * math.pi, 1.0),
        ("Hz", "deg/s", 1.0, 360.0),
        ("m3/rad", "cm3/rev", 1e-6, 2 * math.pi),
        ("m3", "cm3/rev", 1e-6, 1.0),
    ],
)
def test_display_units(unit, display, value, shown):
    factor, offset = conversion(parse_unit(unit), parse_unit(display))
    assert factor * value + offset == pytest.approx(shown, rel=1e-12)


def test_factors_are_tidy():
    assert conversion(parse_unit("Pa"), parse_unit("bar")) == (1e-5, 0.0)
    assert conversion(parse_unit("m3/s"), parse_unit("l/min")) == (60000.0, 0.0)


@pytest.mark.parametrize(
    ("unit", "display"),
    [("Pa", "N"), ("1/s", "rad/s"), ("rad/s", "1/min"), ("1", "deg"), ("N.m", "N.m/rad"), ("m3/rad", "cm3")],
)
def test_what_measures_something_else_or_may(unit, display):
    assert conversion(parse_unit(unit), parse_unit(display)) is None
    assert conversion(parse_unit(display), parse_unit(unit)) is None


def test_powers_of_cycles():
    assert conversion(parse_unit("rad2/s2"), parse_unit("Hz2")) == (pytest.approx(1 / (4 * math.pi**2)), 0.0)
    assert conversion(parse_unit("rad/s2"), parse_unit("Hz2")) is None
