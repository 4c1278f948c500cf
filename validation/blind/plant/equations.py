"""The pump by explicit steps of 20 us: Heun's rule for what flows, plain rules for what switches, a ring as dead time.

Written from the thesis' equations and the standard list of effects alone. What the controller card does reaches the
spool only after the dead time, so it is worked out once a step; the spool, the piston and the oil run between.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput
from validation.blind.plant.quantities import STEP, Parameters, Strengths

Array = NDArray[np.float64]

COLUMNS = ("alpha", "u", "x", "v", "p1", "p2", "p_P", "x_s")
"""What is logged: measured angle (rad), spool (1), piston (m, m/s), pressures (Pa), position behind the play (m)."""

_RING = 8192  # steps, 0.16 s: longer than any dead time
_REST_PRESSURE = 0.5  # of the supply pressure, in both chambers
_TURN = 1e-3  # m/s, width of the change of sign of dry friction
_PRELOAD_WIDTH = 0.2e-3  # m
_WIDE_TURN, _WIDE = 10e-3, 1e-3  # m/s and m, of friction and of a preload that are shaped differently
_STOP_STIFFNESS = 4.0  # of a soft stop, over the spool's own spring
_SPOOL_TURN = 0.05  # 1/s
_ATMOSPHERE = 1.013e5  # Pa
_POLYTROPIC = 1.4
_VACUUM = 1e3  # Pa absolute, below which the air's share is no longer raised

try:
    import numba
except ImportError as error:  # for the blind cases alone, so that nobody else installs it
    raise BadInput("the plant of the blind cases needs Numba; python -m pip install numba") from error

inline: Any = numba.njit(inline="always", error_model="numpy")
_compiled: Any = numba.njit(nogil=True, error_model="numpy", cache=True)


@inline
def root(dp: float, rho: float) -> float:
    """Signed speed of a jet, thesis Eq. 3.1."""
    return math.copysign(math.sqrt(2.0 * abs(dp) / rho), dp)


@inline
def blunted(w: float, width: float) -> float:
    """A dead zone without corners: flat at 0, and further out late by its width."""
    return math.copysign(math.sqrt(w * w + width * width) - width, w)


@inline
def _opening(u: float, p: Any, s: Any) -> tuple[float, float]:
    """What the edges see of the spool, and their area, thesis Eq. 3.3."""
    w = u + s.offset__u_n
    w = math.copysign(max(abs(w) - s.deadband__u_0, 0.0), w)
    if s.rounded__u_0 != 0.0:
        w = blunted(w, s.rounded__u_0)
    o = min(abs(w), 1.0)
    area = p.k1 * o * o * o + p.k2 * o * o + p.k3 * o
    if w > 0.0:
        area *= 1.0 + s.uneven__share
    return w, area


@inline
def stiffness(pressure: float, p: Any, s: Any) -> float:
    """Of oil with air in it, Pa."""
    if s.air__eps == 0.0 and s.isothermal__eps == 0.0:
        return p.beta
    absolute = max(pressure + _ATMOSPHERE, _VACUUM)
    if s.isothermal__eps != 0.0:
        return 1.0 / (1.0 / p.beta + s.isothermal__eps * _ATMOSPHERE / (absolute * absolute))
    air = s.air__eps * (_ATMOSPHERE / absolute) ** (1.0 / _POLYTROPIC) / (_POLYTROPIC * absolute)
    return 1.0 / (1.0 / p.beta + air)


@inline
def _force(x: float, v: float, t: float, s: Any) -> float:
    """All that pushes the piston beside thesis Eq. 3.9, N."""
    f = s.bias__F_b
    if s.coulomb__F_c != 0.0:
        f -= s.coulomb__F_c * math.tanh(v / _TURN)
    if s.stribeck__F_s != 0.0 or s.stribeck__F_c != 0.0:
        size = s.stribeck__F_c + (s.stribeck__F_s - s.stribeck__F_c) * math.exp(-abs(v) / s.stribeck__v_s)
        f -= size * math.tanh(v / _TURN)
    f -= s.hardening__k_3 * x * x * x
    if s.preload__F_0 != 0.0:
        f -= s.preload__F_0 * math.tanh(x / _PRELOAD_WIDTH)
    f -= s.progressive__k * x * abs(x)
    if s.arctan__F != 0.0:
        f -= s.arctan__F * 2.0 / math.pi * math.atan(v / _WIDE_TURN)
    if s.wide__F != 0.0:
        f -= s.wide__F * x / math.sqrt(x * x + _WIDE * _WIDE)
    f -= s.quadratic__b_2 * v * abs(v)
    f -= s.one_sided__k_a * max(x, 0.0)
    if s.shaft__F != 0.0:
        f += s.shaft__F * math.sin(2.0 * math.pi * s.shaft__f * t + s.shaft__phase)
    return f


@inline
def play(behind: float, ahead: float, half: float) -> float:
    """Follows what is ahead once the free play is used up."""
    return min(max(behind, ahead - half), ahead + half)


@inline
def flow(
    t: float, command: float, behind: float, state: Any, p: Any, s: Any, shift: float = 0.0, fall: float = 0.0
) -> Any:
    """Rates of change of spool, piston, oil, supply and sensor; `command` is what leaves the dead time.

    Laws from elsewhere may shift the valve's opening, and let the supply pressure fall, Pa.
    """
    u, u_t, x, v, p1, p2, drop, felt, swing, swing_t = state
    supply = p.p_P - fall - drop
    if s.ripple__p != 0.0:
        supply += s.ripple__p * math.sin(2.0 * math.pi * s.ripple__f * t)
    w, area = _opening(u + shift, p, s)
    if w >= 0.0:
        q1 = area * root(supply - p1, p.rho)
        q2 = area * root(p2 - p.p_T, p.rho)
        taken = q1
    else:
        q1 = area * root(p.p_T - p1, p.rho)
        q2 = area * root(p2 - supply, p.rho)
        taken = -q2
    leak = p.K_L * root(p1 - p2, p.rho) + s.laminar__C_l * (p1 - p2)
    if s.worn__C_w != 0.0:
        leak += s.worn__C_w * math.exp(-((x / s.worn__x_w) ** 2)) * (p1 - p2)
    out1 = s.external__C_e * (p1 - p.p_T) + s.orifice__K * root(p1 - p.p_T, p.rho)
    out2 = s.external__C_e * (p2 - p.p_T) + s.orifice__K * root(p2 - p.p_T, p.rho)
    p1_t = stiffness(p1, p, s) / (p.V_0 + p.A_p * x) * (q1 - p.A_p * v - leak - out1)
    p2_t = stiffness(p2, p, s) / (p.V_0 - p.A_p * x) * (leak + p.A_p * v - q2 - out2)
    v_t = ((p1 - p2) * p.A_p - p.k * x - p.b * v + _force(x, v, t, s)) / p.m_eff
    u_tt = p.omega_v * (p.omega_v * (command - u) - 2.0 * p.zeta_v * u_t)
    if s.spool_friction__a_c != 0.0:
        u_tt -= s.spool_friction__a_c * math.tanh(u_t / _SPOOL_TURN)
    over = abs(u) - s.soft__u
    if over > 0.0:
        u_tt -= _STOP_STIFFNESS * p.omega_v**2 * math.copysign(over, u)
    drop_t = (s.droop__R * taken + s.square__R * taken * abs(taken) - drop) / s.droop__T
    angle = math.atan(2.0 * math.tan(p.alpha_max) / p.L * play(behind, x, s.backlash__d))
    felt_t = (angle - felt) / s.lag__T_f if s.lag__T_f != 0.0 else 0.0
    pull = 0.0
    if s.resonance__f != 0.0:
        eigen = 2.0 * math.pi * s.resonance__f
        pull = eigen * (eigen * (angle - swing) - 2.0 * s.resonance__zeta * swing_t)
    elif s.twofold__T != 0.0:
        pull = ((angle - swing) / s.twofold__T - 2.0 * swing_t) / s.twofold__T
    return u_t, u_tt, v, v_t, p1_t, p2_t, drop_t, felt_t, swing_t, pull


@inline
def _moved(state: Any, rates: Any, h: float) -> Any:
    u, u_t, x, v, p1, p2, drop, felt, swing, swing_t = state
    a, b, c, d, e, f, g, i, j, k = rates
    return (
        u + h * a, u_t + h * b, x + h * c, v + h * d, p1 + h * e,
        p2 + h * f, drop + h * g, felt + h * i, swing + h * j, swing_t + h * k,
    )  # fmt: skip


@inline
def _mean(first: Any, second: Any) -> Any:
    a, b, c, d, e, f, g, i, j, k = first
    m, n, o, q, r, t, w, x, y, z = second
    return (
        0.5 * (a + m), 0.5 * (b + n), 0.5 * (c + o), 0.5 * (d + q), 0.5 * (e + r),
        0.5 * (f + t), 0.5 * (g + w), 0.5 * (i + x), 0.5 * (j + y), 0.5 * (k + z),
    )  # fmt: skip


@inline
def _held_back(state: Any, p: Any, s: Any) -> Any:
    """Limits of the spool without wind-up, and the stops of the piston, which take all its speed."""
    u, u_t, x, v, p1, p2, drop, felt, swing, swing_t = state
    u_t = min(max(u_t, -s.rate_limit__r_max), s.rate_limit__r_max)
    if abs(u) >= s.saturation__u_max:
        u = math.copysign(s.saturation__u_max, u)
        u_t = min(u_t, 0.0) if u > 0.0 else max(u_t, 0.0)
    end = 0.5 * p.L
    if abs(x) >= end:
        x = math.copysign(end, x)
        v = min(v, 0.0) if x > 0.0 else max(v, 0.0)
    return u, u_t, x, v, p1, p2, drop, felt, swing, swing_t


@inline
def _from_ring(ring: Array, n: int, delay: float) -> float:
    """What was put into the ring `delay` steps before step n, by a straight line between two steps."""
    whole = math.floor(delay)
    part = delay - whole
    newer, older = n - int(whole), n - int(whole) - 1
    return (1.0 - part) * ring[max(newer, 0) % _RING] + part * ring[max(older, 0) % _RING]


@inline
def _seen(state: Any, speed: float, behind: float, p: Any, s: Any) -> tuple[float, float]:
    """Angle and its rate as the card and the log see them: behind the play, and behind what the sensor does."""
    felt, swing, swing_t = state[7], state[8], state[9]
    scale = 2.0 * math.tan(p.alpha_max) / p.L  # thesis Eq. 3.8 and 3.10
    angle = math.atan(scale * behind)
    if s.lag__T_f != 0.0:
        return felt, (angle - felt) / s.lag__T_f
    if s.resonance__f != 0.0 or s.twofold__T != 0.0:
        return swing, swing_t
    return angle, scale * speed / (1.0 + (scale * behind) ** 2)


@inline
def _wanted(
    level: Array,
    slope: Array,
    every: int,
    n: int,
    angle: float,
    angle_t: float,
    state: Any,
    gain: float,
    p: Any,
    s: Any,
) -> float:
    """What the card asks for at step n: outer P and inner PD, thesis Eq. 3.17 and 3.18."""
    u, u_t = state[0], state[1]
    pitch = every * STEP
    knot = n // every
    z = (n - knot * every) / every
    rise = level[knot + 1] - level[knot]
    m0, m1 = slope[knot] * pitch, slope[knot + 1] * pitch
    c2, c3 = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    e = level[knot] + z * (m0 + z * (c2 + z * c3)) - angle
    e_t = (m0 + z * (2.0 * c2 + z * 3.0 * c3)) / pitch - angle_t
    if s.deadzone__e_0 != 0.0:
        e_t = e_t if abs(e) > s.deadzone__e_0 else 0.0
        e = math.copysign(max(abs(e) - s.deadzone__e_0, 0.0), e)
    if s.blunt__e_0 != 0.0:
        e_t *= abs(e) / math.sqrt(e * e + s.blunt__e_0**2)
        e = blunted(e, s.blunt__e_0)
    return p.K_D * ((gain * e - u) + p.T_d * (gain * e_t - u_t))


@inline
def _followed(behind: float, state: Any, memory: Any, p: Any, s: Any, law: Any) -> tuple[float, float]:
    """Position and speed of the plate's end of the linkage."""
    now = play(behind, state[2], s.backlash__d)
    return now, state[3] if now != behind or s.backlash__d == 0.0 else 0.0


