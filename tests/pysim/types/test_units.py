"""Units and what they are in SI, against factors that were written down independently of ours."""

import pytest

from pysim.types import SI, UNITS, conversion, in_si

# SI unit: its words, then each other unit with its words and how many SI units it is.
# Source: Bureau International des Poids et Mesures, The International System of Units, 9th edition; inch, pound-force
# and standard gravity as defined there and in ISO 80000 (psi = 0.45359237 * 9.80665 / 0.0254^2 Pa).
TABLE = """
1: - 1
%:
%/s:
s: sec secs second seconds 1, ms msec 0.001, us µs μs 0.000001, ns 0.000000001, min minutes 60, h hours 3600
Hz: kHz 1000
1/s:
rad: deg ° 0.017453292519943295
rad/s: deg/s °/s 0.017453292519943295, rpm rev/min 1/min U/min 0.10471975511965978
rad/s2: rad/s² 1, deg/s2 °/s² 0.017453292519943295
m: mm 0.001, cm 0.01, um µm μm 0.000001, in 0.0254
m/s: mm/s 0.001, m/min 0.016666666666666667, km/h 0.27777777777777778
m/s2: m/s² m/s^2 1, mm/s2 mm/s² 0.001
m2: m² 1, mm2 mm² 0.000001, cm2 cm² 0.0001
m3: m³ 1, cm3 cm³ ccm ml 0.000001, dm3 l L 0.001
m3/s: m³/s 1, l/min L/min lpm 0.000016666666666666667, l/s L/s 0.001, l/h L/h 0.00000027777777777777778
m3/s: m3/h m³/h 0.00027777777777777778, cm3/s 0.000001
m2/s: mm2/s mm²/s cSt 0.000001
Pa: hPa mbar 100, kPa 1000, MPa 1000000, bar 100000, psi 6894.7572931683613
Pa/s: bar/s 100000
Pa.s: Pas 1, mPa.s mPas 0.001
N: kN 1000
N.m: Nm N*m 1, kN.m kNm 1000
N/m: N/mm 1000
N.s/m: Ns/m 1
kg:
kg/s: kg/min 0.016666666666666667, kg/h 0.00027777777777777778
kg/m3: kg/m³ 1
K:
V: mV 0.001
V/s:
A: mA 0.001
W: kW 1000
J: kJ 1000
"""
ZEROS = {"degC": (1.0, 273.15), "°C": (1.0, 273.15), "degF": (0.55555555555555556, 255.37222222222222)}
ZEROS["°F"] = ZEROS["degF"]


def table() -> dict[str, tuple[str, float, float]]:
    """Every word -> SI unit, factor, and where its zero lies."""
    found = {word: ("K", *numbers) for word, numbers in ZEROS.items()}
    for line in TABLE.strip().splitlines():
        si, _, others = line.partition(":")
        found[si] = (si, 1.0, 0.0)
        for *words, factor in (entry.split() for entry in others.split(",") if entry.strip()):
            found |= {word: (si, float(factor), 0.0) for word in words}
    return found


def test_every_unit_is_what_the_table_says() -> None:
    expected = table()
    assert set(expected) == set(UNITS)
    assert len(UNITS) == len(set(UNITS))
    for word, (si, factor, zero) in expected.items():
        assert in_si(word) == (si, pytest.approx(factor, rel=1e-14), pytest.approx(zero, rel=1e-14)), word
    assert {word: SI[word][1] for word in SI} == pytest.approx({word: expected[word][1] for word in SI}, rel=1e-14)
    assert set(UNITS) - set(SI) == set(ZEROS)  # no factor alone is enough for these


@pytest.mark.parametrize(
    ("source", "target", "factor", "offset"),
    [
        ("bar", "Pa", 1e5, 0.0),
        ("Pa", "bar", 1e-5, 0.0),
        ("l/min", "l/h", 60.0, 0.0),
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
