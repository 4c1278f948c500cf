"""Classes of learned laws: their runs against independent integrations, and what is refused."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from fmu_build import build
from pysim.effects import STANDARD_LIBRARY, read_catalogue, slots
from pysim.effects.learned import curve_basis, formulas, learned_class
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Experiment, Model, Signal
from pysim.types.answer import LearnedLaw
from pysim.types.factor import Factor, Form
from pysim.workflow import Variants
from pysim.workflow.learned import keep_law
from tests.toy import with_term

Array = NDArray[np.float64]
LAB = """package Lab
  model Mass "Mass, spring and damper, and a lag that follows the force"
    import HydraulicTestBench.Interfaces;
    parameter Real m(unit="kg") = 2;
    input Real F(unit="N", start=0);
    replaceable Interfaces.Neutral.PistonForce force constrainedby Interfaces.PartialPistonForce "Force";
    output Real x(unit="m", start=0, fixed=true);
    Real v(unit="m/s", start=0, fixed=true);
    Real warm(unit="K", start=0, fixed=true);
  equation
    force.x = x;
    force.v = v;
    der(x) = v;
    m*der(v) = F - 3*v - 50*x + force.f;
    0.5*der(warm) = F - warm;
  end Mass;
  model Signals "Slots that give more than one variable, or have a law of their own"
    import HydraulicTestBench.Interfaces;
    input Real a(unit="Pa", start=0);
    replaceable Interfaces.Neutral.Compressibility oil constrainedby Interfaces.PartialCompressibility "Oil";
    replaceable Interfaces.Neutral.SignalWithRate link constrainedby Interfaces.PartialSignalWithRate "Link";
    replaceable HydraulicTestBench.Pump.CommandRateObserver command constrainedby Interfaces.PartialCommandRate "Rate";
    replaceable HydraulicTestBench.Pump.SecondOrderSpool spool(omega_v=20, zeta_v=0.7)
      constrainedby Interfaces.PartialSpool(omega_v=20, zeta_v=0.7) "Spool";
    output Real k1 = oil.kappa1;
    output Real k2 = oil.kappa2;
    output Real y = link.y;
    output Real y_t = link.y_t;
    output Real u = spool.u;
    output Real rate = command.rate;
  equation
    oil.p1 = a;
    oil.p2 = -2*a;
    link.s = sin(3*time);
    link.s_t = 3*cos(3*time);
    spool.u_ref = sin(4*time);
    command.s = 10 + 2*a;
    command.s_t = 0;
  end Signals;
