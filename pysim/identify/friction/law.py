"""Friction of a shaft over its speed: thesis Eq. 5.38, its derivatives, and its mean over a change of speed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FRICTION_NAMES = ("r", "omega_0", "tau_c", "tau_s")
FRICTION_UNITS = ("s/rad", "rad/s", "N.m", "N.m")

# Three-point Gauss rule on [-1/2, 1/2]: exact for polynomials of the speed up to degree five
_NODES = np.array([-0.5, 0.0, 0.5]) * np.sqrt(0.6)
_SHARES = np.array([5.0, 8.0, 5.0]) / 18


def friction_torque(parameters: Array, speed: Array) -> Array:
    """tanh(r w) (tau_c + (tau_s - tau_c) exp(-|w| / omega_0)), (n,) N.m, with the sign of the speed.

    Args:
        parameters: (4,) r (s/rad), omega_0 (rad/s), tau_c and tau_s (N.m).
        speed: (n,) rad/s.
    Source: thesis Eq. 5.38.
    """
    r, omega_0, tau_c, tau_s = parameters
    return np.tanh(r * speed) * (tau_c + (tau_s - tau_c) * np.exp(-np.abs(speed) / omega_0))


def friction_slopes(parameters: Array, speed: Array) -> Array:
    """Derivatives of `friction_torque` by the four parameters, (n, 4), in N.m per the parameter's unit."""
    r, omega_0, tau_c, tau_s = parameters
    step, fade = np.tanh(r * speed), np.exp(-np.abs(speed) / omega_0)
    by_r = speed * (1 - step**2) * (tau_c + (tau_s - tau_c) * fade)
    by_omega_0 = step * (tau_s - tau_c) * fade * np.abs(speed) / omega_0**2
    return np.column_stack([by_r, by_omega_0, step * (1 - fade), step * fade])


def mean_friction(parameters: Array, speed: Array, change: Array) -> Array:
    """Mean friction over time while the speed changes linearly by `change`, with the mean `speed`, (n,) N.m."""
    values = [friction_torque(parameters, speed + node * change) for node in _NODES]
    return np.tensordot(_SHARES, np.array(values), axes=1)


def mean_slopes(parameters: Array, speed: Array, change: Array) -> Array:
    """Derivatives of `mean_friction` by the four parameters, (n, 4)."""
    values = [friction_slopes(parameters, speed + node * change) for node in _NODES]
    return np.tensordot(_SHARES, np.array(values), axes=1)
