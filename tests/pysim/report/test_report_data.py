"""The JSON form."""

import json

import pytest

from pysim.report import comparison_data
from tests.pysim.comparisons import FREQUENCIES, comparison


def test_everything_is_there_and_finite() -> None:
    text = json.dumps(comparison_data([comparison("A"), comparison("B", error_db=3.0, fails=1)]), allow_nan=False)
    data = json.loads(text)
    assert data["note"] == "Take it <with> care."
    assert data["criteria"]["max_magnitude_db"] == {"limit": 2.0, "unit": "dB", "source": "thesis Table 1.3"}
    a, b = data["parameter_sets"]
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
