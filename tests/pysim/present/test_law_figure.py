"""The picture of a learned law: units that people read, the band, where the data are, and what it says below."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.present.diagnosis.figures import law_figure
from pysim.types import BadInput, LearnedLaw
from pysim.types.factor import Factor, Form

V = np.linspace(-0.3, 0.3, 61)
FRICTION = LearnedLaw(
    "pistonForce", Factor(), "pistonForce.v", V, -80 * np.tanh(V / 1e-3), 2.5**2 * np.eye(61), 0.987, "m/s", "N"
)


def test_axes_are_in_units_that_people_read() -> None:
    axes = law_figure(FRICTION).axes[0]
    assert axes.get_xlabel() == "pistonForce.v (mm/s)"
    assert axes.get_ylabel() == "Missing force at pistonForce (N)"
    assert axes.get_xlim() == pytest.approx((-300, 300))
    assert axes.lines[0].get_ydata()[0] == pytest.approx(80.0)


def test_nothing_is_drawn_beyond_the_logs() -> None:
    wild = np.where(np.abs(V) < 0.25, FRICTION.coefficients, 1e4)
    axes = law_figure(replace(FRICTION, coefficients=wild, reach=(-0.1, 0.2))).axes[0]
    assert axes.get_xlim() == pytest.approx((-100, 200))
    assert axes.get_ylim()[1] < 100


def test_a_speed_of_a_shaft_is_read_in_rpm() -> None:
    axes = law_figure(replace(FRICTION, argument_unit="rad/s")).axes[0]
    assert axes.get_xlabel() == "pistonForce.v (rpm)"
    assert axes.get_xlim()[1] == pytest.approx(0.3 * 30 / np.pi)


def test_the_band_lies_1_96_standard_deviations_around_the_law() -> None:
    edges = law_figure(FRICTION).axes[0].collections[0].get_paths()[0].vertices
    assert (edges[:, 1].min(), edges[:, 1].max()) == pytest.approx((-84.9, 84.9), abs=0.01)


def test_below_it_stands_where_the_data_are() -> None:
    samples = np.concatenate([np.full(300, -0.15), np.full(100, 0.15), np.full(50, 7.0)])  # the last is beyond the law
    top, density = law_figure(FRICTION, samples).axes
    counts = {round(bar.get_x() + bar.get_width() / 2): bar.get_height() for bar in density.patches if bar.get_height()}
    assert sorted(counts.values()) == [100, 300]
    assert max(counts, key=lambda at: counts[at]) == pytest.approx(-150, abs=10)  # mm/s
    assert (top.get_xlabel(), density.get_xlabel()) == ("", "pistonForce.v (mm/s)")


def below(law: LearnedLaw) -> str:
    return str(law_figure(law)._supxlabel.get_text())


def test_the_formula_stands_below_and_what_refitting_absorbs_is_said() -> None:
    formula = "-80 N * sign(v)"
    law = replace(FRICTION, formula="-80", factor=Factor(Form.SIGN, "v"))
    assert below(law) == formula
    assert below(replace(law, absorbed=V[:, None])).startswith(f"{formula}\n")


def test_places_that_would_do_as_well_are_said() -> None:
    assert "supply, oil" in below(replace(FRICTION, alternatives=("supply", "oil")))


def test_a_single_point_is_refused() -> None:
    one = replace(FRICTION, knots=V[:1], coefficients=V[:1], covariance=np.eye(1))
    with pytest.raises(BadInput, match="needs two knots"):
        law_figure(one)
