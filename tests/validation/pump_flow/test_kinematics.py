"""The calculation from the geometry against the thesis' closed forms and what has to hold whatever the formula."""

import numpy as np
import pytest

from validation.pump_flow.kinematics import SPEED, Geometry

PUMP = Geometry()
THETA = np.linspace(0, 2 * np.pi, 721)


@pytest.mark.parametrize("alpha", [-0.2, 0.05, np.deg2rad(15)])
def test_position_is_eq_3_29_and_velocity_eq_3_31(alpha: float) -> None:
    tilt = alpha * np.cos(THETA)
    exact = PUMP.r_0 * np.sin(tilt) / np.sin(PUMP.cone - tilt)
    assert np.abs(PUMP.position(THETA, alpha) - exact).max() < 1e-15
    tilt_rate = 0.7 * np.cos(THETA) - SPEED * alpha * np.sin(THETA)
    velocity = -tilt_rate * 2 * PUMP.r_0 * np.sin(PUMP.cone) / (np.cos(2 * (tilt - PUMP.cone)) - 1)
    assert np.abs(PUMP.velocity(THETA, alpha, SPEED, 0.7) - velocity).max() < 1e-12


def test_stroke_between_the_ports_is_the_displacement() -> None:
    ends = PUMP.position(np.array([PUMP.opens, PUMP.closes]), PUMP.largest)
    assert PUMP.pistons * PUMP.area * (ends[0] - ends[1]) == pytest.approx(71e-6, rel=1e-12)
    assert PUMP.closes - PUMP.opens == pytest.approx(np.pi, rel=1e-12)


def test_mean_over_a_revolution_is_eq_3_48() -> None:
    theta = (np.arange(360_000) + 0.5) / 360_000 * 2 * np.pi
    flows = PUMP.flow(theta, PUMP.largest)
    assert flows[0].mean() == pytest.approx(PUMP.mean, rel=1e-5)
    assert flows[1].mean() == pytest.approx(-PUMP.mean, rel=1e-5)


def test_all_flow_is_what_the_pistons_displace() -> None:
    """Both ports together, over the volume of all chambers."""
    alpha, h = 0.2, 1e-6
    both = sum(PUMP.flow(THETA, alpha))
    each = THETA[:, None] + 2 * np.pi / 9 * np.arange(9)
    volume = [PUMP.area * PUMP.position(each + side * h, alpha).sum(axis=1) for side in (-1, 1)]
    assert np.abs(both + (volume[1] - volume[0]) / (2 * h) * SPEED).max() < 1e-9