end Lab;
"""
KNOTS = np.sinh(np.linspace(-1.5, 1.5, 7)) / math.sinh(1.5)  # -1 to 1, closer together in the middle
VALUES = np.array([2.0, -1.0, 3.0, 0.5, -2.0, 1.0, 4.0])
TIME = np.linspace(0, 3, 301)
ONE, V = Factor(), Factor(Form.VARIABLE, "v")
PUSH = np.linspace(0, 3, 11), np.array([0, 20, -20, 15, 0, -20, 20, 5, 25, -20, 0.0])  # s, N


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, ...]:
    file = tmp_path_factory.mktemp("lab") / "Lab.mo"
    file.write_text(LAB)
    return STANDARD_LIBRARY, file


def learned(slot: str, factor: Factor, argument: str, reach: float, unit_in: str, unit: str, size: float) -> LearnedLaw:
    values = size * VALUES
    return LearnedLaw(slot, factor, argument, reach * KNOTS, values, 1e-8 * np.eye(7), 0.5, unit_in, unit)


def with_law(lab: Sequence[Path], model: str, law: LearnedLaw, **more: Any) -> Model:
    slot = next(one for one in slots(f"Lab.{model}", lab) if one.name == law.slot)
    text = learned_class(law, slot, "Own", lab, effect="learned.own")
    return with_term(Variants(f"Lab.{model}", tuple(lab)), text, **more)[0]


def curve(law: LearnedLaw, z: float) -> float:
    """From corner to corner: each changes the slope, by a hyperbola as wide as a quarter of the shorter side, or as a
    sixteenth at the ends."""
    k, c = law.knots, law.coefficients
    slopes = [0.0, *np.diff(c) / np.diff(k), 0.0]
    found = float(c[0])
    for i, corner in enumerate(k):
        sides = [abs(k[j] - corner) for j in (i - 1, i + 1) if 0 <= j < len(k)]
        width = min(sides) / (4 if len(sides) > 1 else 16)
        found += (slopes[i + 1] - slopes[i]) * (z - corner + math.hypot(z - corner, width)) / 2
    return found


def mass(force: Callable[[float, float, float, float], float], push: Array = PUSH[1]) -> Array:
    """Position of the mass, by another integrator."""

    def rates(t: float, state: Array) -> list[float]:
        x, v, warm = state
        pushed = float(np.interp(t, PUSH[0], push))
        return [v, (pushed - 3 * v - 50 * x + force(t, x, v, warm)) / 2, (pushed - warm) / 0.5]

    run = solve_ivp(rates, (0, 3), [0.0, 0.0, 0.0], "DOP853", TIME, rtol=1e-10, atol=1e-12)
    return np.asarray(run.y[0])


def run_of(model: Model, **values: float) -> Array:
    experiment = Experiment(TIME, ("x",), {"F": Signal.lines(*PUSH)}, values)
    return np.asarray(simulate(model, experiment, solver=Rodas(rtol=1e-8, atol=1e-10))["x"])


def test_the_curve_is_constant_beyond_its_ends_and_near_its_values_within() -> None:
    basis = curve_basis(np.array([-1e6, 1e6, *KNOTS]), KNOTS)
    assert basis.sum(axis=1) == pytest.approx(np.ones(9))
    assert basis[:2] @ VALUES == pytest.approx(VALUES[[0, -1]], abs=1e-5)
    even = np.linspace(-1, 1, 7)
    assert curve_basis(even, even) @ even == pytest.approx(even, abs=0.05)


@pytest.mark.slow
def test_a_class_runs_as_its_law_in_another_importer(lab: tuple[Path, ...], tmp_path: Path) -> None:
    law = learned("force", V, "x", 0.5, "m", "N.s/m", -2.0)
    effect = keep_law(law, "my.damping", "Lab.Mass", lab, tmp_path)
    assert (effect.class_name, effect.slot, effect.description) == (
        "MyDamping",
        "force",
        "Force: v*h(x) (learned)",
    )
    assert [p.default for p in effect.parameters] == pytest.approx(list(law.coefficients))
    assert {(p.off, p.min, p.max, p.unit) for p in effect.parameters} == {(0.0, -80.0, 80.0, "N.s/m")}
    variants = Variants("Lab.Mass", (*lab, tmp_path / "MyDamping.mo"))
    model, places = variants.write([effect], tmp_path, tmp_path / "own.fmu")
    assert places == {"my.damping": "force"}
    right = mass(lambda t, x, v, warm: curve(law, x) * v)
    assert np.ptp(right - mass(lambda t, x, v, warm: 0.0)) > 0.1
    assert run_of(model) == pytest.approx(right, abs=2e-6)
    steady = mass(lambda t, x, v, warm: curve(law, x) * v, np.full(11, 20.0))
    foreign = fmpy.simulate_fmu(
        str(tmp_path / "own.fmu"), stop_time=3, output_interval=0.01, relative_tolerance=1e-8, start_values={"F": 20.0},
        output=["x"],
    )  # fmt: skip
    assert foreign["x"] == pytest.approx(steady, abs=2e-6)
    off = run_of(model, **{f"force.c[{k}]": 0.0 for k in range(1, 8)})
    assert off == pytest.approx(mass(lambda t, x, v, warm: 0.0), abs=2e-6)


def test_an_argument_from_elsewhere_is_bound_beside_another_effect(lab: tuple[Path, ...], tmp_path: Path) -> None:
    friction = """model Rub extends HydraulicTestBench.Interfaces.PartialPistonForce;
      parameter Real d(unit="N.s/m", min=0, max=9) = 0;
      equation f = -d*v;
      annotation(__HydraulicTestBench(effect="rub", slot="force")); end Rub;"""
    (tmp_path / "Rub.mo").write_text(friction)
    pair = """model Both extends HydraulicTestBench.Interfaces.PartialPistonForce;
      replaceable HydraulicTestBench.Interfaces.Neutral.PistonForce first
        constrainedby HydraulicTestBench.Interfaces.PartialPistonForce;
      replaceable HydraulicTestBench.Interfaces.Neutral.PistonForce second
        constrainedby HydraulicTestBench.Interfaces.PartialPistonForce;
      equation first.x = x; first.v = v; second.x = x; second.v = v; f = first.f + second.f;
      annotation(__HydraulicTestBench(pair="force")); end Both;"""
    (tmp_path / "Both.mo").write_text(pair)
    wider = (*lab, tmp_path / "Rub.mo", tmp_path / "Both.mo")
    law = learned("force", Factor(Form.SIGN, "v", 2e-3), "warm", 15.0, "K", "N", 1.0)
    model = with_law(wider, "Mass", law, effects=read_catalogue(tmp_path / "Rub.mo"))
    right = mass(lambda t, x, v, warm: curve(law, warm) * math.tanh(v / 2e-3) - 4 * v)
    assert run_of(model, **{"force.first.d": 4.0}) == pytest.approx(right, abs=1e-5)


def test_time_can_be_the_argument(lab: tuple[Path, ...]) -> None:
    law = learned("force", Factor(Form.VARIABLE, "x"), "time", 1.5, "s", "N/m", 10.0)
    law = replace(law, knots=law.knots + 1.5)
    right = mass(lambda t, x, v, warm: curve(law, t) * x)
    assert run_of(with_law(lab, "Mass", law)) == pytest.approx(right, abs=2e-6)


def test_a_tone_is_a_factor_of_time(lab: tuple[Path, ...]) -> None:
    law = learned("force", Factor(Form.TONE, number=1.23456, rate=7.5123456), "x", 0.5, "m", "N", 3.0)
    right = mass(lambda t, x, v, warm: curve(law, x) * math.cos(7.5123456 * t + 1.23456))
    assert run_of(with_law(lab, "Mass", law)) == pytest.approx(right, abs=2e-6)


def test_a_bristle_remembers(lab: tuple[Path, ...]) -> None:
    law = learned("force", Factor(Form.BRISTLE, "v", 0.02), "x", 0.5, "m", "N", -1.0)

    def rates(t: float, state: Array) -> list[float]:
        x, v, z = state
        force = float(np.interp(t, *PUSH)) - 3 * v - 50 * x + curve(law, x) * z
        return [v, force / 2, (v - abs(v) * z) / 0.02]

    run = solve_ivp(rates, (0, 3), [0.0, 0.0, 0.0], "DOP853", TIME, rtol=1e-10, atol=1e-12)
    model = with_law(lab, "Mass", law)
    assert run_of(model) == pytest.approx(run.y[0], abs=5e-6)
    assert (model["force.v_length"].min, model["force.v_length"].unit) == (0.002, "m")


@pytest.mark.parametrize("variable", ["x", "warm"])
def test_a_hysteresis_remembers_where_a_variable_came_from(lab: tuple[Path, ...], variable: str) -> None:
    law = learned("force", Factor(Form.HYSTERESIS, variable, 0.02), "x", 0.5, "m", "N", -1.0)

    def rates(t: float, state: Array) -> list[float]:
        x, v, warm, z = state
        pushed = float(np.interp(t, *PUSH))
        moves = v if variable == "x" else (pushed - warm) / 0.5
        force = pushed - 3 * v - 50 * x + curve(law, x) * z
        return [v, force / 2, (pushed - warm) / 0.5, (moves - abs(moves) * z) / 0.02]

    run = solve_ivp(rates, (0, 3), [0.0, 0.0, 0.0, 0.0], "DOP853", TIME, rtol=1e-10, atol=1e-12)
    model = with_law(lab, "Mass", law)
    assert run_of(model) == pytest.approx(run.y[0], abs=5e-6)
    assert model[f"force.{variable}_length"].unit == {"x": "m", "warm": "1"}[variable]


def test_a_law_over_the_difference_of_two_signals(lab: tuple[Path, ...]) -> None:
    law = learned("force", V, "warm - x", 0.5, "m", "N.s/m", -2.0)
    right = mass(lambda t, x, v, warm: curve(law, warm - x) * v)
    model = with_law(lab, "Mass", law)
    assert np.ptp(right - mass(lambda t, x, v, warm: 0.0)) > 0.1
    assert run_of(model) == pytest.approx(right, abs=2e-6)


def outputs(model: Model, *names: str) -> list[Array]:
    ramp = Signal.lines([0.0, 3.0], [-1.0, 1.0])
    answer = simulate(model, Experiment(TIME, names, {"a": ramp}, {}), solver=Rodas(rtol=1e-9, atol=1e-11))
    return [np.asarray(answer[name]) for name in names]


def test_both_sides_of_a_slot_have_one_law(lab: tuple[Path, ...]) -> None:
    law = learned("oil", Factor(Form.VARIABLE, "p1"), "oil.p1", 1.0, "Pa", "1/Pa2", 1.0)
    k1, k2 = outputs(with_law(lab, "Signals", law), "k1", "k2")
    a = np.linspace(-1, 1, 301)
    assert k1 == pytest.approx([curve(law, p) * p for p in a], abs=1e-7)  # the class has eight digits
    assert k2 == pytest.approx([curve(law, -2 * p) * -2 * p for p in a], abs=1e-7)  # the class has eight digits


@pytest.mark.parametrize("factor", [ONE, Factor(Form.VARIABLE, "s")])
def test_a_signal_is_handed_on_with_its_rate(lab: tuple[Path, ...], factor: Factor) -> None:
    law = learned("link", factor, "s", 1.0, "1", "1", 0.1)
    y, y_t = outputs(with_law(lab, "Signals", law), "y", "y_t")
    s = np.sin(3 * TIME)
    added = np.array([curve(law, one) * (1.0 if factor == ONE else one) for one in s])
    assert y == pytest.approx(s + added, abs=1e-7)  # the class has eight digits
    assert np.cumsum(y_t[:-1] + np.diff(y_t) / 2) * 0.01 == pytest.approx(y[1:] - y[0], abs=5e-3)


def test_a_formula_is_handed_on_with_its_rate(lab: tuple[Path, ...]) -> None:
    knots, z = np.linspace(-1, 1, 9), np.linspace(-1, 1, 200)
    values = np.linalg.pinv(curve_basis(z, knots)) @ (0.3 * np.tanh(z / 0.4))
    law = LearnedLaw("link", ONE, "s", knots, values, 1e-8 * np.eye(9), 0.5, "1", "1")
    formula = formulas(law)[0]
    assert formula.shapes == ("smooth sign",)
    slot = next(one for one in slots("Lab.Signals", lab) if one.name == "link")
    text = learned_class(law, slot, "Own", lab, effect="learned.own", formula=formula)
    y, y_t = outputs(with_term(Variants("Lab.Signals", lab), text)[0], "y", "y_t")
    s = np.sin(3 * TIME)
    assert y == pytest.approx(s + 0.3 * np.tanh(s / 0.4), abs=0.01)
    assert np.cumsum(y_t[:-1] + np.diff(y_t) / 2) * 0.01 == pytest.approx(y[1:] - y[0], abs=5e-3)


def test_a_slot_keeps_the_law_that_it_has(lab: tuple[Path, ...]) -> None:
    law = learned("spool", ONE, "u_t", 4.0, "1/s", "1/s2", 20.0)
    (u,) = outputs(with_law(lab, "Signals", law), "u")

    def rates(t: float, state: Array) -> list[float]:
        return [state[1], 400 * (math.sin(4 * t) - state[0]) - 28 * state[1] + curve(law, state[1])]

    right = solve_ivp(rates, (0, 3), [0.0, 0.0], "DOP853", TIME, rtol=1e-10, atol=1e-12).y[0]
    assert u == pytest.approx(right, abs=1e-6)


def test_a_slot_keeps_its_start(lab: tuple[Path, ...]) -> None:
    """The observer of a ramp is settled from the first moment on: nothing but the law is beside the ramp's slope."""
    law = learned("command", ONE, "s", 20.0, "%", "%/s", 1.0)
    (rate,) = outputs(with_law(lab, "Signals", law), "rate")
    assert rate[0] == pytest.approx(curve(law, 8.0), abs=1e-7)


