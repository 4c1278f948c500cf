"""The numbers of the plant: parameters of the thesis, strengths of effects; tuples that compiled code can read."""
# ruff: noqa: N815 - the thesis' symbols

from __future__ import annotations

import math
from typing import NamedTuple

STEP = 20e-6  # s, of the plant's clock


class Parameters(NamedTuple):
    """Thesis Table 4.6 (identified) and Table 5 (known), SI units."""

    omega_v: float = 2 * math.pi * 28.05
    zeta_v: float = 0.82031
    L: float = 47.011e-3
    A_p: float = 401.33e-6
    V_0: float = 0.0607e-3
    m_eff: float = 62.384
    k: float = 13.445e3
    b: float = 13.422e3
    K_p: float = 42.445
    K_D: float = 0.24111
    T_d: float = 0.0040576
    K_L: float = 0.02e-6
    tau: float = 3.83e-3
    beta: float = 1400e6
    rho: float = 875.0
    alpha_max: float = math.radians(15.0)
    p_P: float = 170e5
    p_T: float = 0.0
    k1: float = -4.67e-6
    k2: float = 6.6454e-6
    k3: float = 0.967e-6


BOUNDS = {
    "omega_v": (2 * math.pi * 18, 2 * math.pi * 35),
    "zeta_v": (0.3, 2.0),
    "L": (30e-3, 120e-3),
    "A_p": (314.15e-6, 5026.54e-6),
    "V_0": (0.01e-3, 0.5e-3),
    "m_eff": (20.0, 700.0),
    "k": (0.0, 30e3),
    "b": (0.0, 30e3),
    "K_p": (0.0, 100.0),
    "K_D": (0.01, 1.0),
    "T_d": (0.0035368, 0.0159),
    "K_L": (0.02e-6, 5e-6),
    "tau": (0.0, 50e-3),
}
"""Of the 13 identified parameters, thesis Table 4.6, SI units."""


class Strengths(NamedTuple):
    """Of all effects at once, SI units; zero is off, infinity where a limit is off.

    Behind the two underscores stands the symbol of the effect's list (`effects.STANDARD`, `effects.BEYOND`,
    `effects.SHAPED`).
    """

    # control piston and swash plate
    coulomb__F_c: float = 0.0
    stribeck__F_c: float = 0.0
    stribeck__F_s: float = 0.0
    stribeck__v_s: float = 5e-3
    hardening__k_3: float = 0.0
    preload__F_0: float = 0.0
    bias__F_b: float = 0.0
    backlash__d: float = 0.0
    # proportional valve
    deadband__u_0: float = 0.0
    offset__u_n: float = 0.0
    saturation__u_max: float = math.inf
    rate_limit__r_max: float = math.inf
    hysteresis__h: float = 0.0
    # oil and supply
    air__eps: float = 0.0
    droop__R: float = 0.0
    droop__T: float = 0.01
    laminar__C_l: float = 0.0
    external__C_e: float = 0.0
    # card and sensor
    lag__T_f: float = 0.0
    sampling__T_s: float = 0.0
    deadzone__e_0: float = 0.0
    # beyond the standard list
    shaft__F: float = 0.0
    shaft__f: float = 1450 / 60  # Hz, the pump's shaft
    shaft__phase: float = 0.0
    quadratic__b_2: float = 0.0
    one_sided__k_a: float = 0.0
    worn__C_w: float = 0.0
    worn__x_w: float = 3e-3
    uneven__share: float = 0.0
    spool_friction__a_c: float = 0.0
    ripple__p: float = 0.0
    ripple__f: float = 11.3
    resonance__f: float = 0.0
    resonance__zeta: float = 0.1
    warming__share: float = 0.0
    fading__share: float = 0.0
    # as those of the list, shaped differently
    arctan__F: float = 0.0
    wide__F: float = 0.0
    progressive__k: float = 0.0
    rounded__u_0: float = 0.0
    soft__u: float = math.inf
    isothermal__eps: float = 0.0
    square__R: float = 0.0
    orifice__K: float = 0.0
    twofold__T: float = 0.0
    blunt__e_0: float = 0.0
