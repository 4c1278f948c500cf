"""What appears on lines that are not excited."""

import numpy as np

from pysim.identify.multisine import DropPeriods, lines_of
from pysim.identify.multisine.levels import interpolated, on_free_lines
from tests.pysim.identify.multisine.systems import AMPLITUDE, ODD, PERIOD, N, measure

LINES = lines_of(ODD)


def test_a_parabola_is_interpolated_exactly() -> None:
    k = ODD / 50
    found = interpolated((1 + 2j) - 3 * k + 1j * k**2, ODD, np.array([2, 50, 98]))
    x = np.array([2, 50, 98]) / 50
    np.testing.assert_allclose(found, (1 + 2j) - 3 * x + 1j * x**2)
    np.testing.assert_allclose(interpolated(np.array([1.0 + 0j, 1.0]), np.array([3, 7]), np.array([5])), 1.0)


def test_a_line_of_known_height_is_found_and_the_gain_s_share_taken_off() -> None:
    """0.06 on line 20 of the output, and 0.1 on line 30 of the input that the gain of 2 brings to the output."""
    t = np.arange(N) / N
    data = measure(ODD, realisations=1, periods=4, seed=0, respond=lambda u: 2 * u)
    values = data.values.copy()
    values[..., 1] += 0.06 * np.cos(2 * np.pi * 20 * t) + 0.2 * np.cos(2 * np.pi * 30 * t)
    values[..., 0] += 0.1 * np.cos(2 * np.pi * 30 * t)
    spectra = DropPeriods(0).spectra(type(data)(values, data.names, data.units, data.period))
    level = on_free_lines(spectra, LINES, LINES.even, np.full(ODD.size, 2.0 + 0j), np.full(ODD.size, AMPLITUDE))
    assert level is not None
    np.testing.assert_allclose(level.frequency, LINES.even / PERIOD)
    expected = np.where(LINES.even == 20, (0.06 / AMPLITUDE) ** 2, 0.0)
    np.testing.assert_allclose(level.variance, expected, atol=1e-20)


def test_nothing_without_such_lines_or_without_noise() -> None:
    spectra = DropPeriods(0).spectra(measure(ODD, realisations=1, periods=1, seed=0))
    unit, height = np.ones(ODD.size, dtype=complex), np.ones(ODD.size)
    assert on_free_lines(spectra, LINES, LINES.even, unit, height) is None
    spectra = DropPeriods(0).spectra(measure(ODD, realisations=1, periods=2, seed=0))
    assert on_free_lines(spectra, LINES, LINES.odd, unit, height) is None
