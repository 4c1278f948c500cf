"""Every effect of the catalogue: off it is the base model to the last bit, on it does what its equation says.

All effects that can be off exactly stand in one pump together, so that they are also seen not to disturb each other.
The equations are written down here a second time.
"""

from collections.abc import Iterator, Mapping

import numpy as np
import pytest

from pysim.diagnosis.candidate import searched
from pysim.effects import makes_events, variant
from pysim.io import read_model
from pysim.simulate import simulate
from pysim.types import Experiment, Signal
from tests.modelica.built import FINE
from tests.modelica.effects import (
    BASE,
    BYPASSED,
    CATALOGUE,
    EXACT,
    TIGHT,
    RightHandSide,
    built_variant,
    model,
    pump,
    ran,
    settings,
    states,
)
from tests.modelica.library import LIBRARY
from tests.modelica.test_slots import ALPHA_MAX, BETA, PARAMETERS

STANDARD = {  # effects.md: name -> (slot, strengths)
    "friction.coulomb": ("pistonForce", {"F_c"}),
    "friction.stribeck": ("pistonForce", {"F_c", "F_s"}),
    "spring.hardening": ("pistonForce", {"k_3"}),
    "spring.preload": ("pistonForce", {"F_0"}),
    "swash.bias": ("pistonForce", {"F_b"}),
    "linkage.backlash": ("linkage", {"d"}),
    "valve.deadband": ("spoolOpening", {"u_0"}),
    "valve.offset": ("spoolOpening", {"u_n"}),
    "valve.saturation": ("spool", {"inverse_u_max"}),
    "valve.rate_limit": ("spool", {"inverse_r_max"}),
    "valve.hysteresis": ("spoolCommand", {"h"}),
    "oil.air": ("oil", {"eps"}),
    "supply.droop": ("supply", {"R"}),
    "leakage.laminar": ("internalLeakage", {"C_l"}),
    "leakage.external": ("externalLeakage", {"C_e"}),
    "sensor.lag": ("angleSensor", {"T_f"}),
    "card.sampling": ("cardOutput", {"T_s"}),
    "card.error_deadzone": ("angleError", {"e_0"}),
}
M_EFF, A_P, V_0, K_P = (PARAMETERS[name] for name in ("m_eff", "A_p", "V_0", "K_p"))


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RightHandSide]:
    with RightHandSide((), tmp_path_factory.mktemp("base")) as side:
        yield side


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RightHandSide]:
    with RightHandSide(EXACT, tmp_path_factory.mktemp("full")) as side:
        yield side


def but_for(values: Mapping[str, Mapping[str, float]]) -> dict[str, dict[str, float]]:
    """Strengths of all effects that can be off exactly: those given, and all others off."""
    off = {name: {p.name: float(p.off or 0) for p in CATALOGUE[name].strengths} for name in EXACT}
    return off | {name: {**off[name], **given} for name, given in values.items()}


def on(**values: dict[str, float]) -> dict[str, float]:
    """FMU settings of the full pump with those effects on and all others off; two underscores for the dot."""
    return settings(EXACT, but_for({key.replace("__", "."): given for key, given in values.items()}))


def pairs_of_states(count: int = 12) -> Iterator[dict[str, float]]:
    rng = np.random.default_rng(11)
    return (states(rng) for _ in range(count))


def test_the_catalogue_is_the_standard_list() -> None:
    found = {e.name: (e.slot, {p.name for p in e.strengths}) for e in CATALOGUE.values()}
    assert found == STANDARD
    assert set(BYPASSED) == {"sensor.lag", "card.sampling"}


def test_play_that_is_off_is_off_from_any_start() -> None:
    """Off the middle the linkage begins where the piston does."""
    times = np.linspace(0, 0.5, 51)
    found = []
    for names, off in (((), {}), (EXACT, on())):
        run = Experiment(times, ("alphaPercent",), overrides={"piston.x": 5e-3, **off})
        found.append(simulate(model(names), run, solver=FINE)["alphaPercent"])
    assert found[0][0] > 10
    assert np.allclose(found[1], found[0], rtol=0, atol=1e-5)


