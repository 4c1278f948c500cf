"""Each law of the blind plant against a closed form: at rest, with a blocked piston, or on its own."""

import cmath
import math
from collections.abc import Callable

import numpy as np
import pytest

from validation.blind.plant import equations
from validation.blind.plant.equations import COLUMNS, run
from validation.blind.plant.quantities import STEP, Parameters, Strengths

BASE = Parameters()
OFF = Strengths()
BLOCKED = BASE._replace(k1=0.0, k2=0.0, k3=0.0, K_L=0.0)  # no flow: the piston stays in the middle


def held(percent: float, strengths: Strengths = OFF, parameters: Parameters = BASE) -> dict[str, float]:
    """What is logged after the plate has come to rest at a command."""
    knots = 250001  # 10 s: the level of the two pressures settles slowly
    level = np.radians(0.15 * percent) * np.clip(np.arange(knots) * 2 * STEP / 0.5, 0, 1)
    slope = np.where(level < level[-1], np.radians(0.15 * percent) / 0.5, 0.0) if percent > 0 else np.gradient(level)
    last = run(level, slope, 2, (knots - 1) * 2, 1, parameters=parameters, strengths=strengths)[-1]
    return dict(zip(COLUMNS, last, strict=True))


def swung(
    f: float,
    strengths: Strengths = OFF,
    parameters: Parameters = BLOCKED,
    amplitude: float = 0.01,
    **session: float,
) -> dict[str, complex]:
    """Complex amplitudes of all that is logged, for a command of amplitude 1, over the last two periods."""
    periods, steps = 6, round(1 / f / STEP / 10) * 10
    t = np.arange(0, periods * steps + 1, 10) * STEP
    w = 2 * math.pi / (steps * STEP)
    logged = run(
        amplitude * np.sin(w * t), amplitude * w * np.cos(w * t), 10, (periods - 2) * steps, 1,
        parameters=parameters, strengths=strengths, **session,
    )[:-1]  # fmt: skip
    phase = np.exp(-1j * w * (np.arange(len(logged)) + (periods - 2) * steps) * STEP)
    amplitudes = 2j * (logged * phase[:, None]).mean(axis=0) / amplitude
    return dict(zip(COLUMNS, amplitudes, strict=True))


def inner_loop(f: float, p: Parameters, delay: float) -> complex:
    """Thesis Eq. 3.20."""
    s = 2j * math.pi * f
    late = cmath.exp(-s * delay)
    above = late * p.K_p * p.omega_v**2 * (p.K_D * p.T_d * s + p.K_D)
    return above / (
        s**2 + (2 * p.zeta_v * p.omega_v + p.K_D * p.T_d * p.omega_v**2 * late) * s + (1 + p.K_D * late) * p.omega_v**2
    )


def jet(dp: float) -> float:
    return math.copysign(math.sqrt(2 * abs(dp) / BASE.rho), dp)


def area(u: float) -> float:
    return BASE.k1 * abs(u) ** 3 + BASE.k2 * u**2 + BASE.k3 * abs(u)


@pytest.mark.parametrize("f", [2.0, 12.5, 25.0])
def test_the_spool_follows_the_inner_loop_with_a_true_dead_time(f: float) -> None:
    assert swung(f)["u"] == pytest.approx(inner_loop(f, BLOCKED, BLOCKED.tau), rel=2e-4)


def test_a_dead_time_that_is_no_multiple_of_a_step_is_met() -> None:
    p = BLOCKED._replace(tau=0.003837)
    assert swung(25.0, parameters=p)["u"] == pytest.approx(inner_loop(25.0, p, 0.003837), rel=2e-4)


