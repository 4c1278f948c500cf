"""The pull of the pistons where closed forms know it."""

import numpy as np
import pytest

from validation.plate_pull.kinematics import at_zero_angle, mean_pull, pull
from validation.pump_flow.kinematics import Geometry

PUMP = Geometry()


def test_a_pressure_difference_pulls_back_at_no_angle() -> None:
    assert mean_pull(PUMP, 0.0, 77e5, 25e5) == pytest.approx(
        at_zero_angle(PUMP, 52e5), rel=2e-3
    )  # ports to half a step


def test_the_same_pressure_everywhere_pulls_out_by_the_cone_alone() -> None:
    """N A r_0 / sin(phi_0) alpha cot(phi_0) p for small angles; nothing at no angle, or where the axes are parallel."""
    lever = PUMP.pistons * PUMP.area * PUMP.r_0 / np.sin(PUMP.cone)
    assert mean_pull(PUMP, 0.0, 25e5, 25e5) == pytest.approx(0.0, abs=1e-9)
    assert mean_pull(PUMP, 1e-3, 25e5, 25e5) == pytest.approx(lever * 1e-3 / np.tan(PUMP.cone) * 25e5, rel=1e-4)
    straight = Geometry(cone=np.pi / 2)
    assert mean_pull(straight, 0.1, 25e5, 25e5) == pytest.approx(0.0, abs=1e-9)


def test_a_chamber_that_changes_its_port_makes_the_torque_jump() -> None:
    """By the pressure difference times A dx/dalpha, with the piston delta behind its dead centre."""
    before, after = pull(PUMP, PUMP.opens + np.array([-1e-9, 1e-9]), 0.0, 77e5, 25e5)
    moved = PUMP.r_0 / np.sin(PUMP.cone) * np.cos(PUMP.opens)
    assert after - before == pytest.approx(52e5 * PUMP.area * moved, rel=1e-6)