def test_what_a_search_builds_together_is_the_base_model_while_it_is_off() -> None:
    """A law that only comes close to off, such as a short lag, is beside other effects no longer what a fit absorbs."""
    laws = [law for law in map(searched, CATALOGUE.values()) if not (law.bypass or makes_events(law))]
    made = variant(BASE, laws, [LIBRARY], name="Variant")
    off = {made.parameter(law.name, p.name): float(p.off or 0) for law in laws for p in law.strengths}
    times = np.arange(0.0, 1.5, 1e-3)
    knots = np.arange(0.0, 1.51, 0.005)
    command = Signal.through(knots, (1 - np.exp(-knots / 0.1)) * (15 + 35 * np.sin(2 * np.pi * 6 * knots)))
    found = []
    for built, values in ((model(()), {}), (read_model(built_variant(made)), off)):
        run = Experiment(times, ("alphaPercent",), {"alphaCMD": command}, values, rates={"alphaCMD_t": "alphaCMD"})
        found.append(simulate(built, run, solver=TIGHT)["alphaPercent"])
    assert np.ptp(found[0]) > 20
    assert np.allclose(found[1], found[0], rtol=0, atol=1e-4)  # percent; a lag of 50 us would be 0.06


@pytest.mark.slow
@pytest.mark.parametrize("name", CATALOGUE)
def test_each_effect_alone_builds_and_keeps_its_bounds(name: str) -> None:
    built = read_model(pump((name,))[1])
    for parameter in CATALOGUE[name].parameters:
        variable = built[f"{CATALOGUE[name].slot}.{parameter.name}"]
        assert (variable.causality, variable.unit) == ("parameter", parameter.unit)
        assert (variable.start, variable.min, variable.max, variable.nominal) == pytest.approx(
            (parameter.default, parameter.min, parameter.max, parameter.nominal)
        )


def test_off_is_the_base_model_bit_for_bit(base: RightHandSide, full: RightHandSide) -> None:
    for state in pairs_of_states(40):
        expected, found = base.at(state), full.at(state, on())
        assert {name: found[name] for name in expected} == expected
        for name in ("alphaPercent", "u", "P_Cont", "QL", "xp_tt", "alpha_tt"):
            assert full[name] == base[name], name


@pytest.mark.parametrize(
    ("effect", "values", "force"),
    [
        ("friction__coulomb", {"F_c": 80.0}, lambda x, v: -80 * np.tanh(v / 1e-3)),
        (
            "friction__stribeck",
            {"F_c": 50.0, "F_s": 120.0, "v_s": 8e-3},
            lambda x, v: -np.tanh(v / 1e-3) * (50 + 70 * np.exp(-abs(v) / 8e-3)),
        ),
        ("friction__stribeck", {"F_c": 80.0, "F_s": 20.0, "v_s": 8e-3}, lambda x, v: -80 * np.tanh(v / 1e-3)),
        ("spring__hardening", {"k_3": 3e7}, lambda x, v: -3e7 * x**3),
        ("spring__preload", {"F_0": 90.0}, lambda x, v: -90 * np.tanh(x / 0.2e-3)),
        ("swash__bias", {"F_b": -65.0}, lambda x, v: -65.0),
    ],
)
def test_forces_join_the_balance(base: RightHandSide, full: RightHandSide, effect, values, force) -> None:  # type: ignore[no-untyped-def]
    for state in pairs_of_states():
        state["piston.v"] *= 0.05  # where friction changes with speed
        change = full.at(state, on(**{effect: values}))["piston.v"] - base.at(state)["piston.v"]
        assert change * M_EFF == pytest.approx(force(state["piston.x"], state["piston.v"]), rel=1e-7, abs=1e-6)


@pytest.mark.parametrize(
    ("effect", "values", "opening"),
    [
        ("valve__deadband", {"u_0": 0.03}, lambda u: np.sign(u) * max(abs(u) - 0.03, 0)),
        ("valve__offset", {"u_n": -0.02}, lambda u: u - 0.02),
    ],
)
def test_edges_see_another_opening_than_the_sensor(
    base: RightHandSide, full: RightHandSide, effect, values, opening
) -> None:  # type: ignore[no-untyped-def]
    for state in pairs_of_states():
        state["spool.u"] *= 0.2
        found = full.at(state, on(**{effect: values}))
        assert full["u"] == state["spool.u"]
        assert found["spool.u_t"] == base.at(state)["spool.u_t"]
        expected = base.at({**state, "spool.u": float(opening(state["spool.u"]))})
        for chamber in ("chamber1.p", "chamber2.p"):
            assert found[chamber] == pytest.approx(expected[chamber], rel=1e-12, abs=1e-3)


