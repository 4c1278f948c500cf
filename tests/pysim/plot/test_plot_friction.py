"""The friction figure draws the law, the samples and the blind zone it was given."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.friction import friction_torque
from pysim.plot import friction_figure, render
from tests.pysim.report.test_report_friction import FIT

FIT_DRAWN = replace(FIT, parameters={**FIT.parameters, "tau_s": 50.0})


def test_curve_cloud_and_blind_zone() -> None:
    figure = friction_figure(FIT_DRAWN)
    everything, near = figure.axes[0], figure.axes[1]
    cloud, curve = everything.get_lines()[:2]
    np.testing.assert_allclose(cloud.get_xdata(), FIT.samples[0].speed)
    np.testing.assert_allclose(cloud.get_ydata(), FIT.samples[0].torque)
    speed = np.asarray(curve.get_xdata())
    np.testing.assert_allclose(curve.get_ydata(), friction_torque(FIT_DRAWN.vector, speed))
    assert everything.get_xlim() == pytest.approx((-1.04 * 6, 1.04 * 6))
    assert near.get_xlim()[1] < 1
    zone = everything.patches[0].get_extents().transformed(everything.transData.inverted())
    speeds = FIT.samples[0].speed
    assert (zone.x0, zone.x1) == pytest.approx((speeds[speeds < 0].max(), speeds[speeds > 0].min()))
    assert len(render(figure, "png")) > 10_000


def test_band_opens_where_the_steepness_is_open() -> None:
    """Between r = 1.25 and a step, at 0.1 rad/s: from tanh(0.125) to 1 of nearly the whole stiction."""
    figure = friction_figure(replace(FIT_DRAWN, covariance=np.zeros((4, 4))))
    band = figure.axes[1].collections[-1].get_paths()[0].vertices
    at = band[np.abs(band[:, 0] - 0.1) < 2e-3, 1]
    assert at.min() == pytest.approx(math.tanh(0.125) * 49.6, rel=0.03)
    assert at.max() == pytest.approx(49.6, rel=0.02)
