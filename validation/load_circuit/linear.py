"""Transfer functions of thesis Eq. 5.14, 5.15, 5.27 and 5.28 with the numbers of Table 5.1, over s = j omega (n,)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]

# Table 5.1, as printed
K_QU, K_QP, BETA = 0.0035, 5.61e-12, 1400e6
V_L0, V_S0 = 1.01e-3, 1.52e-3
K_P, K_M, C, J_EFF = 0.0066, 9.5493e-6, 0.26, 0.0733


def servo_valve(s: Complex) -> Complex:
    """Eq. 5 of Appendix D.6."""
    omega, zeta = 2 * np.pi * 78.1, 0.646
    found: Complex = omega**2 / (s**2 + 2 * zeta * omega * s + omega**2)
    return found


def pump(s: Complex) -> Complex:
    """Eq. 5.18: Table 4.1, offset 25 and amplitude 5 percent."""
    return 62091e6 / (s**5 + 191 * s**4 + 88408 * s**3 + 11612e3 * s**2 + 1429e6 * s + 60185e6)


def load_pressure(s: Complex) -> Complex:
    """Eq. 5.14: p_L over the command of the servo valve, Pa."""
    stiffness = 2 * BETA / V_L0
    return servo_valve(s) * K_QU * stiffness / (s + stiffness * K_QP)


def load_speed(s: Complex) -> Complex:
    """Eq. 5.15: omega_L over the command of the servo valve, rad/s."""
    share = V_L0 * J_EFF
    middle = (2 * BETA * J_EFF * K_QP + C * V_L0) / share
    last = 2 * BETA * (K_QP * C + K_M**2) / share
    return servo_valve(s) * K_QU * K_M * 2 * BETA / share / (s**2 + middle * s + last)


def supply_pressure(s: Complex) -> Complex:
    """Eq. 5.27: p_s over the pump's command in rad, Pa."""
    return pump(s) * K_P * 2 * BETA / V_S0 / s


def supply_speed(s: Complex) -> Complex:
    """Eq. 5.28: omega_s over the pump's command in rad, rad/s."""
    share = V_S0 * J_EFF
    return pump(s) * K_P * 2 * BETA * K_M / share / (s**2 + C / J_EFF * s + 2 * BETA * K_M**2 / share)
