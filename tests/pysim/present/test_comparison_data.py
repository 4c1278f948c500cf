"""The JSON form."""

import json
from dataclasses import replace

import numpy as np
import pytest

from pysim.present.comparison import Comparisons, data
from tests.pysim.comparisons import FREQUENCIES, comparison


def test_everything_is_there_and_finite() -> None:
    both = Comparisons("t", (comparison("A"), comparison("B", error_db=3.0, fails=1)))
    found = json.loads(json.dumps(data(both), allow_nan=False))
    assert found["note"] == "Take it <with> care."
    assert found["criteria"]["max_magnitude_db"] == {"limit": 2.0, "unit": "dB", "source": "thesis Table 1.3"}
    a, b = found["parameter_sets"]
    assert (a["label"], a["passes"], a["passed"], a["independent"], a["overrides"]) == ("A", True, 4, 1, {"k": 2.5})
    assert (b["passes"], b["passed"]) == (False, 0)
    failed, ran = b["tests"][:2]
    assert failed["simulated"] is None
    assert failed["deviations"]["mean_phase_deg"] is None
    assert failed["message"] == "at 5 Hz: stopped"
    assert ran["deviations"]["max_magnitude_db"] == pytest.approx(3.0)
    assert ran["frequency_hz"] == list(FREQUENCIES)
    assert ran["measured"]["magnitude_db"][0] == 0.0
    assert ran["simulated"]["gain"][1] == pytest.approx(ran["measured"]["gain"][1] * 10 ** (3 / 20))


def test_what_it_takes_to_do_it_again_is_there() -> None:
    one = replace(comparison("A"), conditions={"solver": "Rk4"}, parameters={"k": (2.5, "1")}, reference_hz=None)
    found = data(Comparisons("t", (one,)))
    (only,) = found["parameter_sets"]
    assert (only["conditions"], only["parameters"]) == ({"solver": "Rk4"}, {"k": {"value": 2.5, "unit": "1"}})
    assert (only["independent"], only["independent_passed"], found["measured"]) == (1, 1, "measured")
    test = only["tests"][0]
    assert test["measured"]["magnitude_db"] == pytest.approx([20 * np.log10(g) for g in test["measured"]["gain"]])
    assert data(Comparisons("t", (one,))) == found
