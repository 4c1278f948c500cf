import pickle

import numpy as np
import pytest

from pysim.types import BadInput, Experiment, Signal, rows_every

_NONE = Signal.constant(0.0)


@pytest.mark.parametrize(
    ("times", "rest", "words"),
    [
        ([], {}, "finite, increasing"),
        ([0, 0], {}, "finite, increasing"),
        ([0, np.inf], {}, "finite, increasing"),
        ([1], {"start": 2.0}, "lies before the start"),
        ([1], {"record": ()}, "at least one variable"),
        (["a"], {}, "finite, increasing"),
        ([1], {"record": None}, "record is None; write a tuple of the names"),
        ([1], {"record": ("x", 1)}, r"record is \('x', 1\); write a tuple of the names"),
        ([1], {"start": "0"}, "start is '0' s; give a finite time"),
        ([1], {"start": np.nan}, "start is nan s; give a finite time"),
        ([1], {"record": "abc"}, r"record is the text 'abc'; write a tuple of names, \('abc',\)"),
        ([1], {"inputs": {"u": 5.0}}, r"input 'u' is 5\.0; give a Signal, as Signal\.constant"),
        ([1], {"overrides": {"a": "5"}}, "'a' cannot be set to '5'; give a number"),
        ([1], {"rates": {"r": "u"}}, "give 'u' a signal"),
        ([1], {"rates": {"u": "u"}, "inputs": {"u": _NONE}}, "and 'u' none"),
    ],
)
def test_what_makes_no_sense_is_refused(times, rest, words):
    with pytest.raises(BadInput, match=words):
        Experiment(times, **{"record": ("x",), **rest})


@pytest.mark.parametrize(
    ("step", "start", "stop", "rows"),
    [
        (0.3, 0.0, 1.0, [0, 0.3, 0.6, 0.9, 1]),
        (0.7, 0.0, 1.0, [0, 0.7, 1]),
        (1.0, 0.0, 1.0, [0, 1]),
        (0.5, 2.0, 3.2, [2, 2.5, 3, 3.2]),
    ],
)
def test_a_row_at_every_step_and_one_at_the_end(step, start, stop, rows):
    assert rows_every(step, start, stop) == pytest.approx(rows, abs=1e-12)


def test_a_step_that_divides_the_run_leaves_no_short_one():
    for n in range(1, 2000):
        assert rows_every(1 / n, 0.0, 1.0).size == rows_every(0.1, 0.0, 0.1 * n).size == n + 1


def test_override_leaves_the_original_alone():
    first = Experiment(np.ones(1), ("x",), overrides={"a": 1.0})
    second = first.override(a=2.0, b=3.0)
    assert dict(first.overrides) == {"a": 1.0}
    assert dict(second.overrides) == {"a": 2.0, "b": 3.0}
    with pytest.raises(ValueError, match="read-only"):
        first.times[0] = 0.0


def test_goes_to_another_process_and_stays_as_it_is():
    inputs = {"u": _NONE}
    first = Experiment(np.ones(1), ["x"], inputs, {"a": 1.0}, rates={"u_t": "u"})
    inputs["v"] = _NONE
    second = pickle.loads(pickle.dumps(first))
    assert (second.record, dict(second.overrides), dict(second.rates)) == (("x",), {"a": 1.0}, {"u_t": "u"})
    assert list(second.inputs) == ["u"]
    with pytest.raises(TypeError):
        second.overrides["a"] = 2.0