def test_rest_obeys_flow_and_force_balance() -> None:
    at = held(50.0)
    assert (at["p1"] - at["p2"]) * BASE.A_p == pytest.approx(BASE.k * at["x"], rel=1e-6)
    leak = BASE.K_L * jet(at["p1"] - at["p2"])
    assert area(at["u"]) * jet(BASE.p_P - at["p1"]) == pytest.approx(leak, rel=1e-4)
    assert area(at["u"]) * jet(at["p2"]) == pytest.approx(leak, rel=1e-4)
    error = math.radians(7.5) - at["alpha"]
    spring = at["u"] * (1 + BASE.K_D) / BASE.K_D / BASE.K_p  # the inner loop's gain at rest
    assert error == pytest.approx(spring, rel=1e-4)
    assert at["alpha"] == pytest.approx(math.atan(at["x"] * 2 * math.tan(math.radians(15)) / BASE.L))


@pytest.mark.parametrize(
    ("strengths", "force"),
    [
        (Strengths(bias__F_b=-65.0), lambda x: -65.0),
        (Strengths(hardening__k_3=2.4e7), lambda x: -2.4e7 * x**3),
        (Strengths(preload__F_0=90.0), lambda x: -90.0 * math.tanh(x / 0.2e-3)),
        (Strengths(one_sided__k_a=5e3), lambda x: -5e3 * max(x, 0.0)),
        (Strengths(coulomb__F_c=80.0), lambda x: 0.0),
        (Strengths(arctan__F=80.0), lambda x: 0.0),
        (Strengths(progressive__k=5e5), lambda x: -5e5 * x * abs(x)),
        (Strengths(wide__F=90.0), lambda x: -90.0 * x / math.hypot(x, 1e-3)),
    ],
)
@pytest.mark.parametrize("percent", [50.0, -30.0])
def test_forces_at_rest(strengths: Strengths, force: Callable[[float], float], percent: float) -> None:
    at = held(percent, strengths)
    assert (at["p1"] - at["p2"]) * BASE.A_p - BASE.k * at["x"] == pytest.approx(-force(at["x"]), abs=0.1)


@pytest.mark.parametrize("v", [-0.2, -4e-4, 0.0, 3e-3, 0.1])
def test_forces_in_motion(v: float) -> None:
    def force(**on: float) -> float:
        return float(equations._force.py_func(0.01, v, 0.25, Strengths(**on)))

    turn = math.tanh(v * 1000)
    assert force(coulomb__F_c=80.0) == pytest.approx(-80 * turn)
    stribeck = force(stribeck__F_c=60.0, stribeck__F_s=100.0, stribeck__v_s=5e-3)
    assert stribeck == pytest.approx(-turn * (60 + 40 * math.exp(-abs(v) / 5e-3)))
    assert force(arctan__F=80.0) == pytest.approx(-80 * math.atan2(v, 10e-3) * 2 / math.pi)
    assert force(quadratic__b_2=3e4) == pytest.approx(-3e4 * v * abs(v))
    assert force(shaft__F=150.0, shaft__f=2.0, shaft__phase=0.3) == pytest.approx(150 * math.sin(math.pi + 0.3))


def test_offset_acts_on_the_edges_before_the_dead_band() -> None:
    opening = equations._opening.py_func
    for u in (-0.3, -0.01, 0.004, 0.2):
        w, k = opening(u, BASE, Strengths(offset__u_n=0.012, deadband__u_0=0.016))
        shifted = u + 0.012
        assert w == pytest.approx(math.copysign(max(abs(shifted) - 0.016, 0.0), shifted))
        assert k == pytest.approx(area(w))
    for u in (-0.3, 0.01, 0.2):
        w, k = opening(u, BASE, Strengths(rounded__u_0=0.02))
        assert (abs(w) + 0.02) ** 2 - 0.02**2 == pytest.approx(u**2)
        assert w * u > 0
        assert k == pytest.approx(area(w))
    assert opening(0.3, BASE, Strengths(uneven__share=0.2))[1] == pytest.approx(1.2 * area(0.3))
    assert opening(-0.3, BASE, Strengths(uneven__share=0.2))[1] == pytest.approx(area(0.3))
    assert opening(1.4, BASE, Strengths())[1] == pytest.approx(area(1.0))


