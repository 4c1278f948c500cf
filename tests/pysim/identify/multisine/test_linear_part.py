"""The small formulae behind the three methods."""

import numpy as np
import pytest

from pysim.identify.multisine import DropPeriods, lines_of
from pysim.identify.multisine.linear_part import (
    equation_error,
    first_gain,
    gain_from_responses,
    noise_power,
    over_free_lines,
    over_neighbours,
    over_realisations,
)
from tests.pysim.identify.multisine.systems import FULL, gain, measure

SPECTRA = DropPeriods(0).spectra(measure(FULL, realisations=3, periods=3, noise=0.05, seed=0))
LINES = lines_of(FULL)


def test_equation_error_is_the_variance_of_y_minus_gain_u() -> None:
    rng = np.random.default_rng(0)
    mixing = rng.standard_normal((2, 2)) + 1j * rng.standard_normal((2, 2))
    g = 0.7 - 0.4j
    expected = np.sum(np.abs(np.array([-g, 1.0]) @ mixing) ** 2)
    found = equation_error((mixing @ mixing.conj().T)[None], np.array([g]))
    np.testing.assert_allclose(found, [expected])
    with_reference = np.zeros((1, 3, 3), dtype=complex)
    with_reference[0, :2, :2] = mixing @ mixing.conj().T
    np.testing.assert_allclose(equation_error(with_reference, np.array([g])), [expected])


def test_gain_from_responses_with_and_without_a_measured_input() -> None:
    g, error, size = gain_from_responses(np.array([[2.0 + 0j]]), np.array([[[3.0 + 0j]]]))
    assert (g[0], error[0], size[0]) == (2.0, 3.0, 1.0)
    g, error, size = gain_from_responses(np.array([[2.0j, 4.0]]), np.diag([1.0, 5.0])[None].astype(complex))
    assert (g[0], error[0], size[0]) == (-2.0j, 4.0 + 5.0, 4.0)


def test_noise_power_picks_the_lines() -> None:
    assert SPECTRA.noise is not None
    found = noise_power(SPECTRA.noise, np.array([3, 7]), np.zeros(2, dtype=complex))
    np.testing.assert_allclose(found, SPECTRA.noise[[2, 6], 1, 1].real)


@pytest.mark.parametrize(("realisations", "width"), [(2, 7), (3, 3), (4, 3), (7, 1), (20, 1)])
def test_many_realisations_need_no_neighbours(realisations: int, width: int) -> None:
    spectra = DropPeriods(0).spectra(measure(FULL, realisations=realisations, periods=2, noise=0.05, seed=1))
    part = over_realisations(spectra, LINES)
    np.testing.assert_allclose(part.variance_degrees, width * 2 * (realisations - 1))
    assert np.mean(part.variance) == pytest.approx(np.mean(part.power) / realisations, rel=0.15)


def test_all_methods_agree_on_a_linear_system() -> None:
    robust, smooth = over_realisations(SPECTRA, LINES), over_neighbours(SPECTRA, LINES, order=4, width=11)
    free = over_free_lines(SPECTRA, LINES, robust.power, robust.degrees)
    np.testing.assert_allclose(free.gain, robust.gain)
    np.testing.assert_allclose(first_gain(SPECTRA, LINES), robust.gain)
    middle = slice(1, -1)  # three realisations: means over three lines
    neighbours = (robust.power[:-2] + robust.power[1:-1] + robust.power[2:]) / 3
    np.testing.assert_allclose(robust.variance[middle], neighbours / 3)
    np.testing.assert_allclose(robust.variance_degrees, 12)
    np.testing.assert_allclose(robust.degrees, 4)
    for part in (robust, smooth):
        assert np.mean(np.abs(part.gain - gain(FULL)) ** 2 / part.variance) == pytest.approx(1.3, abs=0.8)
        assert part.noise is not None
        assert np.mean(part.power / part.noise) == pytest.approx(1.0, abs=0.3)
    assert np.mean(smooth.variance) < 0.7 * np.mean(robust.variance)  # neighbours help
