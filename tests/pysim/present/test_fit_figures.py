from dataclasses import replace

import numpy as np
import pytest

from pysim.present.fit.figures import (
    fit_correlation_figure,
    fit_harmonics_figure,
    fit_parameters_figure,
    fit_record_figure,
)
from pysim.types import BadInput
from tests.pysim.fits import small_fit
from tests.pysim.present.looking import is_whole


def test_a_record_is_drawn_with_its_residual_in_noise() -> None:
    figure = fit_record_figure(small_fit().records[0])
    top, _, low, _ = figure.axes
    assert [line.get_ydata()[0] for line in top.lines] == pytest.approx([0.0, 0.2])
    assert low.lines[0].get_ydata() == pytest.approx(np.full(50, -2.0))
    assert low.get_ylabel() == "Residual over noise (-)"


def test_harmonics_show_measured_points_and_simulated_lines() -> None:
    figure = fit_harmonics_figure(small_fit().records[1:], "O+25", "y")
    top = figure.axes[0]
    assert top.lines[0].get_ydata() == pytest.approx([9.0, 9.0])
    assert top.lines[1].get_ydata() == pytest.approx([9.01, 9.01])
    with pytest.raises(BadInput, match="stepped sines"):
        fit_harmonics_figure(small_fit().records[:1], "O+25", "y")
    with pytest.raises(BadInput, match="hold u"):
        fit_harmonics_figure(small_fit().records[1:], "O+25", "u")


def test_long_logs_are_drawn_as_pixels() -> None:
    record = small_fit().records[0]
    time = np.arange(20_000) / 1000
    measured, simulated = (
        replace(log, time=time, values=np.resize(log.values, (time.size, 2)))
        for log in (record.measured, record.simulated)
    )
    for one, pixels in ((replace(record, measured=measured, simulated=simulated), True), (record, False)):
        assert [line.get_rasterized() for line in fit_record_figure(one).axes[0].lines] == [
            True,
            pixels,
        ]  # measured, fitted


def test_pictures_of_records_are_in_units_that_people_read() -> None:
    turned = [
        replace(
            record,
            measured=replace(record.measured, units=("rad/s",) * len(record.measured.units)),
            simulated=replace(record.simulated, units=("rad/s",) * len(record.simulated.units)),
        )
        for record in small_fit().records
    ]
    top = fit_record_figure(turned[0]).axes[0]
    assert top.get_ylabel().endswith("(rpm)")
    assert [line.get_ydata()[0] for line in top.lines] == pytest.approx([0.0, 0.2 * 30 / np.pi])
    top, low = fit_harmonics_figure(turned[1:], "O+25", "y").axes
    assert top.get_ylabel().endswith("(rpm)")
    assert top.lines[1].get_ydata() == pytest.approx([9.01 * 30 / np.pi] * 2)
    was = fit_harmonics_figure(small_fit().records[1:], "O+25", "y").axes[1]
    assert low.lines[0].get_ydata() == pytest.approx(was.lines[0].get_ydata())  # in standard deviations as before


def test_intervals_stand_between_the_bounds() -> None:
    axes = fit_parameters_figure(small_fit()).axes[0]
    assert axes.lines[2].get_xdata() == pytest.approx([1.7 / 9.9, 2.1 / 9.9])
    assert [text.get_text() for text in axes.get_yticklabels()] == ["K", "g", "T (s)"]


def test_correlations_that_are_none_are_left_out() -> None:
    figure = fit_correlation_figure(small_fit())
    assert [text.get_text() for text in figure.axes[0].texts] == ["1.00"]
    assert figure.legends


def test_long_names_are_whole() -> None:
    fit = small_fit()
    estimates = tuple(replace(fit.estimates[0], name=f"damping.orifice.d_hydraulic{k}") for k in range(8))
    figure = fit_correlation_figure(replace(fit, estimates=estimates, covariance=np.eye(8) - 1e-4))
    assert not figure.legends
    assert "-0.00" not in [text.get_text() for text in figure.axes[0].texts]
    assert is_whole(figure)
