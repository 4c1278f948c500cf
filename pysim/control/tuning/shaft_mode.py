"""What neither plant alone shows: the shaft between its two circuits, under friction that falls with speed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pysim.control.tuning.bench_plants import _OMEGA_SV, _ZETA_SV, BETA, J_EFF, K_M, K_QU, V_L0, V_S0
from pysim.types import BadInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_TAU_C, _TAU_S, _OMEGA_0 = 14.8939, 54.8258, 8.3593  # thesis Table 6.2
_P_SUPPLY = 310e5  # Pa, of the load circuit, as K_qu and K_qp of Table 5.1 imply
_SPEEDS = np.geomspace(100.0, 1.0, 400)


def coupled_poles(K_p: float, T_i: float, *, speed: float, friction: bool = True) -> Complex:
    """Poles (6,) rad/s of shaft, both circuits, servo valve and load controller, the pump's flow held.

    States: speed, supply pressure, load pressure, integral, spool and its rate. K_qp is that of the opening at which
    the valve passes what the motor pumps at this speed, without load; the friction's slope is that of Eq. 5.38.

    Args:
        K_p, T_i: of the load controller, 1/Pa and s.
        speed: rad/s, away from standstill.
        friction: False takes no friction at all.
    Raises:
        BadInput: a speed or an integration time that is not positive.
    Source: thesis Eq. 5.10 to 5.14, 5.23, 5.24, 5.38, Tables 5.1 and 6.2.
    """
    if not 0 < speed < math.inf or not 0 < T_i < math.inf:
        raise BadInput(f"coupled poles: speed = {speed:g} rad/s, T_i = {T_i:g} s; give positive numbers")
    slope = -(_TAU_S - _TAU_C) / _OMEGA_0 * math.exp(-speed / _OMEGA_0) if friction else 0.0
    supply, load = 2 * BETA / V_S0, 2 * BETA / V_L0
    K_qp = K_M * speed / (2 * _P_SUPPLY)
    omega, zeta = _OMEGA_SV, _ZETA_SV
    system = np.array(
        [
            [-slope / J_EFF, K_M / J_EFF, -K_M / J_EFF, 0, 0, 0],
            [-supply * K_M, 0, 0, 0, 0, 0],
            [load * K_M, 0, -load * K_qp, 0, load * K_QU, 0],
            [0, 0, -K_p / T_i, 0, 0, 0],
            [0, 0, 0, 0, 0, 1],
            [0, 0, -K_p * omega**2, omega**2, -(omega**2), -2 * zeta * omega],
        ]
    )
    return np.asarray(np.linalg.eigvals(system), dtype=np.complex128)


def growth(K_p: float, T_i: float, *, speed: float) -> float:
    """Largest real part of the oscillating poles, 1/s: positive where stick and slip begin."""
    poles = coupled_poles(K_p, T_i, speed=speed)
    return float(poles.real[np.abs(poles.imag) > 1.0].max(initial=-math.inf))


def steady_above(K_p: float, T_i: float) -> float:
    """The speed, rad/s, from which on up the shaft turns without stick and slip; infinite where there is none."""
    rates = np.array([growth(K_p, T_i, speed=float(speed)) for speed in _SPEEDS])
    wild = np.flatnonzero(rates >= 0)
    if wild.size == 0:
        return float(_SPEEDS[-1])
    return float(_SPEEDS[wild[0] - 1]) if wild[0] > 0 else math.inf


def damping_gain(T_i: float, *, speed: float) -> float:
    """The load controller's K_p, 1/Pa, that damps the shaft best at a speed, rad/s."""
    gains = np.geomspace(2e-10, 2e-8, 200)
    return float(gains[np.argmin([growth(float(K_p), T_i, speed=speed) for K_p in gains])])
