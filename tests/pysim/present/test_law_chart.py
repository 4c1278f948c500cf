"""The missing term in units that people read."""

import math

import pytest

from pysim.present.diagnosis.figures.law import law_chart


def test_a_missing_term_is_shown_in_the_units_people_use() -> None:
    shape = {"argument": [-0.1, 0.1], "value": [-2.0, 2.0], "low": [-3.0, 1.0], "high": [-1.0, 3.0]}
    shape |= {"argument_unit": "m/s", "unit": "Pa"}
    found = law_chart({"slot": "force", "depends_on": "force.v", "factor": "", "shape": shape})
    band, line = found["data"]
    assert line["x"] == pytest.approx([-100, 100])
    assert line["y"] == pytest.approx([-2e-5, 2e-5])
    assert band["y"] == pytest.approx([-1e-5, 3e-5, 1e-5, -3e-5])
    assert found["layout"]["xaxis"]["title"]["text"] == "force.v (mm/s)"
    shape |= {"argument_unit": "rad/s", "unit": "rad"}
    found = law_chart({"slot": "force", "depends_on": "force.w", "factor": "sign(w)", "shape": shape})
    assert found["data"][1]["x"] == pytest.approx([-3 / math.pi, 3 / math.pi])
    assert found["layout"]["xaxis"]["title"]["text"] == "force.w (rpm)"
    assert found["layout"]["yaxis"]["title"]["text"] == "missing at force / sign(w) (°)"
