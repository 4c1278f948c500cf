"""Measured responses as text, data, figure and page: the numbers are those of the analysis."""

import json
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify import MeasuredResponse, magnitude_db, measured_responses, standard_deviations
from pysim.present import Drawing
from pysim.present.frf import Responses, data, frf_figure, page, text
from pysim.types import BadInput
from tests.pysim.identify.frf.systems import dataset, log, white
from tests.pysim.present.looking import numbers


@pytest.fixture(scope="module")
def responses() -> tuple[MeasuredResponse, ...]:
    records = [log(f, noise=white(12000, 0.05, 1), add=0.02 * (f == 5.0), periods=max(4 * f, 3)) for f in (0.1, 5.0)]
    return measured_responses(dataset(*records))


def test_text_has_a_row_per_frequency(responses: tuple[MeasuredResponse, ...]) -> None:
    shown = text(Responses("bench", responses, 0.1))
    lines = shown.splitlines()
    assert lines[0] == "y to cmd around 50 %, amplitude 10 % (measured, bench)"
    magnitude = magnitude_db(responses[0].response)[1]
    deviation, _ = standard_deviations(responses[0].response)
    row = lines[3].split()
    assert [float(row[0]), float(row[1])] == [5.0, pytest.approx(magnitude, abs=6e-4)]
    assert float(row[2].strip("±")) == pytest.approx(1.96 * deviation[1], abs=6e-4)
    assert "*" in row


def test_pressures_are_told_in_bar(responses: tuple[MeasuredResponse, ...]) -> None:
    one = responses[0]
    test = replace(one.response.test, offset=1e7, amplitude=1e6)
    pressures = replace(one, response=replace(one.response, test=test), input_unit="Pa", output_unit="rad")
    shown = Responses("d", (pressures,), None)
    title, head, row, *_ = text(shown).splitlines()
    assert title == "y to cmd around 100 bar, amplitude 10 bar (measured, bench)"
    assert "mean deg" in head
    assert float(row.split()[-3]) == pytest.approx(np.degrees(one.points[0].mean), rel=1e-3)
    assert title in page(shown, [], "x")
    assert data(shown)["responses"][0]["offset"] == 1e7


def test_data_is_complete_and_fit_for_json(responses: tuple[MeasuredResponse, ...]) -> None:
    (one,) = json.loads(json.dumps(data(Responses("bench", responses, None)), allow_nan=False))["responses"]
    np.testing.assert_allclose(one["magnitude_db"], magnitude_db(responses[0].response, None))
    np.testing.assert_allclose(one["phase_deg"], np.degrees(responses[0].response.phase))
    assert one["points"][1]["distorted"] is True
    assert one["points"][1]["harmonics"][1] == pytest.approx(0.02, rel=0.1)
    assert one["points"][0]["command_amplitude"] == pytest.approx(10.0, abs=1e-4)


def test_page_holds_tables_pictures_and_remarks(responses: tuple[MeasuredResponse, ...]) -> None:
    drawings = [Drawing("frf", "A picture", b"<svg/>")]
    html = page(Responses("bench <1>", responses, None), drawings, "pysim frf bench")
    assert "bench &lt;1&gt;" in html
    assert "A picture" in html
    assert html.count("<tr>") == 1 + 2
    assert "1 of 2" in html


def test_curves_and_bars_are_the_responses() -> None:
    records = [log(f, noise=white(12000, 0.3, 1), add=0.2 * (f == 5.0), periods=max(4 * f, 3)) for f in (0.1, 5.0, 9.0)]
    (one,) = measured_responses(dataset(*records))
    figure = frf_figure([one], 0.1)
    magnitude, phase, harmonics = figure.axes
    np.testing.assert_allclose(magnitude.get_lines()[0].get_ydata(), magnitude_db(one.response))
    np.testing.assert_allclose(phase.get_lines()[0].get_ydata(), np.degrees(one.response.phase))
    bars = np.array([segment[:, 1] for segment in magnitude.collections[0].get_segments()])
    deviation, _ = standard_deviations(one.response)
    np.testing.assert_allclose(np.diff(bars, axis=1)[:, 0], 2 * 1.959964 * deviation, atol=1e-12)
    sure, unsure = harmonics.get_lines()[1:3]
    assert sure.get_xdata() == [5.0]
    assert list(unsure.get_xdata()) == [0.1, 9.0]
    assert figure.legends[0].get_texts()[0].get_text() == "+50 ± 10 %"
    assert frf_figure([one], None).axes[0].get_ylabel() == "Magnitude (dB)"


def test_narrow_responses_have_numbers_on_every_axis() -> None:
    (one,) = measured_responses(dataset(*(log(f, noise=white(12000, 0.3, 1)) for f in (12.0, 18.0, 26.0))))
    *others, harmonics = frf_figure([one], None).axes
    assert numbers(harmonics.xaxis) == ["15", "20", "25"]
    assert min(len(numbers(axes.yaxis)) for axes in (*others, harmonics)) >= 3


def test_the_legend_gives_pressures_in_bar() -> None:
    (one,) = measured_responses(dataset(log(5.0), log(9.0)))
    points = [(1e7, 1e6), (1e7, 2.5e6), (-5e6, 1e6)]
    tests = [replace(one.response.test, offset=offset, amplitude=amplitude) for offset, amplitude in points]
    figure = frf_figure(
        [replace(one, response=replace(one.response, test=test), input_unit="Pa") for test in tests], None
    )
    labels = [t.get_text() for t in figure.legends[0].get_texts()]
    assert labels == ["+100 ± 10 bar", "+100 ± 25 bar", "-50 ± 10 bar"]


def test_responses_that_are_held_out_are_told_from_the_others() -> None:
    sines = log(5.0), log(9.0), replace(log(7.0), use="validate")
    figure = frf_figure(measured_responses(dataset(*sines)), None)
    assert [t.get_text() for t in figure.legends[0].get_texts()] == ["+50 ± 10 %", "+50 ± 10 %, used to choose"]


def test_responses_of_several_outputs_are_told_apart() -> None:
    (one,) = measured_responses(dataset(log(5.0), log(9.0)))
    other = replace(one, response=replace(one.response, test=replace(one.response.test, output="p")))
    figure = frf_figure([one, other], None)
    assert [t.get_text() for t in figure.legends[0].get_texts()] == ["y to cmd, +50 ± 10 %", "p to cmd, +50 ± 10 %"]


def test_refuses_nothing() -> None:
    with pytest.raises(BadInput, match="no response"):
        frf_figure([])
