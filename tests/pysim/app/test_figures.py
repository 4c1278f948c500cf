"""Figures of the page: bands and limits are where the criteria have them, numbers are the ledger's."""

import math
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra app is not installed")

from pysim.app.figures import (
    bode_figure,
    criteria_figure,
    map_figure,
    missing_figure,
    parameters_figure,
    plain,
    staircase_figure,
)

F = [0.1, 1.0, 10.0]
SIDE = {"gain": [2.0, 2.0, 0.2], "phase": [-0.1, -1.0, -2.0]}


def response(**more: Any) -> dict[str, Any]:
    """One operating point."""
    return {"frequency": F, "measured": SIDE, "input": "u", "output": "y", **more}


def trace(figure: dict[str, Any], name: str, panel: str = "y") -> dict[str, Any]:
    """The one of a name in a panel."""
    return next(t for t in figure["data"] if t["name"].startswith(name) and t.get("yaxis", "y") == panel)


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


STEPS = [
    {"step": "prior", "fit": 64.0, "validate": 46.0, "criteria": {"E_M max": 4.0, "E_t mean": 3.0}},
    {"step": "refit", "fit": 20.0, "validate": None, "criteria": {"E_M max": 1.0}},
    {"step": "a<b>", "fit": 1.0, "validate": 0.9, "criteria": {"E_M max": 0.0, "E_t mean": 0.5}},
]


def test_the_staircase_has_every_step_and_an_empty_one_for_what_is_being_found() -> None:
    found = staircase_figure(STEPS, doing="refitting")
    assert [v for v in trace(found, "fitted")["y"] if v is not None] == [64, 64, 20, 20, 1, 1]
    words = [note["text"] for note in found["layout"]["annotations"]]
    assert {"<b>64</b>", "<b>46</b>", "<b>20</b>", "<b>1.00</b>", "<b>0.90</b>", "noise alone"} == set(words)
    assert found["layout"]["xaxis"]["ticktext"] == ["as it is", "refitted", "+ a&lt;b&gt;", "<i>refitting …</i>"]
    low, high = found["layout"]["yaxis"]["range"]
    assert 10**low < 0.9 < 64 < 10**high


def test_a_staircase_begins_with_the_place_of_its_first_step() -> None:
    found = staircase_figure([], doing="starting")
    assert found["data"] == []
    assert found["layout"]["xaxis"]["ticktext"] == ["<i>starting …</i>"]
    box = found["layout"]["shapes"][1]
    assert box["x0"] < 0 < box["x1"]


def test_criteria_stand_over_their_limits_which_are_a_line() -> None:
    found = criteria_figure(STEPS)
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


def test_a_missing_term_is_shown_in_the_units_people_use() -> None:
    shape = {"argument": [-0.1, 0.1], "value": [-2.0, 2.0], "low": [-3.0, 1.0], "high": [-1.0, 3.0]}
    shape |= {"argument_unit": "m/s", "unit": "Pa"}
    found = missing_figure({"slot": "force", "depends_on": "force.v", "shape": shape})
    band, line = found["data"]
    assert line["x"] == pytest.approx([-100, 100])
    assert line["y"] == pytest.approx([-2e-5, 2e-5])
    assert band["y"] == pytest.approx([-1e-5, 3e-5, 1e-5, -3e-5])
    assert found["layout"]["xaxis"]["title"]["text"] == "force.v (mm/s)"
    shape |= {"argument_unit": "rad/s", "unit": "rad"}
    found = missing_figure({"slot": "force", "depends_on": "force.w", "shape": shape})
    assert found["data"][1]["x"] == pytest.approx([-3 / math.pi, 3 / math.pi])
    assert found["layout"]["xaxis"]["title"]["text"] == "force.w (rpm)"
    assert found["layout"]["yaxis"]["title"]["text"] == "missing at force (°)"


def test_parameters_stand_between_their_bounds() -> None:
    row = {"name": "k", "lower": 10.0, "upper": 30.0, "before": (15.0, 5.0, 20.0), "after": None}
    (only,) = parameters_figure([row])["data"]
    assert only["x"] == [25]
    assert (only["error_x"]["array"], only["error_x"]["arrayminus"]) == ([25], [25])  # an interval ends at the bound


def test_a_map_writes_its_numbers_into_the_cells_and_names_as_they_are() -> None:
    found = map_figure(["<b>"], ["1 Hz", "2 Hz"], [[1.234, None]], "title")
    assert plain("<b>") in str(found)
    assert "1.2" in str(found["data"])
