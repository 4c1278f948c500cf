import numpy as np
import pytest

from pysim.identify.chirp.branch import Branch, mean_branch


def branch(gain: float, phase: float, shift: float = 0.0) -> Branch:
    f = np.array([1.0, 2.0]) + shift
    return Branch(f, np.full(2, gain), np.full(2, phase), np.full(2, 0.01 * gain), np.full(2, 0.02))


def test_mean_is_of_decibels_degrees_and_hertz() -> None:
    top, bottom = branch(1.0, -0.2), branch(0.5, -0.4, 0.1)
    mean = mean_branch(top, bottom)
    np.testing.assert_allclose(mean.magnitude_db, 0.5 * (top.magnitude_db + bottom.magnitude_db))  # Eq. 2.17
    np.testing.assert_allclose(mean.phase_deg, np.degrees(-0.3))  # Eq. 2.20
    np.testing.assert_allclose(mean.frequency, [1.05, 2.05])  # Eq. 2.21
    np.testing.assert_allclose(mean.magnitude_deviation_db, 20 / np.log(10) * 0.01)
    np.testing.assert_allclose(mean.phase_deviation, 0.02)


def test_between_points_lines_and_outside_nothing() -> None:
    one = Branch(np.array([1.0, 2.0]), np.array([1.0, 10.0]), np.array([0.0, -1.0]), np.zeros(2), np.zeros(2))
    magnitude, phase = one.at(np.array([1.5, 3.0]))
    assert magnitude[0] == pytest.approx(10.0)
    assert phase[0] == pytest.approx(np.degrees(-0.5))
    assert np.isnan([magnitude[1], phase[1]]).all()
