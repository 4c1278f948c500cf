"""The multisine picture shows the numbers it was given, and leaves out what is not there."""

from dataclasses import replace

import numpy as np

from pysim.identify.multisine import DropPeriods, fast_approximation, pooled, robust_approximation
from pysim.present.multisine import multisine_figure
from tests.pysim.identify.multisine.systems import ODD, measure, with_free_lines

FREE = with_free_lines(ODD, seed=11)
DATA = measure(FREE, realisations=1, periods=4, noise=0.01, seed=8, respond=lambda u: u + 0.1 * u**2 + 0.2 * u**3)
FAST = fast_approximation(DATA, transient=DropPeriods(0))


def test_curves_are_the_levels_in_decibels() -> None:
    figure = multisine_figure(FAST, "10 %")
    top, bottom = figure.axes
    noise, distortion, even, even_mean, odd, _, gain = top.get_lines()
    assert FAST.noise is not None
    assert FAST.distortion is not None
    assert FAST.even is not None
    assert FAST.odd is not None
    np.testing.assert_allclose(noise.get_ydata(), 10 * np.log10(FAST.noise.variance))
    np.testing.assert_allclose(distortion.get_ydata(), 10 * np.log10(FAST.distortion.variance))
    np.testing.assert_allclose(even.get_ydata(), 10 * np.log10(FAST.even.variance))
    np.testing.assert_allclose(odd.get_xdata(), FAST.odd.frequency)
    mean = pooled(FAST.even, np.asarray(even_mean.get_xdata(), dtype=float), 6)
    np.testing.assert_allclose(even_mean.get_ydata(), 10 * np.log10(mean.variance))
    np.testing.assert_allclose(gain.get_ydata(), 20 * np.log10(np.abs(FAST.gain)))
    np.testing.assert_allclose(bottom.get_lines()[0].get_ydata(), np.degrees(np.unwrap(np.angle(FAST.gain))))
    assert top.get_ylabel() == "Gain and levels (dB re 1 m/V)"
    assert [t.get_text() for t in figure.legends[0].get_texts()] == [
        "noise",
        "distortion",
        "even part",
        "odd part",
        "best linear approximation",
        "95 %",
    ]


def test_what_the_noise_hides_is_a_gap() -> None:
    linear = fast_approximation(measure(FREE, realisations=1, periods=4, noise=0.01, seed=1))
    assert linear.even is not None
    drawn = np.asarray(multisine_figure(linear, "").axes[0].get_lines()[2].get_ydata(), dtype=float)
    np.testing.assert_array_equal(np.isnan(drawn), linear.even.variance <= 0)
    assert np.isnan(drawn).any()


def test_one_period_has_one_level() -> None:
    single = robust_approximation(measure(FREE, realisations=3, periods=1, noise=0.01, seed=2))
    top = multisine_figure(single, "a").axes[0]
    assert top.get_title() == "a"
    assert len(top.get_lines()) == 2


def test_a_line_that_knows_nothing_does_not_widen_the_axes() -> None:
    variance = FAST.variance.copy()
    variance[-1] = 1e6
    low, high = multisine_figure(replace(FAST, variance=variance), "").axes[1].get_ylim()
    phase = np.degrees(np.unwrap(np.angle(FAST.gain)))[:-1]
    assert low < phase.min()
    assert high > phase.max()
    assert high - low < np.ptp(phase) + 2 * 45 + 10
