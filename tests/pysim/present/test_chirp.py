"""Chirp analyses as text, data, figure and page: the numbers are those of the analysis."""

import json
from dataclasses import fields, replace

import numpy as np
import pytest

from pysim.identify import measured_responses
from pysim.identify.chirp import Branch, ChirpAnalysis, analyse_chirp
from pysim.present import Drawing
from pysim.present.chirp import Chirps, chirp_figure, data, page, text
from pysim.types import FrequencyResponse, SineTest
from tests.pysim.identify.chirp.chirps import log, response
from tests.pysim.identify.frf.systems import dataset
from tests.pysim.identify.frf.systems import log as sine

DELAY = 0.02  # s; with the lag, more than half a turn between 0.1 and 12 Hz


@pytest.fixture(scope="module")
def found() -> ChirpAnalysis:
    return analyse_chirp(log(2.0, noise=0.02, delay=DELAY), "u", "y")


@pytest.fixture(scope="module")
def quick() -> ChirpAnalysis:
    return analyse_chirp(log(2.0, noise=0.1), "u", "y")


def test_text_reads_the_curves_at_round_frequencies(quick: ChirpAnalysis) -> None:
    lines = text(Chirps("d", (quick,), (None,))).splitlines()
    assert lines[0].startswith("chirp.txt: y to u around 50 %, amplitude 10 %, 0.1 to 25 Hz at 2 Hz/s")
    row = next(line for line in lines if line.startswith("      10 "))
    numbers = [float(word.strip("±")) for word in row.replace("±", " ").split()]
    magnitude, phase = quick.mean.at(np.array(10.0))
    assert numbers[1] == pytest.approx(float(magnitude), abs=0.006)
    assert numbers[3] == pytest.approx(float(phase), abs=0.06)
    assert numbers[5] == pytest.approx(float(quick.top.at(np.array(10.0))[0]), abs=0.006)


def test_pressures_are_told_in_bar(quick: ChirpAnalysis) -> None:
    command = replace(quick.command, offset=1e7, amplitude=2e6)
    (title, *_) = text(Chirps("d", (replace(quick, command=command, input_unit="Pa"),), (None,))).splitlines()
    assert "around 100 bar, amplitude 20 bar, 0.1 to 25 Hz" in title


def test_data_is_complete_and_fit_for_json(quick: ChirpAnalysis) -> None:
    (one,) = json.loads(json.dumps(data(Chirps("d", (quick,), (None,))), allow_nan=False))["chirps"]
    np.testing.assert_allclose(one["top"]["magnitude_db"], quick.top.magnitude_db)
    np.testing.assert_allclose(one["mean"]["phase_deg"], quick.mean.phase_deg)
    assert one["level"] == pytest.approx(50.0, abs=1e-4)


def test_page_holds_the_table_and_the_picture(quick: ChirpAnalysis) -> None:
    html = page(Chirps("d", (quick,), (None,)), [Drawing("chirp", "A picture", b"<svg/>")], "pysim chirp d")
    assert "A picture" in html
    assert html.count("<tr>") > 5


def test_three_curves_a_band_and_dots(found: ChirpAnalysis) -> None:
    (stepped,) = measured_responses(dataset(sine(5.0), sine(9.0)))
    figure = chirp_figure(found, stepped.response)
    magnitude, phase = figure.axes
    curves = [np.asarray(line.get_ydata()) for line in magnitude.get_lines()]
    for curve, branch in zip(curves, (found.top, found.bottom, found.mean), strict=False):
        np.testing.assert_allclose(curve, branch.magnitude_db)
    np.testing.assert_allclose(phase.get_lines()[2].get_ydata(), found.mean.phase_deg)
    band = magnitude.collections[0].get_paths()[0].vertices[:, 1]
    upper = found.mean.magnitude_db + 1.959964 * found.mean.magnitude_deviation_db
    assert np.max(band) == np.max(upper)
    np.testing.assert_allclose(curves[3], 20 * np.log10(stepped.response.gain))
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["top", "bottom", "mean", "stepped sine"]
    assert len(chirp_figure(found).axes[0].get_lines()) == 3


def within(branch: Branch, low: float, high: float) -> Branch:
    """What of it lies between two frequencies, Hz."""
    inside = (branch.frequency >= low) & (branch.frequency <= high)
    return replace(branch, **{field.name: getattr(branch, field.name)[inside] for field in fields(branch)})


@pytest.mark.parametrize(
    ("low", "high", "sines"),
    [
        (0.0, 99.0, (12.0, 14.0, 16.0)),  # the chirp begins far below the sines
        (12.0, 99.0, (3.0, 5.0, 10.0, 15.0, 20.0)),  # and far above
        (0.0, 13.0, (14.0, 16.0)),  # no frequency in common
    ],
)
def test_sines_are_on_the_turn_of_the_chirp(
    found: ChirpAnalysis, low: float, high: float, sines: tuple[float, ...]
) -> None:
    cut = {name: within(getattr(found, name), low, high) for name in ("top", "bottom", "mean")}
    f = np.array(sines)
    g = response(f, delay=DELAY)
    phase = np.unwrap(np.angle(g)) - 4 * np.pi  # the numbers of an instrument may begin anywhere
    stepped = FrequencyResponse(f, np.abs(g), phase, SineTest(50.0, 10.0, "u", "y"), "sines")
    dots = chirp_figure(replace(found, **cut), stepped).axes[1].get_lines()[3].get_ydata()
    swept = np.interp(f, found.mean.frequency, found.mean.phase_deg)
    np.testing.assert_allclose(dots, swept, atol=20)  # a turn is 360
