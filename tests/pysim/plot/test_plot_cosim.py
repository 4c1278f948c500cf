import numpy as np
import pytest

from pysim.plot import cosim_figure
from pysim.types import BadInput, Record


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
