import pickle

import numpy as np
import pytest

from pysim.types import BadInput, Record


def test_record_is_a_copy_that_cannot_be_changed():
    time, values = np.arange(2.0), np.ones((2, 1))
    record = Record(time, values, ("y",), ("m",), statistics={"steps": 3})
    time[0], values[0] = -1.0, 7.0
    np.testing.assert_array_equal(record.time, [0, 1])
    np.testing.assert_array_equal(record["y"], [1, 1])
    for array in (record.time, record.values, record["y"]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 5.0
    assert dict(pickle.loads(pickle.dumps(record)).statistics) == {"steps": 3}


def test_lists_are_taken():
    record = Record([0, 1], [[1, 2], [3, 4]], ["a", "b"], ["m", "s"])
    np.testing.assert_array_equal(record["b"], [2, 4])
    assert (record.names, record.units) == (("a", "b"), ("m", "s"))


@pytest.mark.parametrize(
    ("time", "values", "names", "units", "words"),
    [
        ([0, 0], [[1], [2]], ("y",), ("m",), "finite and increase"),
        ([0, np.nan], [[1], [2]], ("y",), ("m",), "finite and increase"),
        ([[0, 1]], [[1], [2]], ("y",), ("m",), r"shape \(2, 1\)"),
        ([0, 1], [1, 2], ("y",), ("m",), r"need values of shape \(2, 1\), got \(2,\)"),
        ([0, 1], [[1], [2]], ("y",), (), "1 names need 1 units, got 0"),
        ([0, 1], [[1], [2]], "y", ("m",), "names is the text 'y'"),
        (["now"], [[1]], ("y",), ("m",), "time must hold numbers"),
    ],
)
def test_what_is_no_record_is_refused(time, values, names, units, words):
    with pytest.raises(BadInput, match=words):
        Record(time, values, names, units)