def test_air_makes_the_oil_softer(base: RightHandSide, full: RightHandSide) -> None:
    for state in pairs_of_states():
        found, plain = full.at(state, on(oil__air={"eps": 0.02})), base.at(state)
        for chamber in ("chamber1.p", "chamber2.p"):
            p = state[chamber] + 1.013e5
            kappa = 0.02 * (1.013e5 / p) ** (1 / 1.4) / (1.4 * p)
            assert found[chamber] * (1 / BETA + kappa) == pytest.approx(plain[chamber] / BETA, rel=1e-9)


def test_supply_falls_with_the_flow_it_gives(base: RightHandSide, full: RightHandSide) -> None:
    for state in pairs_of_states():
        found = full.at({**state, "supply.dp": 8e5}, on(supply__droop={"R": 3e10, "T": 0.01}))
        delivered = full["Q1"] if state["spool.u"] >= 0 else -full["Q2"]
        assert found["supply.dp"] == pytest.approx((3e10 * delivered - 8e5) / 0.01, rel=1e-9)
        lower = base.at(state, {"pS": 162e5})
        base.instance.set_in_event_mode({"pS": 170e5})
        for chamber in ("chamber1.p", "chamber2.p"):
            assert found[chamber] == pytest.approx(lower[chamber], rel=1e-10)


@pytest.mark.parametrize(
    ("effect", "values", "flows"),
    [
        ("leakage__laminar", {"C_l": 2e-12}, lambda p1, p2: (-2e-12 * (p1 - p2), 2e-12 * (p1 - p2))),
        ("leakage__external", {"C_e": 3e-12}, lambda p1, p2: (-3e-12 * p1, -3e-12 * p2)),
    ],
)
def test_leakage_leaves_the_chambers(base: RightHandSide, full: RightHandSide, effect, values, flows) -> None:  # type: ignore[no-untyped-def]
    for state in pairs_of_states():
        found, plain = full.at(state, on(**{effect: values})), base.at(state)
        expected = flows(state["chamber1.p"], state["chamber2.p"])
        for chamber, sign, flow in (("chamber1.p", 1, expected[0]), ("chamber2.p", -1, expected[1])):
            volume = V_0 + sign * A_P * state["piston.x"]
            # the floor of the volume, 0.1 cm3, adds a share of 1e-5 at most
            change = found[chamber] - plain[chamber]
            assert change == pytest.approx(BETA / volume * flow, rel=2e-5, abs=1e-7 * abs(plain[chamber]))


def test_error_dead_zone_takes_value_and_rate(base: RightHandSide, full: RightHandSide) -> None:
    inside = 0
    for state in pairs_of_states(40):
        state["piston.x"] *= 0.02
        base.at(state)
        error, slope = base["P_Cont"] / K_P, base["PD_Der"]
        full.at(state, on(card__error_deadzone={"e_0": 2e-3}))
        expected = np.sign(error) * max(abs(error) - 2e-3, 0)
        assert full["P_Cont"] == pytest.approx(K_P * expected, abs=1e-12)
        if expected == 0:
            inside += 1
            gain = PARAMETERS["K_D"] * PARAMETERS["T_d"]
            assert full["PD_Der"] == pytest.approx(-gain * state["spool.u_t"], rel=1e-9, abs=1e-12)
        else:
            assert full["PD_Der"] == pytest.approx(slope, rel=1e-9)
    assert 5 < inside < 35


def play(s: np.ndarray, half: float) -> np.ndarray:
    """What follows s behind a play, sample by sample."""
    y = np.zeros(s.size)
    for k in range(1, s.size):
        y[k] = min(max(y[k - 1], s[k] - half), s[k] + half)
    return y


def test_backlash_is_play_between_piston_and_angle() -> None:
    d = 2e-4
    record = ran(EXACT, but_for({"linkage.backlash": {"d": d}}), ("xp", "linkage.y", "alpha"), step=2e-4)
    # between samples the piston turns back by less than a (1e-4 s)^2 / 2 = 1e-7 m
    assert np.abs(record["linkage.y"] - play(record["xp"], d)).max() < 3e-7
    assert np.abs(record["linkage.y"] - record["xp"]).max() == pytest.approx(d, rel=1e-2)
    a = PARAMETERS["L"] / (2 * np.tan(ALPHA_MAX))
    np.testing.assert_allclose(record["alpha"], np.arctan(record["linkage.y"] / a), atol=1e-12)


