"""The picture shows the numbers of the fit."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from pysim.identify.blackbox import FittedResponse, Structure, fit_dataset
from pysim.plot import blackbox_figure
from tests.pysim.identify.blackbox.logs import F, dataset, log, table


def lines(figure: Figure, axes: int) -> list[np.ndarray]:
    return [np.asarray(line.get_ydata(), dtype=float) for line in figure.axes[axes].get_lines()]


@pytest.fixture(scope="module")
def one() -> FittedResponse:
    (found,) = fit_dataset(dataset(*(log(f, i) for i, f in enumerate(F))), Structure(2))
    return found


def test_curves_points_residuals_and_roots(one: FittedResponse) -> None:
    figure = blackbox_figure(one)
    gain, phase, residual, plane = figure.axes
    curve, points = lines(figure, 0)[:2]
    np.testing.assert_allclose(points, 20 * np.log10(one.measured.gain))
    np.testing.assert_allclose(curve[[0, -1]], 20 * np.log10(np.abs(one.fit.model))[[0, -1]])
    np.testing.assert_allclose(lines(figure, 1)[0][-1], np.degrees(np.angle(one.fit.model[-1])))
    band = gain.collections[0].get_paths()[0].get_extents()
    assert band.y1 > curve.max()
    shown = [y for y in lines(figure, 2) if y.size == len(F)]
    np.testing.assert_allclose(np.column_stack(shown), one.fit.standardised)
    roots = next(line for line in plane.get_lines() if line.get_label() == "pole")
    np.testing.assert_allclose(np.sort(np.asarray(roots.get_ydata())), [-30, 30], rtol=0.02)
    assert len(plane.patches) == 2
    assert plane.get_xlim()[1] == pytest.approx(0.12 * 30, rel=0.02)  # the imaginary axis is in sight
    assert [axes.get_ylabel() for axes in (gain, phase)] == ["Gain (dB)", "Phase (deg)"]
    assert residual.get_xlabel() == "Frequency (Hz)"


def test_a_region_across_the_axis_is_shown_whole(one: FittedResponse) -> None:
    doubtful = tuple(replace(pole, covariance=np.diag([25.0, 9.0])) for pole in one.fit.poles)  # about -5 ± 30j rad/s
    *_, plane = blackbox_figure(replace(one, fit=replace(one.fit, poles=doubtful))).axes
    assert plane.get_xlim()[1] > max(pole.value.real for pole in doubtful) + 2.447 * 5
    assert plane.get_ylim()[1] > max(pole.value.imag for pole in doubtful) + 2.447 * 3


def test_a_root_far_beyond_is_told_in_words_and_whole_turns_are_taken_off() -> None:
    (one,) = fit_dataset(dataset(table(0, 1)), Structure(3, 1, stable=True))  # one pair too many
    figure = blackbox_figure(one)
    reach = 20 * 2 * np.pi * F[-1]
    far = [r for r in (*one.fit.poles, *one.fit.zeros) if abs(r.value) > reach]
    words = " ".join(text.get_text() for text in figure.axes[3].texts)
    assert words.count(" at ") == len(far)
    assert abs(figure.axes[3].get_xlim()[0]) < 1.5 * reach
