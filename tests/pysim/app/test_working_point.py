"""Operating points as people read them."""

from dataclasses import replace

import pytest

from pysim.app.working_point import command_unit, response_unit, working_point
from tests.pysim.diagnosis_answer import dataset


@pytest.mark.parametrize(
    ("offset", "amplitude", "unit", "words"),
    [
        (1e7, 2e6, "Pa", "100 ± 20 bar"),
        (0.05, 0.002, "m", "50 ± 2 mm"),
        (-25.0, 10.0, "%", "-25 ± 10 %"),
        (0.5, 0.1, "1", "0.5 ± 0.1"),
        (50.0, 10.0, "", "50 ± 10"),
    ],
)
def test_both_numbers_are_in_the_unit_behind_them(offset: float, amplitude: float, unit: str, words: str) -> None:
    assert working_point(offset, amplitude, unit) == words


def test_the_unit_is_that_of_the_command() -> None:
    assert [command_unit(dataset(), name) for name in ("F", "x", "", "gone")] == ["N", "m", "", ""]


def test_a_response_of_logs_has_the_unit_of_the_logs_at_its_point() -> None:
    data = replace(dataset(), records=tuple(replace(record, command="F") for record in dataset().records))
    for name, offset, unit in (("command", 50.0, "N"), ("command", 51.0, ""), ("x", 51.0, "m")):
        assert response_unit(data, {"input": name, "offset": offset, "amplitude": 10.0}) == unit
