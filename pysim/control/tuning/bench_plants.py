"""The plants that the thesis tuned its controllers on."""

from __future__ import annotations

import math
from collections.abc import Mapping

from pysim.control.tuning.plant import Plant

# Table 5.1 as printed, in SI
K_QU, K_QP, BETA = 0.0035, 5.61e-12, 1400e6
V_L0, V_S0 = 1.01e-3, 1.52e-3
K_P, K_M, C, J_EFF = 0.0066, 9.5493e-6, 0.26, 0.0733
# Table 6.1: controller -> (K_p, T_i)
TABLE_6_1: Mapping[str, Mapping[str, tuple[float, float]]] = {
    "load": {"MATLAB tuned": (1.01e-9, 0.023), "manually tuned": (1.98e-9, 0.03)},
    "speed": {"MATLAB tuned": (1.41e-7, 0.000159), "manually tuned": (1.06e-7, 0.000159)},
}
_OMEGA_SV, _ZETA_SV = 2 * math.pi * 78.1, 0.646  # Eq. 5 of Appendix D.6
_PUMP = (1.0, 191.0, 88408.0, 11612e3, 1429e6, 60185e6)  # Table 4.1, offset 25 and amplitude 5 percent
_PUMP_GAIN = 62091e6


def load_pressure_plant(*, K_qu: float = K_QU, K_qp: float = K_QP) -> Plant:
    """Load pressure (Pa) over the servo valve's command (1).

    Args:
        K_qu: m3/s, flow over opening; falls with the load pressure.
        K_qp: m3/(s Pa), flow over pressure; proportional to the opening, zero at rest.
    Source: thesis Eq. 5.14 (5.30), Table 5.1.
    """
    stiffness = 2 * BETA / V_L0
    valve = Plant((_OMEGA_SV**2,), (1.0, 2 * _ZETA_SV * _OMEGA_SV, _OMEGA_SV**2))
    circuit = Plant((K_qu * stiffness,), (1.0, stiffness * K_qp), name="load pressure", output_unit="Pa")
    return circuit.behind(valve)


def shaft_speed_plant(*, c: float = C) -> Plant:
    """Speed of the shaft (rad/s) over the pump's command (rad).

    Args:
        c: N m s/rad, slope of the friction torque over speed.
    Source: thesis Eq. 5.28 (5.31), Table 5.1, pump of Table 4.1.
    """
    spring = 2 * BETA * K_M / (V_S0 * J_EFF)
    pump = Plant((_PUMP_GAIN,), _PUMP, input_unit="rad", output_unit="rad")
    shaft = Plant((K_P * spring,), (1.0, c / J_EFF, spring * K_M), name="shaft speed", output_unit="rad/s")
    return shaft.behind(pump)
