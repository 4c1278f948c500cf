"""The laws, compiled into the blind plant: what each adds to its rates, its valve's opening and its linkage."""
# ruff: noqa: N815 - the laws' symbols

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from validation.blind.plant.equations import flow, inline, march_with, play, root, stiffness
from validation.blind.plant.quantities import STEP

Array = NDArray[np.float64]

_TURN = 1e-3  # m/s, width of the change of sign of dry friction
_QUICK = 1e-4  # s, in which the valve's edges are taken along once their play is used up
END = 0.985  # of the half stroke, beyond which the cushion acts; no test reaches it


class Laws(NamedTuple):
    """Numbers of all laws at once, SI units; a size of 0 is off."""

    damping__b: float = 0.0  # N.s/m, at 20 mm
    drift__share: float = 0.0  # of the damping, lost in the end
    drift__T: float = 60.0  # s
    supply__r: float = 0.0  # Pa/s
    flow_force__share: float = 0.0  # of the spool's spring at 100 bar over the edge
    pressure_friction__c: float = 0.0  # N/Pa
    notch__share: float = 0.0  # of the opening, lost in the middle
    notch__u: float = 0.03
    bump__F: float = 0.0  # N
    bump__x: float = 4e-3  # m
    bump__w: float = 5e-3  # m
    dahl__F: float = 0.0  # N
    dahl__z: float = 0.5e-3  # m
    lugre__F: float = 0.0  # N, sliding; sticking is 1.6 times that
    lugre__v: float = 5e-3  # m/s
    lugre__z: float = 0.2e-3  # m
    turbulent__K: float = 0.0  # m2, from each chamber to the tank
    compliant__d: float = 0.0  # m, half of the play
    compliant__T: float = 3e-3  # s
    edge_play__h: float = 0.0  # half of the play
    cushion__k: float = 0.0  # N/m


@inline
def _force(t: float, state: Any, z: float, p: Any, law: Any) -> float:
    """On the piston, N; z is the bristle of Dahl's or LuGre's law."""
    x, v, p1, p2 = state[2], state[3], state[4], state[5]
    turn = math.tanh(v / _TURN)
    f = -law.damping__b * (x / 20e-3) ** 2 * v
    f += law.drift__share * p.b * (1.0 - math.exp(-t / law.drift__T)) * v
    f -= law.pressure_friction__c * abs(p1 - p2) * turn
    f -= law.bump__F * math.exp(-(((x - law.bump__x) / law.bump__w) ** 2)) * turn
    end = END * 0.5 * p.L
    if abs(x) > end:
        f -= law.cushion__k * math.copysign(abs(x) - end, x)
    if law.dahl__F != 0.0:
        f -= law.dahl__F * z / law.dahl__z
    if law.lugre__F != 0.0:
        f -= law.lugre__F * (z / law.lugre__z + _LUGRE_DAMPING * _bristle(v, z, law))
    return f


_LUGRE_DAMPING = 2.0  # s/m, of the bristle, over the sliding friction


@inline
def _bristle(v: float, z: float, law: Any) -> float:
    """Its speed, m/s (Dahl 1968; Canudas de Wit, Olsson, Astrom and Lischinsky 1995)."""
    if law.dahl__F != 0.0:
        return v - abs(v) * z / law.dahl__z
    if law.lugre__F != 0.0:
        size = 1.0 + 0.6 * math.exp(-((v / law.lugre__v) ** 2))
        return v - abs(v) * z / (law.lugre__z * size)
    return 0.0


@inline
def _flowing(t: float, command: float, behind: float, state: Any, memory: Any, p: Any, s: Any, law: Any) -> Any:
    """Rates of the pump with the laws, and of bristle and valve's edges."""
    u, x, p1, p2 = state[0], state[2], state[4], state[5]
    z, edge = memory
    opening = edge if law.edge_play__h != 0.0 else u
    opening -= law.notch__share * u * math.exp(-((u / law.notch__u) ** 2))
    fall = law.supply__r * t
    a, b, c, d, e, f, g, i, j, k = flow(t, command, behind, state, p, s, opening - u, fall)
    over = p.p_P - fall - (p1 if u > 0.0 else p2)
    b -= law.flow_force__share * p.omega_v**2 * u * over / 1e7
    d += _force(t, state, z, p, law) / p.m_eff
    if law.turbulent__K != 0.0:
        e -= stiffness(p1, p, s) / (p.V_0 + p.A_p * x) * law.turbulent__K * root(p1 - p.p_T, p.rho)
        f -= stiffness(p2, p, s) / (p.V_0 - p.A_p * x) * law.turbulent__K * root(p2 - p.p_T, p.rho)
    taken = (play(edge, u, law.edge_play__h) - edge) / _QUICK
    return (a, b, c, d, e, f, g, i, j, k), (_bristle(state[3], z, law), taken)


@inline
def _followed(behind: float, state: Any, memory: Any, p: Any, s: Any, law: Any) -> tuple[float, float]:
    """The plate's end of the linkage: a play whose contact gives way."""
    if law.compliant__d == 0.0:
        return state[2], state[3]
    speed = (play(behind, state[2], law.compliant__d) - behind) / law.compliant__T
    return behind + STEP * speed, speed


@numba.njit(nogil=True, error_model="numpy")
def plant(
    level: Array, slope: Array, every: int, first: int, log: int, clock: float, session: float, p: Any, s: Any,
    law: Any,
) -> Array:  # fmt: skip
    """`march` of the blind plant with the laws; not kept on disk, since it would not notice changes over there."""
    return march_with(level, slope, every, first, log, clock, session, p, s, law, _followed, _flowing)
