"""Units and what they are in SI."""

import math
import re
from pathlib import Path

import pytest

from pysim.types import SI, SYNONYMS, UNITS, conversion, in_si

PAGE = Path(__file__).parents[3] / "docs" / "data.md"


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


def test_the_page_on_data_lists_every_unit() -> None:
    section = re.search(r"^## Units\n(.*?)^## ", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)[1]
    rows = [line.split("|")[1:-1] for line in section.split("\n") if line.startswith("| `")]
    listed = [[re.findall(r"`([^`]*)`", cell) for cell in row] for row in rows]
    assert {unit: si for (si,), own, also in listed for unit in (*own, *also)} == {u: in_si(u)[0] for u in UNITS}
    assert {unit for _, _, also in listed for unit in also} == set(SYNONYMS)
