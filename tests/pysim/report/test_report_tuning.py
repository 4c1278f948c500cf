import json
import math

import pytest

from pysim.control.tuning import known_pi, load_pressure_plant, shaft_speed_plant
from pysim.report.tuning import tuning_data, tuning_page, tuning_text

LOOPS = {
    "MATLAB": known_pi(load_pressure_plant(), 1.01e-9, 0.023),
    "wild": known_pi(shaft_speed_plant(), 1.41e-5, 0.000159),
}


def test_text_tells_gains_margins_and_stability() -> None:
    head, first, second = tuning_text(LOOPS).splitlines()
    assert head.split()[:1] == ["K_p"]
    assert {"1.01e-09", "0.023", "3.018", "60.06", "35.5", "yes"} <= set(first.split())
    assert second.endswith("NO")


def test_data_in_hertz_and_degrees() -> None:
    data = json.loads(json.dumps(tuning_data(LOOPS), allow_nan=False))
    assert data["MATLAB"]["phase_margin_deg"] == pytest.approx(60.06, abs=0.01)
    assert data["MATLAB"]["crossover_hz"] == pytest.approx(18.96 / (2 * math.pi), rel=1e-3)
    assert data["wild"]["stable"] is False


def test_page_holds_table_picture_and_the_way_back() -> None:
    html = tuning_page(LOOPS, pictures={"A caption.": b"<svg/>"}, redo="pysim tune load")
    for part in ("A caption.", "60.06", "pysim tune load"):
        assert part in html
