"""Bode plots: the band is where the criteria have it."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.identify import frequency_deviations
from pysim.identify.greybox import Measurements, SinePlan, Treatment, problem
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.present.comparison.figures import bode_chart, reference_place
from pysim.types import Abilities, FrequencyResponse, Model, SineTest, Variable
from tests.pysim.identify.greybox import measurements
from tests.pysim.present.looking import trace

F = [0.1, 1.0, 10.0]
SIDE = {"gain": [2.0, 2.0, 0.2], "phase": [-0.1, -1.0, -2.0]}


def response(**more: Any) -> dict[str, Any]:
    """One operating point."""
    return {"frequency": F, "measured": SIDE, "input": "u", "output": "y", **more}


def test_a_bode_plot_has_the_band_of_table_1_3_around_what_was_measured() -> None:
    found = bode_chart(response(), [])
    assert trace(found, "measured")["y"] == pytest.approx([0, 0, -20])  # dB above 0.1 Hz
    assert trace(found, "measured", "y2")["y"] == pytest.approx([math.degrees(v) for v in SIDE["phase"]])
    for panel, limit in (("y", 2.0), ("y2", 35.0)):
        y = trace(found, "measured", panel)["y"]
        band = trace(found, "± 2 dB, ± 35°", panel)
        assert band["x"] == [*F, *reversed(F)]
        assert band["y"] == pytest.approx([v + limit for v in y] + [v - limit for v in reversed(y)])


def test_a_model_a_turn_away_is_drawn_beside_what_was_measured() -> None:
    side = {"gain": [1.0, 0.5, 0.1], "phase": [v + 2 * math.pi for v in SIDE["phase"]]}
    found = bode_chart(response(), [("refit", "refitted", side)])
    assert trace(found, "refitted", "y2")["y"] == pytest.approx([math.degrees(v) for v in SIDE["phase"]])
    assert trace(found, "refitted")["y"] == pytest.approx([0, 20 * math.log10(0.5), -20])
    assert trace(found, "refitted")["line"]["dash"] != trace(found, "measured")["line"]["dash"]


def test_frequencies_have_numbers_wherever_they_lie_and_however_near_one_looks() -> None:
    found = bode_chart(response(frequency=[250.0, 500.0, 900.0]), [])["layout"]["xaxis"]
    assert (found["type"], found["tickformat"]) == ("log", "~g")
    assert {"tickvals", "ticktext", "dtick"}.isdisjoint(found)  # Plotly finds them anew at each zoom


@pytest.mark.parametrize(
    ("frequency", "title"),
    [
        ((0.1, 1.0, 5.0), "Magnitude relative to 0.1 Hz (dB)"),
        ((0.05, 0.1, 1.0), "Magnitude relative to 0.1 Hz (dB)"),  # not the lowest
        ((0.5, 1.0, 5.0), "Magnitude, absolute (dB)"),
    ],
)
def test_curves_are_as_far_apart_as_the_verdict_says(frequency: tuple[float, ...], title: str) -> None:
    """A model whose gain is 1.5 times too large, and falls in another way."""
    gain, off = np.array([2.0, 1.7, 0.4]), np.array([1.5, 1.6, 1.2])
    test = SineTest(0.0, 1.0, "u", "y")
    sides = [FrequencyResponse(np.array(frequency), g, np.zeros(3), test, "made up") for g in (gain * off, gain)]
    place = judged(frequency)
    judging = frequency_deviations(*sides, reference_hz=None if place is None else frequency[place])
    told = [{"gain": side.gain.tolist(), "phase": [0.0] * 3} for side in sides]
    found = bode_chart({"frequency": list(frequency), "measured": told[1]}, [("refit", "refitted", told[0])])
    apart = np.abs(np.subtract(trace(found, "refitted")["y"], trace(found, "measured")["y"]))
    assert (np.mean(apart), np.max(apart)) == pytest.approx([one.value for one in judging[:2]])
    assert found["layout"]["yaxis"]["title"]["text"] == title


@pytest.mark.parametrize("frequency", [0.1, 0.10005, 0.1002, 0.0999, 0.2])
def test_the_reference_is_the_one_that_logs_are_judged_by(frequency: float) -> None:
    assert reference_place((0.05, frequency, 1.0)) == judged((0.05, frequency, 1.0))


def judged(frequency: Sequence[float]) -> int | None:
    """The place that a fit takes for logs of stepped sines at these frequencies."""
    abilities = Abilities(2, True, False, False, False, 0, (), ())
    variables = [
        Variable(name, 0, "Real", causality, "continuous", 0.0, "1", None, "", None, None, None, None)
        for name, causality in (("w", "input"), ("y", "output"))
    ]
    logs = [measurements.sine_log(1.5, 0.4, f, 1) for f in frequency]
    data = Measurements(measurements.dataset(logs))
    model = Model(Path("m.fmu"), "m", "t", tuple(variables), abilities)
    treatment = Treatment(rest=None, sine=SinePlan(settle_time=0.5))
    (sines,) = problem(model, [data], [], treatment=treatment).observations
    assert isinstance(sines, SteppedSines)
    return sines.reference