@inline
def _flowing(t: float, command: float, behind: float, state: Any, memory: Any, p: Any, s: Any, law: Any) -> Any:
    return flow(t, command, behind, state, p, s), (0.0, 0.0)


@inline
def march_with(
    level: Array, slope: Array, every: int, first: int, log: int, clock: float, session: float, p: Any, s: Any,
    law: Any, followed: Any, flowing: Any,
) -> Array:  # fmt: skip
    """Run one test from rest in the middle.

    Args:
        level, slope: of the command at its knots (rad, rad/s); a cubic runs between two knots.
        every: steps from knot to knot.
        first: step of the first logged sample.
        log: steps from sample to sample.
        clock: s since the session began.
        session: its length in s, over which drifts run their course.
        p: parameters. s: strengths. law: numbers of what the next two add.
        followed: compiled, (behind, state, memory, p, s, law) -> position and speed of the plate's end of the linkage.
        flowing: compiled, (t, command, behind, state, memory, p, s, law) -> rates of the state, as `flow` gives them,
            and of two memories that begin at 0.
    Returns:
        logged values (n, 8) as COLUMNS says; the steps end at the last knot.
    """
    h = STEP
    steps = (level.size - 1) * every
    logged = np.empty(((steps - first) // log + 1, 8))
    ring = np.zeros(_RING)
    rest = p.p_T + _REST_PRESSURE * (p.p_P - p.p_T)
    state = (0.0, 0.0, 0.0, 0.0, rest, rest, 0.0, 0.0, 0.0, 0.0)
    memory = (0.0, 0.0)
    behind, spool_command, held, due = 0.0, 0.0, 0.0, 0.0
    for n in range(steps + 1):
        t = n * h
        behind, speed = followed(behind, state, memory, p, s, law)
        angle, angle_t = _seen(state, speed, behind, p, s)
        if n >= first and (n - first) % log == 0:
            row = (n - first) // log
            logged[row, 0], logged[row, 1], logged[row, 2], logged[row, 3] = angle, state[0], state[2], state[3]
            logged[row, 4], logged[row, 5], logged[row, 6] = state[4], state[5], p.p_P - state[6]
            logged[row, 7] = behind
        if n == steps:
            break

        # card: sample and hold, play on the command
        age = (clock + t) / session
        if s.sampling__T_s == 0.0 or t >= due - 0.5 * h:
            gain = p.K_p * (1.0 + s.fading__share * age)
            held = _wanted(level, slope, every, n, angle, angle_t, state, gain, p, s)
            due += s.sampling__T_s
        spool_command = play(spool_command, held, s.hysteresis__h)

        # dead time
        ring[n % _RING] = spool_command
        delay = p.tau * (1.0 + s.warming__share * age) / h
        now = _from_ring(ring, n, delay)
        later = _from_ring(ring, n + 1, delay)

        # spool, piston, oil: Heun
        start, kept = flowing(clock + t, now, behind, state, memory, p, s, law)
        ahead = (memory[0] + h * kept[0], memory[1] + h * kept[1])
        reached = _held_back(_moved(state, start, h), p, s)
        end, left = flowing(clock + t + h, later, behind, reached, ahead, p, s, law)
        state = _held_back(_moved(state, _mean(start, end), h), p, s)
        memory = (memory[0] + 0.5 * h * (kept[0] + left[0]), memory[1] + 0.5 * h * (kept[1] + left[1]))
    return logged


@_compiled
def march(
    level: Array, slope: Array, every: int, first: int, log: int, clock: float, session: float, p: Any, s: Any,
    law: Any,
) -> Array:  # fmt: skip
    """The pump as it is; compiled once, for all processes."""
    return march_with(level, slope, every, first, log, clock, session, p, s, law, _followed, _flowing)


def run(
    level: Array,
    slope: Array,
    every: int,
    first: int,
    log: int,
    *,
    parameters: Parameters,
    strengths: Strengths,
    clock: float = 0.0,
    session: float = 1.0,
    plant: Any = None,
    law: Any = (),
) -> Array:
    """`march`, refusing what its rules cannot do.

    Args:
        plant: compiled like `march`, with laws of its own; the pump itself where None.
        law: numbers of these.

    Raises:
        ValueError: a dead time below a step or longer than the ring, or a test that ends before its log begins.
    """
    longest = parameters.tau * (1.0 + abs(strengths.warming__share)) / STEP
    if not 1.0 <= parameters.tau / STEP <= longest < _RING - 2:
        raise ValueError(f"a dead time of {parameters.tau:g} s; from {STEP:g} to {_RING * STEP:g} s is possible")
    if not 0 <= first <= (level.size - 1) * every:
        raise ValueError(f"the log begins at step {first}; the test has {(level.size - 1) * every}")
    return np.asarray(
        (plant or march)(
            np.ascontiguousarray(level),
            np.ascontiguousarray(slope),
            every,
            first,
            log,
            clock,
            session,
            parameters,
            strengths,
            law,
        )
    )