def test_a_formula_stands_in_place_of_the_table(lab: tuple[Path, ...], tmp_path: Path) -> None:
    knots = np.linspace(-0.5, 0.5, 9)
    basis = np.linalg.pinv(curve_basis(np.linspace(-0.5, 0.5, 200), knots))
    values = basis @ (-4 - 60 * np.linspace(-0.5, 0.5, 200) ** 2)
    law = LearnedLaw("force", V, "x", knots, values, 1e-4 * np.eye(9), 0.5, "m", "N.s/m")
    formula = formulas(law)[0]
    assert formula.shapes == ("constant", "square")
    effect = keep_law(law, "my.own", "Lab.Mass", lab, tmp_path, formula=formula)
    assert [(p.name, p.unit, p.off) for p in effect.parameters] == [("a_1", "N.s/m", 0.0), ("a_2", "N.s/m3", 0.0)]
    build("MyOwn", tmp_path / "own.fmu", libraries=[*lab, tmp_path / "MyOwn.mo"])
    assert read_model(tmp_path / "own.fmu")["a_2"].unit == "N.s/m3"
    model = Variants("Lab.Mass", (*lab, tmp_path / "MyOwn.mo")).build([effect])[0]
    found = run_of(model, **{"force.a_1": -4.0, "force.a_2": -60.0})
    assert found == pytest.approx(mass(lambda t, x, v, warm: -(4 + 60 * x**2) * v), abs=2e-6)


