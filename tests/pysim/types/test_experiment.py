import numpy as np
import pytest

from pysim.types import BadInput, Experiment, Signal

_NONE = Signal(np.zeros(1), np.zeros((1, 4)), np.zeros((1, 0, 4)))


@pytest.mark.parametrize(
    ("times", "rest", "words"),
    [
        ([], {}, "finite, increasing"),
        ([0, 0], {}, "finite, increasing"),
        ([0, np.inf], {}, "finite, increasing"),
        ([1], {"start": 2.0}, "lies before the start"),
        ([1], {"record": ()}, "at least one variable"),
        ([1], {"rates": {"r": "u"}}, "give 'u' a signal"),
        ([1], {"rates": {"u": "u"}, "inputs": {"u": _NONE}}, "and 'u' none"),
    ],
)
def test_what_makes_no_sense_is_refused(times, rest, words):
    with pytest.raises(BadInput, match=words):
        Experiment(np.array(times, float), **{"record": ("x",), **rest})


def test_override_leaves_the_original_alone():
    first = Experiment(np.ones(1), ("x",), overrides={"a": 1.0})
    second = first.override(a=2.0, b=3.0)
    assert dict(first.overrides) == {"a": 1.0}
    assert dict(second.overrides) == {"a": 2.0, "b": 3.0}
    with pytest.raises(ValueError, match="read-only"):
        first.times[0] = 0.0
