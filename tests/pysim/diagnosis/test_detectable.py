"""What a complete model's logs would have shown is found where it is there, and what they would not is not."""

import pytest

from pysim.diagnosis import diagnose
from pysim.present import text
from pysim.types.answer import Diagnosis
from tests.pysim.diagnosis.plants import given, measured


def diagnosed(coefficient: float) -> Diagnosis:
    effects = {"mass.drag": {"c_2": coefficient}} if coefficient else {}
    return diagnose(given("mass", measured("mass", effects, fit=(1, 2)), ["mass.drag"]))


def test_an_effect_is_found_from_the_size_on_that_the_answer_names() -> None:
    complete = diagnosed(0.0)
    assert complete.verdict == "none"
    (row,) = complete.detectable
    least = row.sizes["c_2"]
    assert (row.effect, row.units) == ("mass.drag", {"c_2": "N.s2/m2"})
    assert f"mass.drag: c_2 = {least:.3g} N.s2/m2" in text(complete)
    assert least > 0
    large, small = diagnosed(1.6 * least), diagnosed(0.5 * least)
    assert [one.effect.name for one in large.effects] == ["mass.drag"]
    assert large.effects[0].estimates[0].value == pytest.approx(1.6 * least, rel=0.4)
    assert not small.effects


def test_an_effect_that_was_found_is_not_among_those_that_were_not() -> None:
    assert diagnosed(1.0).detectable == ()
