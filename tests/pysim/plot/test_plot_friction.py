"""The friction figure draws the law, the samples and the blind zone it was given."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.friction import FrictionSamples, fit_friction, friction_torque
from pysim.plot import friction_figure
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


def test_the_band_is_as_wide_as_the_intervals_of_the_table() -> None:
    """At the ends of the speeds the law is its Coulomb friction alone, and the band that of tau_c."""
    rng = np.random.default_rng(4)
    speed, sigma = np.linspace(-60.0, 60.0, 40), np.full(40, 1.5)
    noise = np.convolve(sigma[0] * rng.standard_normal(45), np.ones(6) / np.sqrt(6), "valid")  # it has a memory
    torque = friction_torque(np.array([3.0, 4.0, 15.0, 30.0]), speed) + noise
    samples = FrictionSamples(np.arange(40.0), speed, 0 * speed, torque, 0 * speed, sigma, ())
    fit = fit_friction([samples])
    assert fit.effective < 20
    band = friction_figure(fit).axes[0].collections[-1].get_paths()[0].vertices
    at_end = band[np.isclose(band[:, 0], band[:, 0].max()), 1]
    low, high = fit.intervals["tau_c"]
    assert np.ptp(at_end) == pytest.approx(high - low, rel=0.01)


def test_band_opens_where_the_steepness_is_open() -> None:
    """Between r = 1.25 and a step, at 0.1 rad/s: from tanh(0.125) to 1 of nearly the whole stiction."""
    figure = friction_figure(replace(FIT_DRAWN, covariance=np.zeros((4, 4))))
    band = figure.axes[1].collections[-1].get_paths()[0].vertices
    at = band[np.abs(band[:, 0] - 0.1) < 2e-3, 1]
    assert at.min() == pytest.approx(math.tanh(0.125) * 49.6, rel=0.03)
    assert at.max() == pytest.approx(49.6, rel=0.02)
