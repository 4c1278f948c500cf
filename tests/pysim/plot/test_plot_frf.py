"""The Bode plot of measured responses shows their numbers."""

import numpy as np
import pytest

from pysim.identify import magnitude_db, measured_responses, standard_deviations
from pysim.plot import frf_figure
from pysim.types import BadInput
from tests.pysim.identify.frf.systems import dataset, log, white


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


def test_refuses_nothing() -> None:
    with pytest.raises(BadInput, match="no response"):
        frf_figure([])
