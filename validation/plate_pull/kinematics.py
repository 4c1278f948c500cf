"""The pull of the pistons on the swash plate from the geometry alone, apart from the library's equations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from validation.pump_flow.kinematics import Geometry

Array = NDArray[np.float64]
_STEPS = 4_000  # of a revolution, for its mean


def pull(pump: Geometry, theta: Array, alpha: float, p_A: float, p_B: float) -> Array:
    """Torque of all pistons towards larger angles (n,), N m, for angles of piston 1 theta (n,).

    By virtual work: each chamber's pressure times its area times how far its piston moves with the angle, by a complex
    step.
    """
    each = theta[:, None] + 2 * np.pi / pump.pistons * np.arange(pump.pistons)
    h = 1e-30
    moved = pump.position(each, alpha + 1j * h).imag / h
    turned = np.mod(each, 2 * np.pi)
    to_a = (turned >= pump.opens) & (turned < pump.closes)
    return np.asarray(pump.area * np.where(to_a, p_A, p_B) * moved).sum(axis=1)


def mean_pull(pump: Geometry, alpha: float, p_A: float, p_B: float) -> float:
    """Over a revolution, N m."""
    theta = (np.arange(_STEPS) + 0.5) * 2 * np.pi / _STEPS
    return float(pull(pump, theta, alpha, p_A, p_B).mean())


def at_zero_angle(pump: Geometry, dp: float) -> float:
    """The closed form of the mean at no angle: -N A r_0 / sin(phi_0) sin(delta) / pi times the pressure difference."""
    lever = pump.pistons * pump.area * pump.r_0 / np.sin(pump.cone)
    return float(-lever * np.sin(pump.opens) / np.pi * dp)
