"""The answer as numbers and codes: what its verdict says, and that today's answer survives the way there and back."""

from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
import pytest

from pysim.types import BadInput, answer
from pysim.types._between_answers import from_answer, to_answer
from pysim.types.answer import FloorSource, LearnedLaw, Left, NoiseFloor
from pysim.types.note import Note, NoteCode
from tests.pysim.diagnosis_story import nothing, story


def same(one: Any, other: Any) -> bool:
    """Equal, arrays and what holds them to rounding."""
    if is_dataclass(one) and not isinstance(one, type):
        return type(one) is type(other) and all(same(getattr(one, f.name), getattr(other, f.name)) for f in fields(one))
    if isinstance(one, tuple):
        return isinstance(other, tuple) and len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, np.ndarray | float):
        return np.shape(one) == np.shape(other) and np.allclose(one, other, rtol=1e-12, atol=1e-12, equal_nan=True)
    return bool(one == other)


@pytest.mark.parametrize(
    "old", [story(), nothing(), story(verdict="unknown")], ids=["found", "none", "more is missing"]
)
def test_todays_answer_survives_the_way_there_and_back(old: Any) -> None:
    back = from_answer(to_answer(old))
    new = {"complete", "left"}  # judged since
    different = {f.name for f in fields(old) if not same(getattr(old, f.name), getattr(back, f.name))} - new
    assert different <= ({"verdict"} if old.verdict == "unknown" and old.added else set())  # an effect keeps its name


def test_the_verdict_follows_from_what_was_found() -> None:
    found = to_answer(story())
    assert found.verdict == found.effects[0].effect.name
    assert replace(found, complete=False).verdict == found.effects[0].effect.name
    assert replace(found, effects=(), learned=(), complete=False).verdict == "unknown"
    assert replace(found, effects=(), learned=(), complete=True).verdict == "none"
    law = LearnedLaw("force", "", "v", np.arange(3.0), np.zeros(3), np.eye(3), 0.9, "m/s", "N")
    assert replace(found, effects=(), learned=(law,), complete=True).verdict == "unknown"


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(BadInput, match="above 0"):
        NoiseFloor(0.0, FloorSource.SPECIFIED)
    with pytest.raises(BadInput, match="3 knots need 3 coefficients"):
        LearnedLaw("force", "", "v", np.arange(3.0), np.zeros(2), np.eye(3), 0.9, "m/s", "N")


def test_an_answer_does_not_change() -> None:
    values: dict[str, float | str] = {"value": 1.0}
    note = Note(NoteCode.AT_BOUND, values)
    values["value"] = 2.0
    assert note.values["value"] == 1.0
    law = LearnedLaw("force", "", "v", np.arange(3.0), np.zeros(3), np.eye(3), 0.9, "m/s", "N")
    with pytest.raises(ValueError, match="read-only"):
        law.knots[0] = 1.0
    assert Left({"a x": NoiseFloor(1.0, FloorSource.REPEATS)}, None, None).floors["a x"].sd == 1.0
    assert answer.Diagnosis((), True, Left({}, None, None), (), (), (), ()).seconds == {}
