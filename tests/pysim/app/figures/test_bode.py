"""Bode plots: the band is where the criteria have it."""

import math
from typing import Any

import pytest

from pysim.app.figures import bode_figure
from tests.pysim.app.figures.traces import trace

F = [0.1, 1.0, 10.0]
SIDE = {"gain": [2.0, 2.0, 0.2], "phase": [-0.1, -1.0, -2.0]}


def response(**more: Any) -> dict[str, Any]:
    """One operating point."""
    return {"frequency": F, "measured": SIDE, "input": "u", "output": "y", **more}


def test_a_bode_plot_has_the_band_of_table_1_3_around_what_was_measured() -> None:
    found = bode_figure(response(), [])
    assert trace(found, "measured")["y"] == pytest.approx([0, 0, -20])  # dB above the lowest frequency
    assert trace(found, "measured", "y2")["y"] == pytest.approx([math.degrees(v) for v in SIDE["phase"]])
    for panel, limit in (("y", 2.0), ("y2", 35.0)):
        y = trace(found, "measured", panel)["y"]
        band = trace(found, "± 2 dB, ± 35°", panel)
        assert band["x"] == [*F, *reversed(F)]
        assert band["y"] == pytest.approx([v + limit for v in y] + [v - limit for v in reversed(y)])


def test_a_model_a_turn_away_is_drawn_beside_what_was_measured() -> None:
    side = {"gain": [1.0, 0.5, 0.1], "phase": [v + 2 * math.pi for v in SIDE["phase"]]}
    found = bode_figure(response(), [("refit", "refitted", side)])
    assert trace(found, "refitted", "y2")["y"] == pytest.approx([math.degrees(v) for v in SIDE["phase"]])
    assert trace(found, "refitted")["y"] == pytest.approx([0, 20 * math.log10(0.5), -20])
    assert trace(found, "refitted")["line"]["dash"] != trace(found, "measured")["line"]["dash"]
