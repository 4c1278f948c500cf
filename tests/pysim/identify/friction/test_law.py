"""Thesis Eq. 5.38: its limits, its slopes against differences, its mean against quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad

from pysim.identify.friction import friction_slopes, friction_torque, mean_friction, mean_slopes

TRUTH = np.array([13.8806, 8.3593, 14.8939, 54.8258])
SPEEDS = np.array([-60.0, -3.0, -0.05, 0.0, 0.02, 0.3, 8.3593, 40.0])


def test_limits_of_the_law() -> None:
    assert friction_torque(TRUTH, np.array([0.0]))[0] == 0.0
    assert friction_torque(TRUTH, np.array([1e4]))[0] == pytest.approx(14.8939)
    # at omega_0 the stiction above Coulomb friction has fallen to 1/e
    at = friction_torque(TRUTH, np.array([8.3593, -8.3593]))
    np.testing.assert_allclose(at, np.array([1, -1]) * (14.8939 + (54.8258 - 14.8939) / np.e))
    slope = friction_torque(TRUTH, np.array([1e-7]))[0] / 1e-7
    assert slope == pytest.approx(13.8806 * 54.8258, rel=1e-5)


@pytest.mark.parametrize("function", [friction_torque, lambda p, w: mean_friction(p, w, 0.4 * w)])
def test_slopes_are_differences(function) -> None:  # type: ignore[no-untyped-def]
    slopes = friction_slopes(TRUTH, SPEEDS) if function is friction_torque else mean_slopes(TRUTH, SPEEDS, 0.4 * SPEEDS)
    for i in range(4):
        step = 1e-5 * TRUTH[i] * np.eye(4)[i]
        difference = (function(TRUTH + step, SPEEDS) - function(TRUTH - step, SPEEDS)) / (2 * step[i])
        np.testing.assert_allclose(slopes[:, i], difference, rtol=1e-6, atol=1e-8)


def test_mean_over_an_even_change_of_speed() -> None:
    expected, _ = quad(lambda w: friction_torque(TRUTH, np.array([w]))[0] / 2.0, 2.0, 4.0, epsabs=1e-12)
    mean = mean_friction(TRUTH, np.array([3.0]), np.array([2.0]))
    assert mean[0] == pytest.approx(expected, rel=1e-6)
    # the law bends: its value in the middle is not its mean
    assert abs(friction_torque(TRUTH, np.array([3.0]))[0] - expected) > 0.05
