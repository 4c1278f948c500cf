import math

import numpy as np
import pytest

from pysim.excitation import LeadIn, LineGrid, Multisine
from pysim.types import BadInput

GRID = LineGrid(4.0, 0.25, 12.5, "random-odd", seed=3)


def period_of(test: Multisine, count: int) -> np.ndarray:
    return test.signal().value(test.onset + np.arange(count) / count * test.period)


def test_power_is_on_the_excited_lines_only() -> None:
    test = Multisine(GRID, seed=2, rms=5.0, offset=30.0, shape=tuple(np.linspace(1, 2, GRID.excited.size)))
    spectrum = np.fft.rfft(period_of(test, 256)) / 128
    assert spectrum[0].real / 2 == pytest.approx(30.0)
    np.testing.assert_allclose(spectrum[GRID.excited], test.coefficients(), atol=1e-10)
    others = np.setdiff1d(np.arange(1, 129), GRID.excited)
    assert np.max(np.abs(spectrum[others])) < 1e-10
    relative = np.abs(test.coefficients())
    np.testing.assert_allclose(relative / relative[0], np.linspace(1, 2, GRID.excited.size))


def test_is_periodic_from_time_zero_without_a_lead_in() -> None:
    signal = Multisine(GRID, seed=2, rms=5.0, lead=LeadIn.none()).signal()
    t = np.linspace(0.0, 4.0, 333)[:-1]
    np.testing.assert_allclose(signal.value(t + 8.0 - 1e-12), signal.value(t), atol=1e-9)


def test_levels_are_met() -> None:
    rms = Multisine(GRID, seed=4, rms=5.0)
    assert np.sqrt(np.mean(period_of(rms, 256) ** 2)) == pytest.approx(5.0)
    peak = Multisine(GRID, seed=4, peak=10.0)
    assert np.max(np.abs(period_of(peak, 200_000))) == pytest.approx(10.0, rel=1e-4)


def test_the_wave_begins_where_it_passes_zero() -> None:
    test = Multisine(GRID, seed=9, rms=5.0, offset=50.0)
    signal = test.signal()
    first = signal.starts[3]
    assert 1.0 < first <= 2.0
    assert signal.value(np.array([first])) == pytest.approx([50.0])
    t = np.linspace(first, 2.0, 50)
    np.testing.assert_allclose(signal.value(t), signal.value(t + 4.0), atol=1e-9)  # already the periodic wave


def test_realisations_differ_in_phase_alone() -> None:
    first = Multisine(GRID, seed=2, rms=5.0)
    second = first.realisation(1)
    np.testing.assert_allclose(np.abs(first.coefficients()), np.abs(second.coefficients()))
    assert np.max(np.abs(np.angle(first.coefficients() / second.coefficients()))) > 1.0
    assert second == Multisine(GRID, seed=3, rms=5.0)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"rms": None}, "by rms or by peak"),
        ({"peak": 1.0}, "by rms or by peak"),
        ({"rms": -1.0}, "the level is -1"),
        ({"shape": (1.0, 2.0)}, "one per excited line"),
        ({"shape": (0.0,) * GRID.excited.size}, "not all zero"),
        ({"periods": 0.0}, "number of periods"),
        ({"offset": math.nan}, "the offset is nan"),
        ({"seed": -1}, "the seed is -1"),
    ],
)
def test_refuses_what_is_no_multisine(wrong: dict, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        Multisine(**({"grid": GRID, "seed": 0, "rms": 1.0} | wrong))
