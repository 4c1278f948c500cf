"""Units and what they are in SI."""

import math

import pytest

from pysim.types import SI, SYNONYMS, UNITS, conversion, in_si


@pytest.mark.parametrize(
    ("source", "target", "factor", "offset"),
    [
        ("bar", "Pa", 1e5, 0.0),
        ("Pa", "bar", 1e-5, 0.0),
        ("l/min", "l/h", 60.0, 0.0),
        ("rpm", "rad/s", math.pi / 30, 0.0),
        ("°", "rad", math.pi / 180, 0.0),
        ("kNm", "N.m", 1e3, 0.0),
        ("km/h", "m/s", 1 / 3.6, 0.0),
        ("psi", "Pa", 0.45359237 * 9.80665 / 0.0254**2, 0.0),
        ("degC", "K", 1.0, 273.15),
        ("K", "°C", 1.0, -273.15),
        ("degF", "degC", 5 / 9, -160 / 9),
        ("furlong", "furlong", 1.0, 0.0),
    ],
)
def test_from_one_unit_to_another(source: str, target: str, factor: float, offset: float) -> None:
    assert conversion(source, target) == (pytest.approx(factor, rel=1e-12), pytest.approx(offset, rel=1e-12))


@pytest.mark.parametrize(("source", "target"), [("bar", "m"), ("%", "1"), ("Hz", "rad/s"), ("Pa", "furlong")])
def test_units_of_different_quantities_have_nothing_in_common(source: str, target: str) -> None:
    assert conversion(source, target) is None


def test_every_unit_is_known_once_and_in_si() -> None:
    assert len(UNITS) == len(set(UNITS))
    for unit in UNITS:
        assert in_si(in_si(unit)[0]) == (in_si(unit)[0], 1.0, 0.0)
    assert {word: in_si(word) for word in SYNONYMS} == {word: in_si(unit) for word, unit in SYNONYMS.items()}
    assert set(UNITS) - set(SI) == {"degC", "degF", "°C", "°F"}  # no factor alone is enough for these
