import json
import math

import numpy as np
import pytest

from pysim.present import Drawing
from pysim.present.rig import heave, steps
from pysim.present.rig.heave import Heave, rig_error_figure, rig_heave_figure
from pysim.present.rig.steps import Steps, rig_step_figure
from pysim.rig import HeaveFigures, HeaveTest, StepFigures, StepTest
from pysim.rig.rig_system import OUTPUTS
from pysim.types import BadInput, Record

CRANE = ("crane.omegaS_ref", "crane.pL_ref")
STEPS = Steps(
    (
        (StepTest("speed", 30.0), StepFigures(1e-6, 0.298, 0.019, 0.39, 0.05)),
        (StepTest("load", 40e5), StepFigures(-250.0, 0.353, math.nan, math.nan, 0.05)),
    ),
    (),
)
FOLLOWED = HeaveFigures(3.7, 15.1, 15.5e5, 63e5, 1.77e5, 13e5, 177e5, np.array([[7.0, 7.7]]), 0.7, 0.32)
HEAVE = Heave(HeaveTest(seed=7), {"thesis": FOLLOWED}, {})


def record(length: float) -> Record:
    """A shaft that follows 20 sin(t) but stands still for 0.4 s at each zero, under 105 bar that are 1 bar off."""
    time = np.arange(0.0, length, 0.002)
    reference = 20 * np.sin(time)
    speed = np.where(np.abs(np.sin(time)) < np.sin(0.2), 0.0, reference)
    columns = {name: np.zeros(time.size) for name in (*OUTPUTS, *CRANE)}
    columns |= {"rig.omega": speed, "rig.omegaS": speed, "crane.omegaS_ref": reference}
    columns |= {"crane.pL_ref": np.full(time.size, 105e5), "rig.pL": np.full(time.size, 106e5)}
    units = tuple("Pa" if ".p" in name else "rad/s" for name in columns)
    return Record(time, np.column_stack(list(columns.values())), tuple(columns), units)


def test_heave_shows_standstills_and_bar() -> None:
    figure = rig_heave_figure(record(20.0), HeaveTest(length=17.0))
    speed, load, _, close = figure.axes
    assert np.asarray(load.lines[0].get_ydata()) == pytest.approx(np.full(10000, 106.0))
    assert np.asarray(speed.lines[1].get_ydata())[785] == pytest.approx(20 * np.sin(1.57))
    spans = sorted((p.get_extents().x0, p.get_extents().x1) for p in close.patches)
    assert len(spans) == 7  # zeros of sin in 20 s, that at the start among them
    low, high = close.get_xlim()
    assert high - low == pytest.approx(3.0, abs=0.01)


def test_errors_of_each_controller() -> None:
    figure = rig_error_figure({"thesis": record(20.0), "other": record(20.0)})
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["thesis", "other"]
    for axes in figure.axes:
        assert np.asarray(axes.lines[0].get_ydata()) == pytest.approx(np.full(10000, 1.0))
        assert np.asarray(axes.lines[1].get_ydata())[5000] == pytest.approx(1.0, abs=1e-6)
    with pytest.raises(BadInput, match="at least one record"):
        rig_error_figure({})


@pytest.mark.parametrize(("kind", "size"), [("speed", 20.0), ("load", 40e5)])
def test_step_draws_reference_and_answer(kind: str, size: float) -> None:
    test = StepTest(kind, size, at=2.0, length=12.0)  # type: ignore[arg-type]
    axes = rig_step_figure(record(14.0), test).axes
    lines = axes[0].lines
    scale = 1.0 if kind == "speed" else 1e-5
    assert np.asarray(lines[0].get_ydata())[-1] == pytest.approx(size * scale)
    assert np.asarray(lines[0].get_ydata())[0] == 0.0
    assert axes[0].get_ylabel() == ("Speed (rad/s)" if kind == "speed" else "Load pressure (bar)")
    assert axes[2].get_ylabel() == ("Speed (rad/s)" if kind == "load" else "Load pressure (bar)")


def test_steps_as_text_data_and_page() -> None:
    _, speed, load = steps.text(STEPS).splitlines()
    assert speed.split() == ["speed", "30", "rad/s", "1e-06", "rad/s", "29.8", "0.019", "0.39"]
    assert load.split()[:6] == ["load", "pressure", "40", "bar", "-0.0025", "bar"]
    data = json.loads(json.dumps(steps.data(STEPS), allow_nan=False))
    assert data[0]["overshoot"] == 0.298
    assert data[1]["settling_time_s"] is None
    html = steps.page(STEPS, [Drawing("step_speed", "A step.", b"<svg/>")], "pysim rig step")
    assert "29.8" in html
    assert "A step." in html


def test_heave_as_text_data_and_page() -> None:
    row = heave.text(HEAVE).splitlines()[1]
    assert row.split() == ["thesis", "3.70", "15.1", "15.50", "63.0", "1.77", "13", "...", "177", "1", "0.70", "(0.32)"]
    data = json.loads(json.dumps(heave.data(HEAVE), allow_nan=False))
    assert data["wave"]["seed"] == 7
    assert data["controllers"]["thesis"]["standstills"] == [[7.0, 7.7]]
    html = heave.page(HEAVE, [], "pysim rig heave --seed=7")
    assert "15.50" in html
    assert "--seed=7" in html
