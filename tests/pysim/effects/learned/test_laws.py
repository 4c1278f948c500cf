"""Which laws there are, and that the compiled one is the curve it says, against an integrator of its own."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from pysim.diagnosis.learn.screening import distinct, with_moved
from pysim.effects import Slot
from pysim.effects.law_units import quotient
from pysim.effects.learned import LESS, Law, Term, curve_basis, laws_at, places
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Signal
from pysim.types.factor import Form
from tests.known_answers.plants import PLANTS
from tests.pysim.diagnosis.plants import variants
from validation.asked import PUMP

KNOTS = np.array([-0.3, -0.1, 0.0, 0.1, 0.3])


def test_laws_at_a_slot_depend_on_what_it_sees_and_on_states_and_inputs_besides() -> None:
    own = variants("axis")
    where = {place.name: place for place in places(own.slots, own.build(())[0])}
    assert set(where) == {"guideway", "amplifier"}
    assert where["guideway"].arguments[:2] == ("guideway.x", "guideway.v")
    assert {"i", "x_ref"} <= set(where["guideway"].arguments)
    names = {(str(law.factor), law.argument) for law in laws_at(where["guideway"])}
    assert {("", "guideway.v"), ("v", "guideway.x"), ("sign(v)", "i"), ("x", "x_ref")} <= names
    assert ("v", "guideway.v") not in names


def test_a_law_may_depend_on_the_difference_of_two_states_in_one_unit() -> None:
    """Of the pump: the chambers' pressures alone have one."""
    model = PUMP.model
    where = {place.name: place for place in places(PUMP.variants.slots, model)}
    assert [one for one in where["pistonForce"].arguments if LESS in one] == ["chamber1.p - chamber2.p"]
    inner = [one for place in where.values() for one in place.arguments if place.sides[0].output_rate and LESS in one]
    assert not inner


def test_what_is_a_state_may_pull_on_a_bristle_as_it_moves() -> None:
    where = {place.name: place for place in places(PUMP.variants.slots, PUMP.model)}
    rng, names = np.random.default_rng(1), ("spool.u", "piston.x", "piston.v")
    signals = {one: rng.normal(size=50) for place in where.values() for one in place.arguments} | {
        one: rng.normal(size=50) for one in names
    }
    signals |= {"spoolOpening.s": signals["spool.u"], "pistonForce.x": signals["piston.x"]}
    told = {name: with_moved(place, signals, names) for name, place in where.items()}
    assert told["spoolOpening"].pulls == {0: "der(spoolOpening.s)"}
    assert told["pistonForce"].pulls == {1: "pistonForce.v"}  # its speed is at hand
    assert not told["supply"].pulls


def test_a_slot_whose_variables_the_model_does_not_have_is_no_place() -> None:
    slot = Slot("amplifier", "", "", ("u1", "u2"), "", ("w1", "w2"))
    assert not places([slot], variants("axis").build(())[0])


@pytest.mark.parametrize("scale", [1.0, 1000.0])
def test_a_sign_changes_within_a_share_of_what_its_variable_does(scale: float) -> None:
    """In meters as in millimeters, on a large machine as on a small one."""
    own = variants("mass")
    where = places(own.slots, own.build(())[0])
    names = {name for place in where for side in place.sides for name in (*side.own, *place.outside)}
    t = np.linspace(0, 20, 2001)
    signals = {name: scale * np.sin((1 + 0.37 * k) * t) for k, name in enumerate(sorted(names))}
    widths = {law.number for law in distinct(where, signals) if law.form is Form.SIGN}
    assert widths
    assert all(width == pytest.approx(0.02 * scale * np.sqrt(0.5), rel=0.05) for width in widths)


@pytest.mark.parametrize("form", list(Form))
def test_the_compiled_term_is_the_curve_times_its_factor(form: Form) -> None:
    own, c = variants("mass"), np.array([0.4, -0.5, 0.3, 0.0, -1.0])
    (place,) = places(own.slots, own.build(())[0])
    by = {Form.VARIABLE: 1, Form.SIGN: 1, Form.BRISTLE: 1, Form.HYSTERESIS: 0}.get(form)
    place = replace(place, moved=(0,)) if form is Form.HYSTERESIS else place
    law = Law(place, 0, form, by, 0.05, 9.0)
    model = own.probed((), [Term(place, KNOTS.size, bool(law.free))])
    values = dict(zip(place.coefficients(KNOTS.size), (c / 2).tolist(), strict=True))
    times = np.linspace(0, 4, 81)
    run = Experiment(times, ("x",), {"F": Signal.constant(6.0)})
    run = run.override(**PLANTS["mass"].design, **law.settings(KNOTS, 2.0), **values)
    found = simulate(model, run, solver=Rodas(1e-8, 1e-8))["x"]

    def slope(t: float, s: np.ndarray) -> list[float]:
        x, v, bristle = s.tolist()
        factor = {
            Form.ONE: 1.0, Form.VARIABLE: v, Form.SIGN: np.tanh(v / 0.05), Form.BRISTLE: bristle,
            Form.HYSTERESIS: bristle, Form.TONE: np.cos(9 * t + 0.05),
        }[form]  # fmt: skip
        term = float(curve_basis(np.array([x]), KNOTS)[0] @ c) * factor
        return [v, 6 - 2 * v - 40 * x + term, (v - abs(v) * bristle) / 0.05]

    truth = solve_ivp(slope, (0, 4), [0.0, 0.0, 0.0], t_eval=times, rtol=1e-8, atol=1e-10).y[0]
    assert np.ptp(truth) > 0.2
    assert found == pytest.approx(truth, abs=1e-5)


@pytest.mark.parametrize(
    ("unit", "by", "right"),
    [
        ("N", "m/s", "N.s/m"),
        ("N", "", "N"),
        ("m3/s", "Pa", "m3/(s.Pa)"),
        ("m", "m", "1"),
        ("m/s", "s", "m/s2"),
        ("N.s2/(m.Pa)", "s2.m-1/Pa", "N"),
    ],
)
def test_the_unit_of_a_curve_is_that_of_the_slot_over_the_factor(unit: str, by: str, right: str) -> None:
    assert quotient(unit, by) == right


@pytest.mark.parametrize(("power", "right"), [(1, "N/m"), (2, "N/m2"), (-1, "N.m"), (0, "N")])
def test_the_unit_of_an_amount_is_over_a_power_of_the_argument(power: int, right: str) -> None:
    assert quotient("N", "m", power) == right
