"""Measured responses as text, data and page: the numbers are those of the analysis."""

import json
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify import MeasuredResponse, magnitude_db, measured_responses, standard_deviations
from pysim.report.frf import frf_data, frf_page, frf_text
from tests.pysim.identify.frf.systems import dataset, log, white


@pytest.fixture(scope="module")
def responses() -> tuple[MeasuredResponse, ...]:
    records = [log(f, noise=white(12000, 0.05, 1), add=0.02 * (f == 5.0), periods=max(4 * f, 3)) for f in (0.1, 5.0)]
    return measured_responses(dataset(*records))


def test_text_has_a_row_per_frequency(responses: tuple[MeasuredResponse, ...]) -> None:
    text = frf_text(responses, 0.1)
    lines = text.splitlines()
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
    title, head, row, *_ = frf_text([pressures], None).splitlines()
    assert title == "y to cmd around 100 bar, amplitude 10 bar (measured, bench)"
    assert "mean deg" in head
    assert float(row.split()[-3]) == pytest.approx(np.degrees(one.points[0].mean), rel=1e-3)
    assert title in frf_page([pressures], None, dataset="d", pictures={}, redo="x")
    assert frf_data([pressures], None, dataset="d")["responses"][0]["offset"] == 1e7


def test_data_is_complete_and_fit_for_json(responses: tuple[MeasuredResponse, ...]) -> None:
    data = json.loads(json.dumps(frf_data(responses, None, dataset="bench"), allow_nan=False))
    one = data["responses"][0]
    np.testing.assert_allclose(one["magnitude_db"], magnitude_db(responses[0].response, None))
    np.testing.assert_allclose(one["phase_deg"], np.degrees(responses[0].response.phase))
    assert one["points"][1]["distorted"] is True
    assert one["points"][1]["harmonics"][1] == pytest.approx(0.02, rel=0.1)
    assert one["points"][0]["command_amplitude"] == pytest.approx(10.0, abs=1e-4)


def test_page_holds_tables_pictures_and_remarks(responses: tuple[MeasuredResponse, ...]) -> None:
    page = frf_page(responses, None, dataset="bench <1>", pictures={"A picture": b"<svg/>"}, redo="pysim frf bench")
    assert "bench &lt;1&gt;" in page
    assert "A picture" in page
    assert page.count("<tr>") == 1 + 2
    assert "1 of 2" in page