def test_the_spool_sensor_does_not_see_the_offset() -> None:
    assert held(50.0, Strengths(offset__u_n=0.012))["u"] == pytest.approx(held(50.0)["u"] - 0.012, abs=3e-4)


def test_air_softens_oil_as_its_volume_says() -> None:
    p, h = 30e5, 10.0

    def volume(absolute: float) -> float:  # of a unit of oil with 2 percent of air at 1.013 bar, polytropic
        return -absolute / BASE.beta + 0.02 * (1.013e5 / absolute) ** (1 / 1.4)

    softness = -(volume(p + 1.013e5 + h) - volume(p + 1.013e5 - h)) / (2 * h)
    assert equations.stiffness.py_func(p, BASE, Strengths(air__eps=0.02)) == pytest.approx(1 / softness, rel=1e-6)
    slow = 1 / BASE.beta + 0.02 * 1.013e5 / (p + 1.013e5) ** 2  # at constant temperature the volume goes with 1/p
    assert equations.stiffness.py_func(p, BASE, Strengths(isothermal__eps=0.02)) == pytest.approx(1 / slow)


@pytest.mark.parametrize("name", ["laminar__C_l", "external__C_e"])
def test_leakage_is_what_the_valve_delivers_at_rest(name: str) -> None:
    at = held(50.0, Strengths(**{name: 1e-12}))
    leak = BASE.K_L * jet(at["p1"] - at["p2"])
    across, out_1, out_2 = (1e-12 * (at["p1"] - at["p2"]), 0, 0) if name[0] == "l" else (0, at["p1"], -at["p2"])
    assert area(at["u"]) * jet(BASE.p_P - at["p1"]) == pytest.approx(leak + across + 1e-12 * out_1, rel=1e-3)
    assert area(at["u"]) * jet(at["p2"]) == pytest.approx(leak + across + 1e-12 * out_2, rel=1e-3)


def test_an_orifice_to_the_tank_is_what_the_valve_delivers_at_rest() -> None:
    at = held(50.0, Strengths(orifice__K=2e-9))
    leak = BASE.K_L * jet(at["p1"] - at["p2"])
    assert area(at["u"]) * jet(BASE.p_P - at["p1"]) == pytest.approx(leak + 2e-9 * jet(at["p1"]), rel=1e-3)
    assert area(at["u"]) * jet(at["p2"]) == pytest.approx(leak - 2e-9 * jet(at["p2"]), rel=1e-3)


def test_a_supply_may_droop_with_the_square_of_its_flow() -> None:
    at = held(50.0, Strengths(square__R=1e16, laminar__C_l=1e-11))
    flow = area(at["u"]) * jet(at["p_P"] - at["p1"])
    assert at["p_P"] == pytest.approx(BASE.p_P - 1e16 * flow**2, rel=1e-5)


def test_supply_droops_by_resistance_times_flow() -> None:
    at = held(50.0, Strengths(droop__R=5e10, droop__T=0.01, laminar__C_l=1e-11))
    flow = area(at["u"]) * jet(at["p_P"] - at["p1"])
    assert flow > 4e-6
    assert at["p_P"] == pytest.approx(BASE.p_P - 5e10 * flow, rel=1e-5)
    other = held(-50.0, Strengths(droop__R=5e10, droop__T=0.01, laminar__C_l=1e-11))
    assert other["p_P"] == pytest.approx(at["p_P"], rel=1e-6)


@pytest.mark.parametrize("f", [5.0, 25.0])
def test_a_lag_and_a_resonance_stand_between_plate_and_log(f: float) -> None:
    w = 2 * math.pi * f
    for strengths, expected in (
        (Strengths(lag__T_f=2e-3), 1 / (1 + 2e-3j * w)),
        (Strengths(twofold__T=2e-3), 1 / (1 + 2e-3j * w) ** 2),
        (Strengths(resonance__f=60.0, resonance__zeta=0.2), 1 / (1 - (f / 60) ** 2 + 0.4j * f / 60)),
    ):
        found = swung(f, strengths, BASE)
        plate = found["x"] * 2 * math.tan(math.radians(15)) / BASE.L  # small angles
        assert found["alpha"] / plate == pytest.approx(expected, rel=2e-3)


