import numpy as np
import pytest

from pysim.present import Drawing
from pysim.present.cosim import CoSimulation, cosim_figure, data, figures, page, text
from pysim.types import BadInput, Outcome, Record

TIME = np.array([0.0, 1.0, 2.0])
RECORD = Record(TIME, np.array([[1.0], [5.0], [3.0]]), ("rig.p",), ("Pa",), statistics={"steps": 2000, "events": 0})
STOPPED = Record(TIME[:1], np.ones((1, 1)), ("rig.p",), ("Pa",), Outcome.MODEL_ERROR, "rig: it broke at 0.5 s")


def record(names: tuple[str, ...], units: tuple[str, ...]) -> Record:
    time = np.linspace(0, 1, 11)
    return Record(time, np.outer(time, np.arange(1, len(names) + 1)), names, units)


def test_a_panel_per_unit_in_the_units_of_the_workshop() -> None:
    figure = cosim_figure(record(("rig.p_s", "rig.omega", "rig.p_L"), ("Pa", "rad/s", "Pa")))
    pressures, speed = figure.axes
    assert [line.get_label() for line in pressures.lines] == ["rig.p_s", "rig.p_L"]
    assert pressures.get_ylabel() == "(bar)"
    assert pressures.lines[1].get_ydata()[-1] == pytest.approx(3e-5)
    assert speed.get_ylabel() == "rig.omega (rpm)"
    assert speed.lines[0].get_ydata()[-1] == pytest.approx(2 * 60 / (2 * np.pi))


def test_no_panel_has_more_lines_than_colours() -> None:
    names = tuple(f"m.{i}" for i in range(14))
    assert [len(axis.lines) for axis in cosim_figure(record(names, ("1",) * 14)).axes] == [6, 6, 2]


def test_nothing_to_draw() -> None:
    with pytest.raises(BadInput, match="has no rows"):
        cosim_figure(Record(np.zeros(0), np.zeros((0, 1)), ("y",), ("1",)))


def test_text_has_pace_and_ranges() -> None:
    lines = text(CoSimulation("Rig", RECORD, 0.5)).splitlines()
    assert lines[0] == "Rig: 2 s simulated in 0.5 s, 4 times as fast as real time (2000 steps)."
    assert lines[1].split() == ["rig.p", "1", "...", "5", "at", "the", "end", "3", "Pa"]
    stopped = text(CoSimulation("Rig", STOPPED, 0.5))
    assert stopped.startswith("Rig stopped: rig: it broke at 0.5 s; recorded up to 0 s.")


def test_a_rate_keeps_its_unit_and_a_plain_number_has_none() -> None:
    rate, number = text(CoSimulation("Rig", record(("m.f", "m.n"), ("1/s", "1")), 0.5)).splitlines()[1:]
    assert (rate.split()[-1], number.split()[-1]) == ("1/s", "2")


def test_data_are_numbers() -> None:
    found = data(CoSimulation("Rig", RECORD, 0.5))
    assert found["signals"] == [{"name": "rig.p", "unit": "Pa", "low": 1.0, "high": 5.0, "end": 3.0}]
    assert (found["outcome"], found["rows"], found["end_s"], found["statistics"]["steps"]) == ("done", 3, 2.0, 2000)
    empty = Record(np.zeros(0), np.zeros((0, 1)), ("y",), ("1",), Outcome.MODEL_ERROR, "no")
    result = CoSimulation("Rig", empty, 0.1)
    assert data(result)["end_s"] is None
    assert list(figures(result)) == []


def test_page_escapes_and_shows_all() -> None:
    run = CoSimulation("A<B", STOPPED, 0.5, [("rig", "an FMU", 2, 3)], [("rig.p", "card.p", 1e-5, 0.0)])
    html = page(run, [Drawing("cosim", "All", b"<svg/>")], "pysim cosim a.toml")
    for words in ("A&lt;B", "it broke at 0.5 s", "an FMU", "card.p", "1e-05", "pysim cosim a.toml"):
        assert words in html
    assert "offset" not in html


def test_page_shows_offsets_where_there_are_some() -> None:
    html = page(CoSimulation("A", RECORD, 0.5, [], [("a.T", "b.T", 1.0, 273.15), ("a.p", "b.p", 1e5, 0.0)]), [], "")
    assert "input = factor * output + offset" in html
    assert "273.15" in html
