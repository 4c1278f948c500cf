"""What a complete model's logs would have shown is found where it is there, and what they would not is not."""

import pytest

from pysim.diagnosis import diagnose
from pysim.present import text
from pysim.types.answer import Diagnosis
from tests.pysim.diagnosis.plants import given, measured


def diagnosed(force: float) -> Diagnosis:
    effects = {"mass.bias": {"F_b": force}} if force else {}
    return diagnose(given("mass", measured("mass", effects, fit=(1, 2)), ["mass.bias"]))


def test_an_effect_is_found_from_the_size_on_that_the_answer_names() -> None:
    complete = diagnosed(0.0)
    assert complete.verdict == "none"
    (row,) = complete.detectable
    least = row.sizes["F_b"]
    assert (row.effect, row.units) == ("mass.bias", {"F_b": "N"})
    assert f"mass.bias: F_b = {least:.3g} N" in text(complete)
    assert least > 0
    large, small = diagnosed(1.6 * least), diagnosed(0.5 * least)
    assert [one.effect.name for one in large.effects] == ["mass.bias"]
    assert large.effects[0].estimates[0].value == pytest.approx(1.6 * least, rel=0.4)
    assert not small.effects


def test_an_effect_that_was_found_is_not_among_those_that_were_not() -> None:
    assert diagnosed(0.1).detectable == ()
