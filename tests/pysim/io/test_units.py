"""Units that people read in place of SI units."""

import math

import pytest

from pysim.io import SI, shown_point, shown_unit, shown_value


def test_what_is_read_is_worth_what_it_stands_for() -> None:
    read = {unit: shown_unit(unit) for unit in ("Pa", "m", "m/s", "m3/s", "rad", "rad/s")}
    assert [unit for unit, _ in read.values()] == ["bar", "mm", "mm/s", "l/min", "deg", "rpm"]
    for unit, (shown, factor) in read.items():
        assert SI[shown] == (unit, pytest.approx(1 / factor))
    assert shown_unit("rad/s")[1] == pytest.approx(30 / math.pi)


def test_other_units_are_read_as_they_are() -> None:
    assert (shown_unit("N"), shown_unit("1"), shown_unit("")) == (("N", 1.0), ("-", 1.0), ("", 1.0))


def test_a_number_is_read_with_its_unit_where_it_has_one() -> None:
    read = [shown_value(1e7, "Pa"), shown_value(-50.0, "%", "+g"), shown_value(0.5, "1"), shown_value(2.0, "")]
    assert read == ["100 bar", "-50 %", "0.5", "2"]
    assert shown_value(123456.0, "Pa", ".2g") == "1.2 bar"


def test_a_point_is_told_with_its_command_where_there_are_several() -> None:
    assert shown_point(25.0, 10.0, "%") == "offset 25 %, amplitude 10 %"
    assert shown_point(1e7, 2e6, "Pa", "p_A") == "p_A at offset 100 bar, amplitude 20 bar"