def test_spool_stops_and_comes_back_without_wind_up() -> None:
    limit = 0.05
    names = ("spool.u", "spool.u_t", "spool.u_ref")
    record = ran(EXACT, but_for({"valve.saturation": {"inverse_u_max": 1 / limit}}), names)
    u = record["spool.u"]
    assert np.abs(ran((), {}, ("spool.u",))["spool.u"]).max() > 1.5 * limit
    assert np.abs(u).max() < limit * (1 + 1e-6)
    stopped = np.abs(u) > limit * (1 - 1e-6)
    assert stopped.mean() > 0.05
    assert np.abs(record["spool.u_t"][stopped]).max() < 2.0  # but for samples right at a stop, it stands
    # off the stop as soon as the command asks for less than the stop
    pushed = record["spool.u_ref"][stopped] * np.sign(u[stopped])
    assert np.quantile(pushed, 0.02) > limit * 0.9


def test_spool_is_no_faster_than_its_limit() -> None:
    limit, (omega_v, zeta_v) = 1.0, (PARAMETERS["omega_v"], PARAMETERS["zeta_v"])
    names = ("spool.u", "spool.u_t", "spool.u_ref", "spool.u_tt")
    record = ran(EXACT, but_for({"valve.rate_limit": {"inverse_r_max": 1 / limit}}), names)
    assert np.abs(ran((), {}, ("spool.u_t",))["spool.u_t"]).max() > 1.5 * limit
    assert np.abs(record["spool.u_t"]).max() < limit * (1 + 1e-6)
    held = np.abs(record["spool.u_t"]) > limit * (1 - 1e-9)
    assert held.mean() > 0.02
    free = omega_v**2 * (record["spool.u_ref"] - record["spool.u"]) - 2 * zeta_v * omega_v * record["spool.u_t"]
    # the limit is come to with the lag of 1e-4 s: so much earlier the acceleration begins to fall
    below = np.abs(record["spool.u_t"]) + 1e-4 * np.abs(free) < limit
    assert below.sum() >= 10
    np.testing.assert_allclose(record["spool.u_tt"][below], free[below], rtol=1e-6, atol=1e-6 * np.abs(free).max())
    assert np.all(record["spool.u_tt"] * np.sign(free) <= np.abs(free) * (1 + 1e-6))


def test_hysteresis_is_play_in_the_command_alone() -> None:
    h = 5e-3
    names = ("spoolCommand.s", "spoolCommand.y", "PD_Prop", "P_Cont", "u")
    record = ran(("valve.hysteresis",), {"valve.hysteresis": {"h": h}}, names, stop=0.6, step=1e-4)
    s, y = (record[name][5:] for name in names[:2])  # the card's command jumps at the start, where its rate does
    # where the command turns, the place where it stays lags behind by 3e-4 s
    bend = np.abs(np.gradient(np.gradient(s, record.time[5:]), record.time[5:])).max()
    expected = play(np.append(0.0, s), h)[1:]
    assert np.abs(y - expected).max() < 3e-4**2 * bend
    assert np.abs(y - s).max() == pytest.approx(h, rel=0.02)
    np.testing.assert_allclose(record["PD_Prop"], PARAMETERS["K_D"] * (record["P_Cont"] - record["u"]), atol=1e-9)


def test_sensor_lag_is_first_order_and_fed_back() -> None:
    names = ("alpha", "angleSensor.y", "angleSensor.y_t", "alphaPercent", "P_Cont", "alphaRef")
    record = ran(("sensor.lag",), {"sensor.lag": {"T_f": 4e-3}}, names)
    np.testing.assert_allclose(record["angleSensor.y_t"] * 4e-3, record["alpha"] - record["angleSensor.y"], atol=1e-12)
    np.testing.assert_allclose(record["alphaPercent"], 100 * record["angleSensor.y"] / ALPHA_MAX, rtol=1e-12)
    np.testing.assert_allclose(record["P_Cont"], K_P * (record["alphaRef"] - record["angleSensor.y"]), atol=1e-9)
    slope = np.gradient(record["angleSensor.y"], record.time)[5:-5]
    assert np.abs(slope - record["angleSensor.y_t"][5:-5]).max() < 2e-3 * np.abs(slope).max()


