"""What is shown of a friction fit: open ends, bounds, what was left out; the law, the samples and the blind zone."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.friction import FrictionFit, FrictionSamples, ShaftColumns, fit_friction, friction_torque
from pysim.present import Drawing
from pysim.present.friction import Friction, data, friction_figure, page, text

ONE = np.ones(12)
SAMPLES = FrictionSamples(
    np.arange(12.0), np.linspace(-6, 5.5, 12), 0 * ONE, ONE, ONE, ONE, (("ends of the filter", 7), ("unused", 0))
)
FIT = FrictionFit(
    {"r": 3.0, "omega_0": 8.0, "tau_c": 15.0, "tau_s": 500.0},
    {"r": (1.25, math.inf), "omega_0": (7.0, 9.0), "tau_c": (14.0, 16.0), "tau_s": (400.0, 500.0)},
    ("r",),
    np.diag([0.0, 0.25, 0.25, 100.0]),
    0.5 * ONE,
    6.0,
    ("tau_s",),
    True,
    (SAMPLES,),
)


COLUMNS = ShaftColumns("w", "p", None, 1.0, 1.0)
FIT_DRAWN = replace(FIT, parameters={**FIT.parameters, "tau_s": 50.0})


def test_text_does_not_claim_what_is_bounded() -> None:
    shown = text(Friction(FIT, None, "d", COLUMNS, 0.1))
    row = next(line for line in shown.splitlines() if line.split()[0] == "r")
    assert row.split()[1:4] == ["-", "above", "1.25"]
    joined = " ".join(shown.split())
    for told in ("above 1.25 s/rad", "0.273 rad/s", "7 samples (ends of the filter)", "0.5 N.m, 12 samples worth 6"):
        assert told in joined
    assert "unused" not in joined


def test_a_measured_steepness_is_printed_as_a_number() -> None:
    fit = replace(FIT, bounded=(), intervals={**FIT.intervals, "r": (2.5, 3.5)})
    assert "3.0000   2.5000 ... 3.5000" in text(Friction(fit, None, "d", COLUMNS, 0.1))


def test_data_is_json_with_open_ends_as_none() -> None:
    found = json.loads(json.dumps(data(Friction(FIT, None, "d", COLUMNS, 0.1)), allow_nan=False))
    assert found["by_filter"] is None
    assert found["parameters"]["r"]["interval"] == [1.25, None]
    assert found["parameters"]["r"]["bounded_only"]
    assert found["parameters"]["tau_s"]["at_bound"]
    assert found["dropped"] == {"ends of the filter": 7}
    assert found["objective"] == "weighted least squares"


def test_page_shows_both_fits_and_escapes() -> None:
    result = Friction(FIT, replace(FIT, weighted=False), "a < b", COLUMNS, 0.1)
    html = page(result, [Drawing("friction", "curve", b"<svg/>")], "pysim friction x")
    assert "a &lt; b" in html
    assert html.count("above 1.25") == 3
    assert "pysim friction x" in html


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
