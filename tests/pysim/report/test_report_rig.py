import json
import math

import numpy as np

from pysim.report.rig import heave_data, heave_page, heave_text, step_data, step_page, step_text
from pysim.rig import HeaveFigures, HeaveTest, StepFigures, StepTest

STEPS = [
    (StepTest("speed", 30.0), StepFigures(1e-6, 0.298, 0.019, 0.39, 0.05)),
    (StepTest("load", 40e5), StepFigures(-250.0, 0.353, math.nan, math.nan, 0.05)),
]
HEAVE = {"thesis": HeaveFigures(3.7, 15.1, 15.5e5, 63e5, 1.77e5, 13e5, 177e5, np.array([[7.0, 7.7]]), 0.7, 0.32)}


def test_steps_as_text_data_and_page() -> None:
    _, speed, load = step_text(STEPS).splitlines()
    assert speed.split() == ["speed", "30", "rad/s", "1e-06", "rad/s", "29.8", "0.019", "0.39"]
    assert load.split()[:6] == ["load", "pressure", "40", "bar", "-0.0025", "bar"]
    data = json.loads(json.dumps(step_data(STEPS), allow_nan=False))
    assert data[0]["overshoot"] == 0.298
    assert data[1]["settling_time_s"] is None
    html = step_page(STEPS, pictures={"A step.": b"<svg/>"}, redo="pysim rig step")
    assert "29.8" in html
    assert "A step." in html


def test_heave_as_text_data_and_page() -> None:
    test = HeaveTest(seed=7)
    row = heave_text(HEAVE).splitlines()[1]
    assert row.split() == ["thesis", "3.70", "15.1", "15.50", "63.0", "1.77", "13", "...", "177", "1", "0.70", "(0.32)"]
    data = json.loads(json.dumps(heave_data(HEAVE, test), allow_nan=False))
    assert data["wave"]["seed"] == 7
    assert data["controllers"]["thesis"]["standstills"] == [[7.0, 7.7]]
    html = heave_page(HEAVE, test, pictures={}, redo="pysim rig heave --seed=7")
    assert "15.50" in html
    assert "--seed=7" in html
