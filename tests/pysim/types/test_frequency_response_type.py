"""What a frequency response, a sine test and a comparison refuse and tell."""

from typing import Any

import numpy as np
import pytest

from pysim.types import BadInput, Comparison, Criterion, Deviation, FrequencyResponse, ResponseComparison, SineTest

TEST = SineTest(-25.0, 5.0, "cmd", "angle")
GOOD: dict[str, Any] = {
    "frequency": [0.1, 1.0],
    "gain": [1.0, 0.5],
    "phase": [0.0, -1.0],
    "test": TEST,
    "origin": "by hand",
}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"gain": [1.0]}, r"gain needs shape \(2,\), got \(1,\)"),
        ({"covariance": np.zeros((2, 2))}, r"covariance needs shape \(2, 3, 3\)"),
        ({"phase": [0.0, np.nan]}, "every number of phase must be finite"),
        ({"frequency": [1.0, 1.0]}, "positive and increase"),
        ({"frequency": [0.0, 1.0]}, "positive and increase"),
        ({"frequency": [], "gain": [], "phase": []}, "positive and increase"),
        ({"gain": [1.0, 0.0]}, "gains must be positive"),
    ],
)
def test_response_refuses(change: dict[str, Any], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        FrequencyResponse(**{**GOOD, **change})


def test_response_cannot_be_changed_behind_its_back() -> None:
    gain = np.array([1.0, 0.5])
    response = FrequencyResponse(**{**GOOD, "gain": gain})
    gain[0] = 7.0
    assert response.gain[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        response.gain[0] = 7.0


@pytest.mark.parametrize(("offset", "amplitude"), [(0.0, 0.0), (0.0, -1.0), (np.inf, 1.0), (0.0, np.nan)])
def test_sine_test_refuses(offset: float, amplitude: float) -> None:
    with pytest.raises(BadInput, match="amplitude must be positive"):
        SineTest(offset, amplitude, "cmd", "angle")


def test_label_has_signs() -> None:
    assert TEST.label == "O-25 A5"


def test_copied_measurements_count_once() -> None:
    first = FrequencyResponse(**GOOD)
    copy = FrequencyResponse(**{**GOOD, "test": SineTest(25.0, 5.0, "cmd", "angle")})
    other = FrequencyResponse(**{**GOOD, "phase": [0.0, -1.0001]})
    tests = tuple(ResponseComparison(response, None, ()) for response in (first, copy, other))
    comparison = Comparison("m", "l", "d", "", tests)
    assert comparison.independent == 2
    assert [len(group) for group in comparison.groups] == [2, 1]
    assert not comparison.passes
    assert not Comparison("m", "l", "d", "", ()).passes


def test_an_independent_test_passes_where_all_its_rows_do() -> None:
    first, other = FrequencyResponse(**GOOD), FrequencyResponse(**{**GOOD, "phase": [0.0, -1.0001]})
    good = (Deviation(Criterion("", "", 1.0, "dB", ""), 0.5),)
    rows = [(first, good), (first, ()), (other, good), (other, good)]
    comparison = Comparison("m", "l", "d", "", tuple(ResponseComparison(r, None, d) for r, d in rows))
    assert (comparison.independent_passes, comparison.independent) == (1, 2)
