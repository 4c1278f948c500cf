"""Text, data, page and picture hold the numbers of the fit."""

import json
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from pysim.identify.blackbox import FittedResponse, Structure, fit_dataset
from pysim.present import Drawing
from pysim.present.blackbox import TransferFunctions, data, figures, page, text
from pysim.present.blackbox.figure import blackbox_figure
from pysim.types import Dataset
from tests.pysim.identify.blackbox.logs import F, dataset, log, table


def shown(measured: Dataset, structure: Structure, *, suggest: bool = False, name: str = "bench") -> TransferFunctions:
    return TransferFunctions(name, tuple(fit_dataset(measured, structure, suggest=suggest)))


@pytest.fixture(scope="module")
def fitted() -> TransferFunctions:
    return shown(dataset(*(log(f, i) for i, f in enumerate(F))), Structure(2))


def test_text(fitted: TransferFunctions) -> None:
    told = text(fitted)
    assert told.startswith("O+20 A5: 2 poles, no zeros\n  fit 99.9")
    assert "degrees of freedom" in told
    pole = next(line for line in told.splitlines() if line.startswith("  pole"))
    assert float(pole.split()[1]) == pytest.approx(np.hypot(9, 30) / (2 * np.pi), rel=0.01)
    assert pole.endswith("(pair)")
    assert "note:" not in told


def test_data_is_plain_and_complete(fitted: TransferFunctions) -> None:
    (one,) = json.loads(json.dumps(data(fitted), allow_nan=False))["responses"]
    assert one["denominator"] == pytest.approx([1.0, 18.0, 981.0], rel=0.01)
    value, (low, high) = (one["estimates"]["a0"][key] for key in ("value", "interval"))
    assert low < value < high
    assert value == one["denominator"][2]
    assert np.sqrt(one["covariance"]["matrix"][2][2]) == pytest.approx(one["estimates"]["a0"]["std"])
    assert len(one["residuals_standard_deviations"]) == len(F)
    assert one["structures"] is None


def test_what_is_not_determined_is_null() -> None:
    (one,) = data(shown(dataset(table(0, 1)), Structure(3, 1)))["responses"]
    assert one["estimates"]["a0"]["interval"] == [None, None]
    assert json.dumps(one, allow_nan=False)


def test_page_and_suggested_structures() -> None:
    one = shown(dataset(table(0, 1)), Structure(3), suggest=True, name="bench <1>")
    html = page(one, [Drawing("a", "A", b"<svg/>")], "pysim blackbox x --poles 3")
    assert "bench &lt;1&gt;" in html
    assert "Structures that were compared" in html
    assert '<td class="differs">2 poles, no zeros</td>' in html
    assert html.count("<figure>") == 1
    assert "pysim blackbox x --poles 3" in html
    assert "2 poles, no zeros" in text(one)
    assert "<- suggested" in text(one)


def test_every_result_tells_its_signals() -> None:
    both = shown(dataset(table(25, 5), table(25, 5, output="p")), Structure(2))
    found = data(both)["responses"]
    assert [(one["output"], one["input"], one["origin"]) for one in found] == [(y, "u", "a table") for y in "yp"]
    html = page(both, [Drawing("a", one.caption, b"<svg/>") for one in figures(both)], "-")
    for name in ("O+25 A5, y to u", "O+25 A5, p to u"):
        assert f"{name}: 2 poles" in text(both)
        assert f"{name}: 2 poles" in html  # the heading
        assert f"{name}: gain" in html  # the caption


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


def test_a_single_frequency_is_drawn() -> None:
    (one,) = shown(dataset(log(F[0], 0)), Structure(1)).fitted
    top, bottom, *_ = blackbox_figure(one).axes
    gain, phase = one.measured.gain[0], np.degrees(one.measured.phase[0])
    for axes, value in ((top, 20 * np.log10(gain)), (bottom, phase)):
        x, y = axes.get_lines()[0].get_data()
        assert (x, y) == (pytest.approx(F[:1]), pytest.approx([value], abs=1e-6))
