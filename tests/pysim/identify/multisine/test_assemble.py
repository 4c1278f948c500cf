"""Everything around a gain."""

import numpy as np

from pysim.identify.multisine import DropPeriods, lines_of
from pysim.identify.multisine.assemble import amplitude_of, assemble, hertz
from pysim.identify.multisine.linear_part import over_realisations
from tests.pysim.identify.multisine.systems import AMPLITUDE, FULL, ODD, measure


def test_levels_add_up_to_the_total() -> None:
    lines = lines_of(ODD)
    spectra = DropPeriods(0).spectra(
        measure(ODD, realisations=4, periods=3, noise=0.05, seed=0, respond=lambda u: u + 0.1 * u**2 + 0.1 * u**3)
    )
    bla = assemble(spectra, lines, over_realisations(spectra, lines), "a method")
    assert bla.total is not None
    assert bla.noise is not None
    assert bla.on_lines is not None
    assert bla.even is not None
    assert bla.distortion is not None
    np.testing.assert_allclose(bla.noise.variance + bla.on_lines.variance, bla.total.variance)
    assert np.all(bla.distortion.variance > bla.on_lines.variance)  # the even part comes on top
    inside = np.mean(bla.even.variance)
    assert np.mean(bla.distortion.variance - bla.on_lines.variance) > 0.5 * inside
    assert bla.method == "a method"


def test_where_every_line_is_excited_the_distortion_is_what_is_on_them() -> None:
    lines = lines_of(FULL)
    spectra = DropPeriods(0).spectra(measure(FULL, realisations=4, periods=3, noise=0.05, seed=0))
    bla = assemble(spectra, lines, over_realisations(spectra, lines), "")
    assert bla.distortion is bla.on_lines
    np.testing.assert_allclose(amplitude_of(spectra, lines), AMPLITUDE)
    np.testing.assert_allclose(hertz(spectra, lines), FULL / 2.0)