@pytest.mark.parametrize(
    ("slot", "factor", "unit", "said"),
    [
        ("force", V, "N", "times that is not in N"),
        ("oil", Factor(Form.BRISTLE, "p1", 1.0), "1/Pa", "two sides"),
        ("link", V, "1", "does not know"),
    ],
)
def test_what_cannot_be_written_is_refused(
    lab: tuple[Path, ...], slot: str, factor: Factor, unit: str, said: str
) -> None:
    known = {one.name: one for name in ("Mass", "Signals") for one in slots(f"Lab.{name}", lab)}
    with pytest.raises(BadInput, match=said):
        learned_class(learned(slot, factor, "x", 1.0, "m", unit, 1.0), known[slot], "Own", lab)


def test_units_that_are_not_si_are_not_looked_at(lab: tuple[Path, ...]) -> None:
    slot = next(one for one in slots("Lab.Mass", lab) if one.name == "force")
    text = learned_class(learned("force", V, "x", 1.0, "mm", "lbf.s/mm", 1.0), slot, "Own", lab)
    assert 'each unit="lbf.s/mm"' in text


def test_a_law_of_its_own_kind_has_no_place_for_another(lab: tuple[Path, ...]) -> None:
    flow = next(one for one in slots("HydraulicTestBench.LoadCircuit.OpenTestBench", lab) if one.name == "pumpFlow")
    with pytest.raises(BadInput, match="several kinds"):
        learned_class(learned("pumpFlow", ONE, "alpha", 1.0, "rad", "m3/s", 1.0), flow, "Own", lab)