def test_sampling_delays_by_half_its_interval_and_one_step_is_off() -> None:
    f, interval = 2.0, 1e-3
    late = swung(f, Strengths(sampling__T_s=interval))["u"]
    assert late == pytest.approx(inner_loop(f, BLOCKED, BLOCKED.tau + interval / 2), rel=2e-4)
    assert swung(f, Strengths(sampling__T_s=STEP))["u"] == pytest.approx(swung(f)["u"], rel=1e-9)


def test_error_deadzone_leaves_a_standing_error() -> None:
    plain, dull = held(50.0), held(50.0, Strengths(deadzone__e_0=1e-3))
    assert dull["alpha"] == pytest.approx(plain["alpha"] - 1e-3, rel=1e-4)
    blunt, left = held(50.0, Strengths(blunt__e_0=1e-3)), math.radians(7.5) - plain["alpha"]
    wanted = math.sqrt((left + 1e-3) ** 2 - 1e-3**2)  # whose blunted error is the plain one's
    assert math.radians(7.5) - blunt["alpha"] == pytest.approx(wanted, rel=2e-3)


@pytest.mark.parametrize("share", [0.5, 1.0])
def test_drifts_follow_the_clock_of_the_session(share: float) -> None:
    session = 1e5
    moved = swung(12.5, Strengths(warming__share=0.3, fading__share=-0.2), clock=share * session, session=session)
    later = BLOCKED._replace(K_p=BLOCKED.K_p * (1 - 0.2 * share))
    assert moved["u"] == pytest.approx(inner_loop(12.5, later, BLOCKED.tau * (1 + 0.3 * share)), rel=1e-3)


def _wave(strengths: Strengths, f: float = 10.0, parameters: Parameters = BASE) -> np.ndarray:
    t = np.arange(0, 1, 10 * STEP)
    w, size = 2 * math.pi * f, math.radians(3)
    return run(size * np.sin(w * t), size * w * np.cos(w * t), 10, 0, 1, parameters=parameters, strengths=strengths)


def test_spool_limits_hold_and_do_not_wind_up() -> None:
    free = _wave(Strengths())
    speed = np.abs(np.diff(free[:, 1])).max() / STEP
    stopped = _wave(Strengths(saturation__u_max=0.1))[:, 1]
    assert np.abs(free[:, 1]).max() > 0.2
    assert np.abs(stopped).max() == 0.1
    slow = np.diff(_wave(Strengths(rate_limit__r_max=speed / 3))[:, 1]) / STEP
    assert np.abs(slow).max() == pytest.approx(speed / 3, rel=1e-6)
    leaving = np.flatnonzero((np.abs(stopped[:-1]) == 0.1) & (np.abs(stopped[1:]) < 0.1))
    assert leaving.size > 5
    soft = np.abs(_wave(Strengths(soft__u=0.1))[:, 1]).max()
    assert 0.1 < soft < 0.1 + (np.abs(free[:, 1]).max() - 0.1) / 3
    state = (0.1, 5.0, 0.0, 0.0, 1e6, 1e6, 0.0, 0.0, 0.0, 0.0)
    assert equations._held_back.py_func(state, BASE, Strengths(saturation__u_max=0.1))[1] == 0.0


