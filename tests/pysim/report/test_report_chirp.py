"""Chirp analyses as text, data and page."""

import json
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.chirp import ChirpAnalysis, analyse_chirp
from pysim.report.chirp import chirp_data, chirp_page, chirp_text
from tests.pysim.identify.chirp.chirps import log


@pytest.fixture(scope="module")
def found() -> ChirpAnalysis:
    return analyse_chirp(log(2.0, noise=0.1), "u", "y")


def test_text_reads_the_curves_at_round_frequencies(found: ChirpAnalysis) -> None:
    lines = chirp_text([found]).splitlines()
    assert lines[0].startswith("chirp.txt: y to u around 50 %, amplitude 10 %, 0.1 to 25 Hz at 2 Hz/s")
    row = next(line for line in lines if line.startswith("      10 "))
    numbers = [float(word.strip("±")) for word in row.replace("±", " ").split()]
    magnitude, phase = found.mean.at(np.array(10.0))
    assert numbers[1] == pytest.approx(float(magnitude), abs=0.006)
    assert numbers[3] == pytest.approx(float(phase), abs=0.06)
    assert numbers[5] == pytest.approx(float(found.top.at(np.array(10.0))[0]), abs=0.006)


def test_pressures_are_told_in_bar(found: ChirpAnalysis) -> None:
    command = replace(found.command, offset=1e7, amplitude=2e6)
    (title, *_) = chirp_text([replace(found, command=command, input_unit="Pa")]).splitlines()
    assert "around 100 bar, amplitude 20 bar, 0.1 to 25 Hz" in title


def test_data_is_complete_and_fit_for_json(found: ChirpAnalysis) -> None:
    (one,) = json.loads(json.dumps(chirp_data([found], dataset="d"), allow_nan=False))["chirps"]
    np.testing.assert_allclose(one["top"]["magnitude_db"], found.top.magnitude_db)
    np.testing.assert_allclose(one["mean"]["phase_deg"], found.mean.phase_deg)
    assert one["level"] == pytest.approx(50.0, abs=1e-4)


def test_page_holds_the_table_and_the_picture(found: ChirpAnalysis) -> None:
    page = chirp_page([found], dataset="d", pictures={"A picture": b"<svg/>"}, redo="pysim chirp d")
    assert "A picture" in page
    assert page.count("<tr>") > 5
