"""A record over time: a panel per signal, and one below it for what the models leave over."""

import pytest

from pysim.present.overlay import overlay_chart, signal_trace


def test_without_models_every_signal_has_one_panel_in_the_unit_people_read() -> None:
    layout = overlay_chart(["x", "<b>"], ["mm", "deg"], [], [])["layout"]
    assert [layout[name]["title"]["text"] for name in ("yaxis", "yaxis2")] == ["x<br>(mm)", "&lt;b&gt;<br>(°)"]
    assert "yaxis3" not in layout
    assert layout["shapes"] == []


def test_what_is_left_over_stands_below_with_the_band_that_holds_95_percent_of_noise() -> None:
    layout = overlay_chart(["x"], [""], [("refit", "refitted")], [])["layout"]
    assert [layout[name]["title"]["text"] for name in ("yaxis", "yaxis2")] == ["x<br>(–)", "residual<br>(noise s.d.)"]
    assert layout["yaxis2"]["domain"][1] < layout["yaxis"]["domain"][0]
    assert layout["xaxis"]["anchor"] == "y2"
    (band,) = layout["shapes"]
    assert band["yref"] == "y2"
    assert (band["y0"], band["y1"]) == pytest.approx((-1.96, 1.96), abs=1e-3)


def test_models_are_told_apart_by_dash_and_measured_lines_are_thinner() -> None:
    traces = [signal_trace(key, key, 1, [0.0], [1.0], legend=True) for key in ("measured", "prior", "refit")]
    assert len({trace["line"]["dash"] for trace in traces}) == 3
    assert traces[0]["line"]["width"] < traces[1]["line"]["width"]
