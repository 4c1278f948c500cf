"""Every name of thesis Tables 6 to 10, what it stands for here, and its equation written down a second time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, Array]


@dataclass(frozen=True)
class Block:
    """One name.

    Args:
        table: of Appendix F.
        name: in SimulationX, and in the block here.
        equation: of the thesis; "-" where the table gives none.
        about: what it is, with its sign.
        formula: its value from the others by the thesis' equation; None for what is given to the block.
        tolerance: share of its largest size by which it may be off.
        rate: the formula is its derivative.
    """

    table: int
    name: str
    equation: str
    about: str
    formula: Callable[[Values], Array | float] | None = None
    tolerance: float = 1e-7
    rate: bool = False


def _orifice(opening: Array | float, dp: Array, rho: Array) -> Array:
    """Eq. 3.1, 3.2 and 3.6 without smoothing."""
    return np.sign(dp) * opening * np.sqrt(2 / rho * np.abs(dp))


def _inlet(v: Values) -> Array:
    return np.where(v["u"] >= 0, v["pS"], v["pT"]) - v["p1"]


def _outlet(v: Values) -> Array:
    return v["p2"] - np.where(v["u"] >= 0, v["pT"], v["pS"])


_DIFFERENCES = 1e-3  # Simpson's rule over rows 0.05 ms apart, where the spool passes its middle
_SMOOTHED = 5e-3  # the orifice is smooth within 0.1 bar of no pressure difference, which is 0.4 % of the largest flow
_DELAYED = 5e-3  # a Pade approximant and straight lines between rows

BLOCKS: tuple[Block, ...] = (
    Block(6, "beta", "-", "oil stiffness"),
    Block(6, "alphaMAX", "3.21", "largest angle", lambda v: np.deg2rad(15.0)),
    Block(6, "rho", "-", "density of the oil"),
    Block(6, "pS", "-", "supply pressure"),
    Block(6, "a", "3.8", "rod to axis", lambda v: v["L"] / (2 * np.tan(v["alphaMAX"]))),
    Block(6, "pT", "-", "tank pressure"),
    Block(6, "psi", "3.63", "share of the ripple used"),
    Block(6, "k1", "-", "valve opening, cubic"),
    Block(6, "k2", "-", "valve opening, quadratic"),
    Block(6, "k3", "-", "valve opening, linear"),
    Block(6, "xpMAX", "-", "end stop at positive xp", lambda v: v["stroke_share"] * v["L"] / 2),
    Block(6, "xpMIN", "-", "end stop at negative xp", lambda v: -v["xpMAX"]),
    Block(7, "alphaCMD", "-", "command, percent of the largest angle"),
    Block(7, "alphaRef", "-", "command in rad, same sign", lambda v: v["alphaCMD"] / 100 * v["alphaMAX"]),
    Block(7, "alpha", "3.10", "angle, same sign as xp", lambda v: np.arctan(v["xp"] / v["a"])),
    Block(
        7,
        "P_Cont",
        "3.18",
        "outer controller, of reference less angle",
        lambda v: v["K_p"] * (v["alphaRef"] - v["alpha"]),
    ),
    Block(7, "u_Actual", "-", "spool position fed back", lambda v: v["u"]),
    Block(7, "PD_Prop", "3.17", "inner controller, of P_Cont less u", lambda v: v["K_D"] * (v["P_Cont"] - v["u"])),
    Block(
        7,
        "PD_Der",
        "3.17",
        "its derivative part",
        lambda v: v["K_D"] * v["T_d"] * (v["K_p"] * (v["alphaCMD_t"] / 100 * v["alphaMAX"] - v["alpha_t"]) - v["u_t"]),
    ),
    Block(
        7,
        "delay1",
        "3.20",
        "both parts, later by tau",
        lambda v: np.interp(v["time"] - v["tau"], v["time"], v["PD_Prop"] + v["PD_Der"]),
        _DELAYED,
    ),
    Block(
        8,
        "u_tt",
        "3.19",
        "spool acceleration",
        lambda v: v["omega_v"] ** 2 * (v["uCMD"] - v["u"]) - 2 * v["zeta_v"] * v["omega_v"] * v["u_t"],
    ),
    Block(8, "u_t", "-", "spool velocity, whose rate is u_tt", lambda v: v["u_tt"], _DIFFERENCES, rate=True),
    Block(8, "u", "-", "spool position, positive joins P to chamber 1", lambda v: v["u_t"], _DIFFERENCES, rate=True),
    Block(
        8,
        "xp_tt",
        "3.9",
        "piston acceleration",
        lambda v: ((v["p1"] - v["p2"]) * v["A_p"] - v["xp"] * v["k"] - v["xp_t"] * v["b"]) / v["m_eff"],
    ),
    Block(8, "xp_t", "-", "piston velocity", lambda v: v["xp_tt"], _DIFFERENCES, rate=True),
    Block(8, "xp", "-", "piston position, chamber 1 grows with it", lambda v: v["xp_t"], _DIFFERENCES, rate=True),
    Block(
        8,
        "p1_t",
        "3.4",
        "pressure gradient, chamber 1",
        lambda v: v["beta"] / (v["V_0"] + v["A_p"] * v["xp"]) * (v["Q1"] - v["A_p"] * v["xp_t"] - v["QL"]),
    ),
    Block(8, "p1", "-", "pressure, chamber 1", lambda v: v["p1_t"], _DIFFERENCES, rate=True),
    Block(
        8,
        "p2_t",
        "3.5",
        "pressure gradient, chamber 2",
        lambda v: v["beta"] / (v["V_0"] - v["A_p"] * v["xp"]) * (v["QL"] + v["A_p"] * v["xp_t"] - v["Q2"]),
    ),
    Block(8, "p2", "-", "pressure, chamber 2", lambda v: v["p2_t"], _DIFFERENCES, rate=True),
    Block(9, "f_r", "3.54", "ripple frequency", lambda v: v["N_p"] * v["omega"] / (4 * np.pi) * (1 + v["N_p"] % 2)),
    Block(9, "A_r", "3.64", "ripple amplitude, with the sign of the flow", lambda v: v["psi"] * v["eta_r"] * v["QBar"]),
    Block(9, "O_r", "3.57", "ripple offset, against A_r", lambda v: -2 / np.pi * v["A_r"]),
    Block(
        9,
        "QBar",
        "3.48",
        "mean flow out of A",
        lambda v: v["omega"] / (2 * np.pi) * v["alpha"] / v["alphaMAX"] * v["V_d_max"],
    ),
    Block(
        9,
        "DQPA",
        "3.53",
        "ripple out of A; A_r stands outside the bars, so that its mean is zero at either sign",
        lambda v: v["A_r"] * np.abs(np.sin(2 * np.pi * v["f_r"] * v["time"])) + v["O_r"],
    ),
    Block(
        10,
        "K",
        "3.3",
        "opening",
        lambda v: v["k1"] * np.abs(v["u"] ** 3) + v["k2"] * v["u"] ** 2 + v["k3"] * np.abs(v["u"]),
    ),
    Block(10, "Q1", "3.1", "flow into chamber 1", lambda v: _orifice(v["K"], _inlet(v), v["rho"]), _SMOOTHED),
    Block(10, "Q2", "3.2", "flow out of chamber 2", lambda v: _orifice(v["K"], _outlet(v), v["rho"]), _SMOOTHED),
    Block(
        10, "QL", "3.6", "leakage from chamber 1 to 2", lambda v: _orifice(v["K_L"], v["p1"] - v["p2"], v["rho"]), 2e-2
    ),
    Block(10, "uCMD", "-", "command that reaches the spool", lambda v: v["delay1"]),
    Block(10, "QActual", "3.65", "flow out of A with ripple", lambda v: v["QBar"] + v["DQPA"]),
    Block(10, "pumpFlow", "3.66", "flow source with both ports: out of A, the negative out of B", None),
)

# What Appendix F shows outside the block: a shaft, two hydraulic ports, a drain, and the command
PORTS: Mapping[str, str] = {
    "shaft": "motoring shaft",
    "port_A": "hydraulic port A",
    "port_B": "hydraulic port B",
    "port_D": "drain",
    "alphaCMD": "swash plate angle command",
}
# Table 5, in SI units
STATIC: Mapping[str, float] = {
    "beta": 1400e6,
    "rho": 875.0,
    "alphaMAX": float(np.deg2rad(15)),
    "pS": 170e5,
    "pT": 0.0,
    "k1": -4.67e-6,
    "k2": 6.6454e-6,
    "k3": 0.967e-6,
}
