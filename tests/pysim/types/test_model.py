import pickle

import pytest

from pysim.types import BadInput
from tests.pysim import comparisons as linear


def test_representation_is_short():
    text = repr(linear.model())
    assert "Linear" in text
    assert "linear.fmu" in text
    assert "Variable" not in text


def test_unknown_name_is_refused_with_those_near_it():
    with pytest.raises(BadInput, match=r"linear\.fmu has no variable 'angel'; near it: angle"):
        linear.model()["angel"]


def test_comparison_goes_to_another_process():
    comparison = pickle.loads(pickle.dumps(linear.comparison("a")))
    assert comparison.passes
    assert dict(comparison.overrides) == {"k": 2.5}