def test_play_keeps_within_its_width_and_waits_at_reversals() -> None:
    play, ahead = equations.play.py_func, np.sin(np.linspace(0, 12, 4000))
    behind = np.empty_like(ahead)
    at = 0.0
    for n, value in enumerate(ahead):
        at = behind[n] = play(at, value, 0.2)
    assert np.abs(behind - ahead).max() == pytest.approx(0.2)
    assert behind.max() == pytest.approx(0.8, abs=1e-5)
    logged = _wave(Strengths(backlash__d=0.1e-3), f=2.0)
    x, x_s = logged[:, 2], logged[:, 7]
    assert np.abs(x - x_s).max() == pytest.approx(0.1e-3, rel=1e-9)
    assert np.mean(np.diff(x_s) == 0.0) > 0.02
    assert logged[:, 0] == pytest.approx(np.arctan(x_s * 2 * math.tan(math.radians(15)) / BASE.L))


def test_hysteresis_takes_its_half_width_off_the_spool_command() -> None:
    f, h = 0.5, 1e-3
    t = np.arange(0, 4, 50 * STEP)
    w, size = 2 * math.pi * f, 2e-3
    logged = run(
        size * np.sin(w * t), size * w * np.cos(w * t), 50, 0, 1,
        parameters=BLOCKED, strengths=Strengths(hysteresis__h=h),
    )  # fmt: skip
    # slowly: u follows its command c = K_D (K_p e - u) less h, so that its peak is (K_D K_p size - h)/(1 + K_D)
    peak = (BASE.K_D * BASE.K_p * size - h) / (1 + BASE.K_D)
    assert np.abs(logged[60000:, 1]).max() == pytest.approx(peak, rel=2e-2)
    assert abs(peak * (1 + BASE.K_D) - BASE.K_D * BASE.K_p * size) > 0.04 * peak


def test_the_piston_stops_dead_at_its_end() -> None:
    at = held(130.0)
    assert at["x"] == BASE.L / 2
    assert at["v"] == 0.0


@pytest.fixture
def uncompiled(monkeypatch: pytest.MonkeyPatch) -> None:
    """The laws as plain Python: to compile them for a few values takes seconds."""
    for name, law in list(vars(equations).items()):
        if hasattr(law, "py_func"):
            monkeypatch.setattr(equations, name, law.py_func)


def test_supply_ripple_worn_seal_and_spool_friction_enter_their_balances(uncompiled: None) -> None:
    state = (0.3, 2.0, 4e-3, 0.0, 80e5, 60e5, 0.0, 0.0, 0.0, 0.0)
    plain = equations.flow(0.0, 0.0, 0.0, state, BASE, Strengths())
    quarter = 1 / (4 * 11.3)
    raised = equations.flow(quarter, 0.0, 0.0, state, BASE, Strengths(ripple__p=5e5, ripple__f=11.3))
    assert raised == pytest.approx(equations.flow(0.0, 0.0, 0.0, state, BASE._replace(p_P=175e5), Strengths()))
    worn = equations.flow(0.0, 0.0, 0.0, state, BASE, Strengths(worn__C_w=1e-12, worn__x_w=4e-3))
    lost = 1e-12 / math.e * 20e5 * BASE.beta
    assert plain[4] - worn[4] == pytest.approx(lost / (BASE.V_0 + BASE.A_p * 4e-3))
    assert worn[5] - plain[5] == pytest.approx(lost / (BASE.V_0 - BASE.A_p * 4e-3))
    rubbing = equations.flow(0.0, 0.0, 0.0, state, BASE, Strengths(spool_friction__a_c=300.0))
    assert plain[1] - rubbing[1] == pytest.approx(300 * math.tanh(2.0 / 0.05))


@pytest.mark.parametrize("tau", [1e-6, 0.2])
def test_a_dead_time_beyond_the_rules_is_refused(tau: float) -> None:
    with pytest.raises(ValueError, match="dead time"):
        run(np.zeros(10), np.zeros(10), 1, 0, 1, parameters=BASE._replace(tau=tau), strengths=Strengths())


def test_a_log_after_the_end_is_refused() -> None:
    with pytest.raises(ValueError, match="begins at step 10"):
        run(np.zeros(10), np.zeros(10), 1, 10, 1, parameters=BASE, strengths=Strengths())
