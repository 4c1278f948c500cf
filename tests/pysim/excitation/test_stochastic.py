"""The realised wave against its spectrum."""

import math

import numpy as np
import pytest
from scipy.special import gammaincc
from scipy.stats import chi2

from pysim.excitation import LeadIn, PiersonMoskowitz, StochasticWave
from pysim.types import BadInput

SEA = PiersonMoskowitz(100.0, 1.0)


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_components_carry_the_spectrums_moments(order: int) -> None:
    wave = StochasticWave(SEA, 30.0, seed=1, components=2000)
    # with x = b omega^-4 the moment is Gamma(1 - n/4, x), and all but a thousandth of the variance is above x
    within = gammaincc(1 - order / 4, -math.log(0.999))
    assert wave.moment(order) == pytest.approx(SEA.moment(order) * within, rel=1e-3)


def test_few_components_keep_the_height_too() -> None:
    assert 4 * math.sqrt(StochasticWave(SEA, 30.0, seed=1, components=20).moment(0)) == pytest.approx(100.0, rel=1e-3)


def test_realised_record_has_the_components_moments() -> None:
    # Centres of a band from zero are odd multiples of half the spacing: the wave is periodic in twice `repeats_after`,
    # and over that time the mean square of the wave and of its rate are m_0 and m_2 exactly.
    wave = StochasticWave(SEA, 100.0, seed=7, components=60, band_hz=(0.0, 6.0), scatter=False, lead=LeadIn.none())
    period = 2 * wave.repeats_after
    t = np.arange(4096) / 4096 * period
    value, rate = wave.signal().value(t), wave.signal().derivative(t)
    assert np.mean(value**2) == pytest.approx(wave.moment(0), rel=1e-9)
    assert np.mean(rate**2) == pytest.approx(wave.moment(2), rel=1e-9)
    assert wave.repeats_after == pytest.approx(10.0)


def test_record_of_a_scattered_wave_has_the_significant_height() -> None:
    wave = StochasticWave(SEA, 600.0, seed=11, components=400, lead=LeadIn.none())
    value = wave.signal().value(np.linspace(0.0, 600.0, 60001))
    # var of the sample variance of a Gaussian process: 2 integral S^2 domega * 2 pi / T / 2; S is about 1.2 rad/s wide
    spread = math.sqrt(2 * math.pi / (600.0 * 6.0))
    assert 4 * np.std(value) == pytest.approx(100.0, rel=3 * spread / 2)


def test_phases_and_frequencies_are_spread_evenly_and_follow_the_seed() -> None:
    wave = StochasticWave(SEA, 30.0, seed=4, components=1000)
    _, phase, omega = wave.waves().T
    edges = wave.edges
    for share in (phase / (2 * math.pi), (omega - edges[:-1]) / np.diff(edges)):
        counts, _ = np.histogram(share, bins=20, range=(0.0, 1.0))
        assert chi2.sf(np.sum((counts - 50) ** 2 / 50), 19) > 0.001
    np.testing.assert_array_equal(StochasticWave(SEA, 30.0, seed=4, components=1000).waves(), wave.waves())
    assert not np.allclose(StochasticWave(SEA, 30.0, seed=5, components=1000).waves()[:, 1], phase)


def test_even_spacing_has_its_frequencies_in_the_middle() -> None:
    wave = StochasticWave(SEA, 30.0, seed=4, components=20, band_hz=(0.5, 2.5), scatter=False)
    np.testing.assert_allclose(wave.waves()[:, 2] / (2 * math.pi), 0.55 + 0.1 * np.arange(20))


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"components": 0}, "0 components"),
        ({"length": 0.0}, "the length is 0 s"),
        ({"band_hz": (2.0, 1.0)}, "from 2 to 1 Hz is empty"),
        ({"offset": math.inf}, "the offset is inf"),
        ({"seed": -1}, "the seed is -1"),
        ({"components": 10**9}, r"1e\+09 sines are too many"),
    ],
)
def test_refuses_what_is_no_wave(wrong: dict, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        StochasticWave(**({"spectrum": SEA, "length": 10.0, "seed": 0} | wrong))
