"""The picture of a chirp's response shows its numbers."""

import numpy as np

from pysim.identify import measured_responses
from pysim.identify.chirp import analyse_chirp
from pysim.plot import chirp_figure
from tests.pysim.identify.chirp.chirps import log
from tests.pysim.identify.frf.systems import dataset
from tests.pysim.identify.frf.systems import log as sine
from tests.pysim.plot.looking import numbers


def test_three_curves_a_band_and_dots() -> None:
    found = analyse_chirp(log(2.0, noise=0.1), "u", "y")
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


def test_a_phase_of_a_few_degrees_has_numbers() -> None:
    """Of a system far above the sweep."""
    found = analyse_chirp(log(0.5, natural_hz=300.0, damping=0.9, stop_hz=3.0, noise=0.02), "u", "y")
    bottom = chirp_figure(found).axes[1]
    assert len(numbers(bottom.yaxis)) >= 3
    assert len(numbers(bottom.xaxis)) >= 3
