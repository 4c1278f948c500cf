import numpy as np

from pysim.report.cosim import cosim_data, cosim_page, cosim_text
from pysim.types import Outcome, Record

TIME = np.array([0.0, 1.0, 2.0])
RECORD = Record(TIME, np.array([[1.0], [5.0], [3.0]]), ("rig.p",), ("Pa",), statistics={"steps": 2000, "events": 0})
STOPPED = Record(TIME[:1], np.ones((1, 1)), ("rig.p",), ("Pa",), Outcome.MODEL_ERROR, "rig: it broke at 0.5 s")


def test_text_has_pace_and_ranges() -> None:
    lines = cosim_text("Rig", RECORD, 0.5).splitlines()
    assert lines[0] == "Rig: 2 s simulated in 0.5 s, 4 times as fast as real time (2000 steps)."
    assert lines[1].split() == ["rig.p", "1", "...", "5", "at", "the", "end", "3", "Pa"]
    assert cosim_text("Rig", STOPPED, 0.5).startswith("Rig stopped: rig: it broke at 0.5 s; recorded up to 0 s.")


def test_data_are_numbers() -> None:
    data = cosim_data("Rig", RECORD, 0.5)
    assert data["signals"] == [{"name": "rig.p", "unit": "Pa", "low": 1.0, "high": 5.0, "end": 3.0}]
    assert (data["outcome"], data["rows"], data["end_s"], data["statistics"]["steps"]) == ("done", 3, 2.0, 2000)
    empty = Record(np.zeros(0), np.zeros((0, 1)), ("y",), ("1",), Outcome.MODEL_ERROR, "no")
    assert cosim_data("Rig", empty, 0.1)["end_s"] is None


def test_page_escapes_and_shows_all() -> None:
    html = cosim_page(
        "A<B",
        STOPPED,
        0.5,
        parts=[("rig", "an FMU", 2, 3)],
        wires=[("rig.p", "card.p", 1e-5, 0.0)],
        pictures={"All": b"<svg/>"},
        redo="pysim cosim a.toml",
    )
    for text in ("A&lt;B", "it broke at 0.5 s", "an FMU", "card.p", "1e-05", "pysim cosim a.toml"):
        assert text in html
    assert "offset" not in html


def test_page_shows_offsets_where_there_are_some() -> None:
    html = cosim_page(
        "A", RECORD, 0.5, parts=[], wires=[("a.T", "b.T", 1.0, 273.15), ("a.p", "b.p", 1e5, 0.0)], pictures={}, redo=""
    )
    assert "input = factor * output + offset" in html
    assert "273.15" in html
