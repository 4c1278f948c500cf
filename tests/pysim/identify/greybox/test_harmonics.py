import numpy as np
import pytest

from pysim.identify.greybox.harmonics import harmonic_count, interpolation, regressors, to_complex


def wave(phase: np.ndarray) -> np.ndarray:
    return 3 + 2 * np.sin(phase + 0.4) + 0.5 * np.sin(2 * phase - 1) + 0.1 * np.cos(3 * phase)


@pytest.mark.parametrize("points", [9, 10, 49])
def test_samples_of_one_period_give_the_signal_at_any_phase(points: int) -> None:
    phase = np.random.default_rng(1).uniform(-20, 20, 30)
    nodes = 2 * np.pi * np.arange(points) / points
    assert interpolation(phase, points) @ wave(nodes) == pytest.approx(wave(phase), abs=1e-12)


def test_regression_gives_mean_sizes_and_phases() -> None:
    phase = np.linspace(0, 17, 83)
    coefficients = np.linalg.lstsq(regressors(phase, 3), wave(phase), rcond=None)[0]
    expected = [3, 2 * np.exp(0.4j), 0.5 * np.exp(-1j), 0.1j]
    assert to_complex(coefficients) == pytest.approx(expected, abs=1e-12)


def test_no_more_harmonics_than_the_sampling_tells_apart() -> None:
    assert [harmonic_count(f, 250.0, 5) for f in (1.0, 22.4, 30.0, 200.0)] == [5, 5, 3, 1]
