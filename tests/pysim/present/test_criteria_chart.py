"""Criteria: limits are where the thesis has them."""

import pytest

from pysim.present.diagnosis.figures.criteria import criteria_chart

STEPS = [
    {"step": "prior", "fit": 64.0, "validate": 46.0, "criteria": {"E_M max": 4.0, "E_t mean": 3.0}},
    {"step": "refit", "fit": 20.0, "validate": None, "criteria": {"E_M max": 1.0}},
    {"step": "a<b>", "fit": 1.0, "validate": 0.9, "criteria": {"E_M max": 0.0, "E_t mean": 0.5}},
]


def test_criteria_stand_over_their_limits_which_are_a_line() -> None:
    found = criteria_chart(STEPS)
    magnitude = [t for t in found["data"] if t["legendgroup"] == "E_M max"]
    assert magnitude[0]["y"][:4] == pytest.approx([2, 2, 0.5, 0.5])  # of 2 dB
    assert magnitude[1]["text"][1] == "maximum magnitude deviation 4 of 2 dB"
    time = next(t for t in found["data"] if t["legendgroup"] == "E_t mean")
    assert time["y"] == pytest.approx([1.5, 1.5, None, None, 0.25, 0.25])  # of 2 %; not judged in between
    limit = found["layout"]["shapes"][0]
    assert (limit["y0"], limit["y1"]) == (1, 1)
    low, high = found["layout"]["yaxis"]["range"]
    assert low < 0 < high
    assert all(v is None or v > 0 for t in found["data"] for v in t["y"])  # nothing at minus infinity