def test_card_holds_its_command_between_samples() -> None:
    period = 8e-3
    names = ("cardOutput.s", "cardOutput.y")
    record = ran(("card.sampling",), {"card.sampling": {"T_s": period}}, names, stop=0.5, step=1e-3)
    y, s = record["cardOutput.y"], record["cardOutput.s"]
    index = np.arange(y.size)
    inside = index % 8 != 0  # samples fall on every eighth row, where the order of row and event is open
    np.testing.assert_array_equal(y[inside], y[(index // 8) * 8 + 1][inside])
    at = index[8::8]
    assert np.abs(y[at + 1] - s[at]).max() < 1e-6 * np.abs(s).max() + 1e-9
    assert np.abs(y - s).max() > 0.01 * np.abs(s).max()


def test_the_smooth_form_of_sampling_is_its_mean(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pump's angle with a card that samples every 8 ms, against the form without events."""
    values = {"card.sampling": {"T_s": 8e-3}}
    plain = ran((), {}, ("alphaPercent",))["alphaPercent"]
    sampled = ran(("card.sampling",), values, ("alphaPercent",))["alphaPercent"]
    smooth = CATALOGUE["card.sampling"].smooth
    assert smooth is not None
    assert not makes_events(smooth)
    monkeypatch.setitem(CATALOGUE, "smooth", smooth)
    record = ran(("smooth",), {"card.sampling": values["card.sampling"]}, ("alphaPercent",))["alphaPercent"]
    assert np.abs(sampled - plain).max() > 0.1
    assert np.abs(record - sampled).max() < 0.1 * np.abs(sampled - plain).max()


@pytest.mark.parametrize(
    ("name", "parameter", "sizes"),
    [
        ("sensor.lag", "T_f", (1e-3, 1e-4, 0.0)),
        ("card.sampling", "T_s", (4e-3, 4e-4, 0.0)),
    ],
)
def test_bypassed_effects_tend_to_the_base_as_they_shrink(name: str, parameter: str, sizes: tuple[float, ...]) -> None:
    """A tenth of the size, about a tenth of the difference, and at 0 what the shortest time constant leaves."""
    stop = 0.5
    plain = ran((), {}, ("alphaPercent",), stop=stop)["alphaPercent"]
    left = [
        np.abs(ran((name,), {name: {parameter: size}}, ("alphaPercent",), stop=stop)["alphaPercent"] - plain).max()
        for size in sizes
    ]
    assert left[0] > 0.02
    assert left[1] < 0.2 * left[0]
    assert left[2] < (0.03 if name == "card.sampling" else 2e-3)  # percent; the card samples every 0.1 ms then


def test_two_and_three_effects_share_a_slot(base: RightHandSide, full: RightHandSide) -> None:
    together = on(
        swash__bias={"F_b": 40.0},
        spring__hardening={"k_3": 2e7},
        friction__coulomb={"F_c": 60.0},
        valve__offset={"u_n": 0.01},
        valve__deadband={"u_0": 0.02},
    )
    order = [name for name in EXACT if name in ("valve.offset", "valve.deadband")]
    for state in pairs_of_states():
        x, v, u = (state[name] for name in ("piston.x", "piston.v", "spool.u"))
        found = full.at(state, together)
        force = 40 - 2e7 * x**3 - 60 * np.tanh(v / 1e-3)
        change = (found["piston.v"] - base.at(state)["piston.v"]) * M_EFF
        assert change == pytest.approx(force, rel=1e-7, abs=1e-6)
        opening = u
        for name in order:  # the first named comes first
            if name == "valve.offset":
                opening += 0.01
            else:
                opening = float(np.sign(opening) * max(abs(opening) - 0.02, 0))
        expected = base.at({**state, "spool.u": opening})["chamber1.p"]
        assert found["chamber1.p"] == pytest.approx(expected, rel=1e-12, abs=1e-3)


def test_stops_and_speed_limit_of_the_spool_at_once() -> None:
    given = {"valve.saturation": {"inverse_u_max": 20.0}, "valve.rate_limit": {"inverse_r_max": 1.0}}
    record = ran(EXACT, but_for(given), ("spool.u", "spool.u_t"))
    assert np.abs(record["spool.u"]).max() == pytest.approx(0.05, rel=1e-5)
    assert np.abs(record["spool.u_t"]).max() == pytest.approx(1.0, rel=1e-5)


def test_all_effects_together_build() -> None:
    everything = (*EXACT, *BYPASSED)
    names = {variable.name for variable in model(everything).variables}
    made = pump(everything)[0]
    for name in everything:
        assert {made.parameter(name, p.name) for p in CATALOGUE[name].parameters} <= names
