"""An answer goes into a line and comes back; what is empty takes no room."""

import json

import pytest

from validation.blind.benchmark.answer import Answer

FULL = Answer(
    "a", "c0de", "2026-01-02", "valve.deadband", ("valve.deadband",), ("valve.deadband", "oil.air"),
    (("valve.deadband", "card.error_deadzone"),), footprint=0.0, parts={"oil.air": 12.5}, held=1.002, base=3.0,
    final=0.05, bound=0.04, floor=0.003, determined=9, missed=("tau",), slot="spoolOpening", wall=12.5, cpu=12.0,
)  # fmt: skip


def test_a_line_and_back() -> None:
    assert Answer.read(FULL.line()) == FULL
    assert "\n" not in FULL.line()
    assert FULL.footprint == 0.0  # nothing left is something said
    assert Answer.read(FULL.line()).footprint == 0.0


def test_what_is_empty_takes_no_room_and_numbers_have_six_digits() -> None:
    given = json.loads(Answer("b", "c", "d", wall=1 / 3).line())
    assert given == {"case": "b", "code": "c", "day": "d", "wall": 0.333333}


@pytest.mark.parametrize("line", ["", "{", "[1]", '{"case": "a", "code": "b", "day": "c", "colour": 1}'])
def test_no_answer(line: str) -> None:
    with pytest.raises(ValueError, match=r"Expecting|answer|property"):
        Answer.read(line)
