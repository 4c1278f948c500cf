"""The Bode plot of measured responses shows their numbers."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify import magnitude_db, measured_responses, standard_deviations
from pysim.plot import frf_figure
from pysim.types import BadInput
from tests.pysim.identify.frf.systems import dataset, log, white
from tests.pysim.plot.looking import numbers


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


def test_pressures_are_told_in_bar() -> None:
    (one,) = measured_responses(dataset(log(5.0), log(9.0)))
    points = [(1e7, 1e6), (1e7, 2.5e6), (-5e6, 1e6)]
    tests = [replace(one.response.test, offset=offset, amplitude=amplitude) for offset, amplitude in points]
    figure = frf_figure(
        [replace(one, response=replace(one.response, test=test), input_unit="Pa") for test in tests], None
    )
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["+100 ± 10 bar", "+100 ± 25 bar", "-50 ± 10 bar"]


def test_responses_that_are_held_out_are_told_from_the_others() -> None:
    sines = log(5.0), log(9.0), replace(log(7.0), use="validate")
    figure = frf_figure(measured_responses(dataset(*sines)), None)
    assert [t.get_text() for t in figure.legends[0].get_texts()] == ["+50 ± 10 %", "+50 ± 10 %, held out"]


def test_responses_of_several_outputs_are_told_apart() -> None:
    (one,) = measured_responses(dataset(log(5.0), log(9.0)))
    other = replace(one, response=replace(one.response, test=replace(one.response.test, output="p")))
    figure = frf_figure([one, other], None)
    assert [t.get_text() for t in figure.legends[0].get_texts()] == ["y to cmd, +50 ± 10 %", "p to cmd, +50 ± 10 %"]


def test_refuses_nothing() -> None:
    with pytest.raises(BadInput, match="no response"):
        frf_figure([])
