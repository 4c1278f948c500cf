"""The missing term's picture: units that people read, the band, and what it says below."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.present.diagnosis import missing_figure
from pysim.types import BadInput, Missing, Shape

V = np.linspace(-0.3, 0.3, 61)


def friction(absorbed: np.ndarray = np.zeros((0, 0)), formula: str = "") -> Missing:  # noqa: B008
    force = -80 * np.tanh(V / 1e-3)
    shape = Shape(V, force, force - 5, force + 5, "m/s", "N", absorbed)
    return Missing("pistonForce", 0.987, "pistonForce.v", shape, formula)


def test_axes_are_in_units_that_people_read() -> None:
    axes = missing_figure(friction()).axes[0]
    assert axes.get_xlabel() == "pistonForce.v (mm/s)"
    assert axes.get_ylabel() == "Missing force at pistonForce (N)"
    assert axes.get_xlim() == pytest.approx((-300, 300))
    assert axes.lines[0].get_ydata()[0] == pytest.approx(80.0)


def test_a_speed_of_a_shaft_is_read_in_rpm() -> None:
    turning = replace(friction().shape, argument_unit="rad/s")
    axes = missing_figure(replace(friction(), shape=turning)).axes[0]
    assert axes.get_xlabel() == "pistonForce.v (rpm)"
    assert axes.get_xlim()[1] == pytest.approx(0.3 * 30 / np.pi)


def test_the_band_lies_around_the_term() -> None:
    edges = missing_figure(friction()).axes[0].collections[0].get_paths()[0].vertices
    assert (edges[:, 1].min(), edges[:, 1].max()) == pytest.approx((-85.0, 85.0))


def below(missing: Missing) -> str:
    return str(missing_figure(missing)._supxlabel.get_text())


def test_the_formula_stands_below_and_what_refitting_absorbs_is_said() -> None:
    formula = "-80 N sign(pistonForce.v)"
    assert below(friction(formula=formula)) == formula
    assert below(friction(V[:, None], formula)).startswith(f"{formula}\n")


def test_places_that_would_do_as_well_are_said() -> None:
    assert "supply, oil" in below(replace(friction(), alike=("supply", "oil")))


def test_a_single_point_is_refused() -> None:
    one = np.zeros(1)
    with pytest.raises(BadInput, match="needs two points"):
        missing_figure(Missing("a", 1.0, "b", Shape(one, one, one, one, "1", "1")))
