"""Nulls are spread over conditions and plants, and are what they say."""

from collections import Counter

import pytest

from pysim.types import Record
from validation.nulls.answer import answer
from validation.nulls.case import shares
from validation.nulls.data import drawn, names


def test_a_third_of_each_condition_and_a_few_benches() -> None:
    parts = [name.split("-") for name in names()]
    assert Counter(condition for _, _, condition in parts) == {"coloured": 100, "motion": 100, "unstated": 100}
    assert Counter((plant, condition) for _, plant, condition in parts)["bench", "motion"] == 4


@pytest.mark.parametrize("name", ["000-mass-coloured", "001-mass-motion", "002-mass-unstated"])
def test_the_same_name_is_the_same_data_set(name: str) -> None:
    one, other = (drawn(name).dataset for _ in range(2))
    log, again = one.records[0].data, other.records[0].data
    assert isinstance(log, Record)
    assert isinstance(again, Record)
    assert (log.values == again.values).all()
    stated = one.signal("x").noise
    assert (stated == 1e-3) != name.endswith("unstated")
    assert (abs(log.values[0, 0]) > 1e-6) == name.endswith("motion")  # from rest the command is 0


def test_an_answer_says_what_was_named_and_is_counted() -> None:
    line = {"case": "002-mass-unstated", **answer("002-mass-unstated")}
    assert line["named"] == []
    wrong = [{**line, "named": ["x"]}, {**line, "complete": False}, {"case": "005-axis-unstated", "trouble": "ended"}]
    found = {share.label: (share.hits, share.of) for share in shares([line, *wrong])}
    assert found["an effect or a sensor error named although nothing is missing"] == (1, 4)
    assert found["said to be incomplete although nothing is missing"] == (2, 4)
    assert found["cases without an answer"] == (1, 4)
    assert found["mass: named"] == (1, 3)
