"""Tests that separate two models: run on the bench they do, and what is worked out of them is a regression."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from pysim.bench import read_plan, run_plan
from pysim.diagnosis import settings as numbers
from pysim.diagnosis.candidate import Models, Values
from pysim.diagnosis.candidate_tests import candidate_tests
from pysim.diagnosis.next_test import _settled, cheapest, loggable, next_test, remaining
from pysim.diagnosis.refit import FinalFit, begin, converged
from pysim.diagnosis.session import Session, session
from pysim.effects import read_catalogue
from pysim.excitation import LeadIn, Step
from pysim.identify.greybox import Nuisance, NuisanceKind
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Dataset, Experiment, NextTest
from pysim.workflow.model import compiled
from pysim.workflow.variants import Variants
from tests.known_answers.plants import PLANTS
from tests.pysim.diagnosis.plants import FINE, catalogue, given, measured, refitted, variants

SETTINGS = numbers.TestSettings()
TRUTH: Mapping[str, float] = {"m": 1.0, "d": 1.9, "k": 40.0}
FRICTION, HARDENING, BIAS = "mass.friction", "mass.hardening", "mass.bias"
STRENGTH = {FRICTION: ("F_c", 0.03), HARDENING: ("k_3", 5.0), BIAS: ("F_b", 0.05)}  # of the plants
OFFSET = Nuisance(NuisanceKind.OFFSET, "mass", "x", 0.01)
GAIN = Nuisance(NuisanceKind.GAIN, "mass", "x", 0.02)

TWIN = """
package Twins
  model Friction "Dry friction, hardly another"
    extends Mass.PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = -F_c*tanh(v/0.01999);
    annotation(__HydraulicTestBench(effect="twins.friction", slot="force"));
  end Friction;
end Twins;
"""

PLANT = """
package Within
  model Mass "With numbers of its own that no sensor could be put to"
    parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 40;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true);
    output Real v(unit="m/s", start=0, fixed=true);
    Real p(unit="Pa", start=0, fixed=true) "Pressure behind a throttle";
    Real share(unit="%", start=0, fixed=true) "Of a controller";
    Real plain(start=0, fixed=true) "Of a filter";
    Real third(unit="m", start=0, fixed=true) "Of the way";
    Real nothing(unit="Pa", start=0, fixed=true) "Round-off";
  equation
    der(x) = v;
    der(v) = F - 2*v - k*x;
    der(p) = 1e5*v - 3*p;
    der(share) = 100*x - share;
    der(plain) = x - plain;
    der(third) = v/3;
    der(nothing) = 1e5*(x - 3*third) - nothing;
  end Mass;
end Within;
"""


def short(effect: str, **logs: object) -> Dataset:
    """A log of a plant with the effect, too short to tell it from others."""
    name, size = STRENGTH[effect]
    return measured("mass", {effect: {name: size}}, TRUTH, fit=(1,), validate=(), length=3.0, **logs)


def fitted(own: Session, what: str | Nuisance, start: Values | None = None) -> FinalFit:
    """The model with one effect, or one sensor's error."""
    models = Models(own)
    if isinstance(what, Nuisance):
        return converged(begin(models.of((), (what,)), start or {}, FINE))
    name, size = STRENGTH[what]
    return refitted(models, what, values={(what, name): 0.5 * size, **(start or {})})


def rivals(data: Dataset, one: str, other: str | Nuisance) -> tuple[Session, FinalFit, FinalFit]:
    names = [name for name in (one, other) if isinstance(name, str)]
    own = given("mass", data, names, initial="near rest")
    return own, fitted(own, one), fitted(own, other)


@cache
def asked(one: str, other: str | Nuisance, **logs: object) -> NextTest | None:
    """What would separate an effect that the plant has from something else."""
    return next_test(*rivals(short(one, **logs), one, other))


def run(plan: str, path: Path, effect: str) -> Dataset:
    """The plan on a bench whose plant has the effect."""
    path.write_text(plan, encoding="utf-8")
    model, places = variants("mass").build([catalogue("mass")[effect]])
    name, size = STRENGTH[effect]
    return run_plan(model, read_plan(path), 5, parameters={**TRUTH, f"{places[effect]}.{name}": size}).dataset


@pytest.mark.parametrize(
    ("right", "wrong"),
    [(FRICTION, HARDENING), (HARDENING, OFFSET), pytest.param(FRICTION, GAIN, marks=pytest.mark.slow)],
)
def test_the_plan_separates_as_far_as_it_promises(right: str, wrong: str | Nuisance, tmp_path: Path) -> None:
    data = short(right)
    _, one, other = rivals(data, right, wrong)
    before = other.point.cost - one.point.cost
    assert abs(before) < 4
    found = asked(right, wrong)
    assert found is not None
    assert found.gain >= SETTINGS.enough
    new = run(found.plan, tmp_path / "plan.toml", right)
    signals = (data.signals[0], *(signal for signal in new.signals if signal.role == "output"))
    joined = replace(data, signals=signals, records=(*data.records, *new.records))
    _, one, other = rivals(joined, right, wrong)
    gained = other.point.cost - one.point.cost - before
    assert gained > 0.7 * found.gain / 2  # nats are half the squares; those scatter by 14 of 50


def test_an_offset_of_the_sensor_does_what_a_constant_force_does() -> None:
    """On a linear plant in every test, whatever else is logged."""
    assert asked(BIAS, OFFSET) is None


def test_twins_stay_twins(tmp_path: Path) -> None:
    library = tmp_path / "Twins.mo"
    library.write_text(TWIN, encoding="utf-8")
    own = Variants("Mass.Design", (PLANTS["mass"].library, library))
    (twin,) = read_catalogue(library)
    made = session(own.build(())[0], short(FRICTION), [catalogue("mass")[FRICTION], twin], own.build, workers=1)
    fits = [refitted(Models(made), name, values={(name, "F_c"): 0.02}) for name in (FRICTION, twin.name)]
    assert next_test(made, *fits) is None


def test_noise_that_is_not_specified_is_what_the_better_model_leaves(tmp_path: Path) -> None:
    data = short(FRICTION, stated=0.0)
    signals = [replace(s, resolution=1e-3) if s.role == "output" else s for s in data.signals]
    own, one, other = rivals(replace(data, signals=tuple(signals)), FRICTION, HARDENING)
    found = next_test(own, one, other)
    assert found is not None
    (tmp_path / "plan.toml").write_text(found.plan, encoding="utf-8")
    (planned,) = (s.signal for s in read_plan(tmp_path / "plan.toml").sensors if s.signal.name == "x")
    assert planned.deviation == pytest.approx(min(one.point.levels[0], other.point.levels[0]), rel=1e-5)
    assert planned.resolution == 1e-3


def test_a_signal_is_asked_for_where_those_that_are_logged_are_not_enough(tmp_path: Path) -> None:
    """A speed for what noise hides; none where the position shows it."""
    weak, strong = asked(FRICTION, HARDENING), asked(FRICTION, HARDENING, louder=0.1)
    logged = []
    for found in (weak, strong):
        assert found is not None
        (tmp_path / "plan.toml").write_text(found.plan, encoding="utf-8")
        logged.append([sensor.signal.name for sensor in read_plan(tmp_path / "plan.toml").sensors])
    assert logged == [["F", "x", "v"], ["F", "x"]]


def test_a_look_ahead_that_never_settles_waits_to_its_end() -> None:
    own, one, _ = rivals(short(FRICTION), FRICTION, HARDENING)
    free = {**TRUTH, (FRICTION, "F_c"): 0.0}
    swinging, damped = (begin(one.candidate, {**free, "d": d}, FINE) for d in (0.0, 1.9))
    outputs = [signal for signal in own.dataset.signals if signal.role == "output"]
    command = Step(0.0, 5.0, 20.0, lead=LeadIn(0.01, 0.0, 0.0, 0.0)).signal()
    step = Experiment(np.arange(0.0, 20.0, 0.02), ("x",), {"F": command})
    assert _settled(own, swinging, outputs, step, 0.2) > 19
    left = 5 / 40 * np.exp(-1.9 / 2 * np.array([0.0, 20.0]))  # of a step's swing around 1/8 m, at its ends
    assert left[1] < 0.2e-3 < left[0]
    assert _settled(own, damped, outputs, step, 0.2) == pytest.approx(np.log(left[0] / 0.2e-3) / 0.95, abs=0.5)
    with pytest.raises(BadInput, match="needs an output"):
        _settled(own, one, (), step, 0.2)


def test_outputs_and_states_of_physical_units_can_be_logged(tmp_path: Path) -> None:
    """With a thousandth of what they go through as noise; what is logged already is not asked for."""
    library = tmp_path / "Within.mo"
    library.write_text(PLANT, encoding="utf-8")
    model = compiled("Within.Mass", [library])
    own = session(model, measured("mass", fit=(1,), validate=(), length=6.0), workers=1)
    fit = begin(Models(own).of(()), {}, FINE)
    tests = candidate_tests(own.dataset, lambda run: 5.0, model, SETTINGS)[:4]
    outputs, states = loggable(own, fit, fit, tests, SETTINGS)
    assert [(s.name, s.unit) for s in outputs] == [("v", "m/s")]
    assert [(s.name, s.unit) for s in states] == [("p", "Pa"), ("third", "m")]
    runs = [simulate(model, t.experiment(model, ("v",), {}), solver=Rodas(rtol=1e-9, atol=1e-9)) for t in tests]
    assert outputs[0].noise == pytest.approx(1e-3 * np.ptp(np.concatenate([one["v"] for one in runs])), rel=1e-3)


def products(apart: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    rows = np.column_stack([apart, slopes])
    return np.asarray(rows.T @ rows)


def test_what_remains_is_what_a_fit_to_old_and_new_data_leaves() -> None:
    rng = np.random.default_rng(3)
    apart, slopes, old = rng.standard_normal(40), rng.standard_normal((40, 3)), rng.standard_normal((60, 3))
    rows, values = np.vstack([slopes, old]), np.append(apart, np.zeros(60))
    left = np.linalg.lstsq(rows, values, rcond=None)[1][0]
    assert remaining(products(apart, slopes), old.T @ old) == pytest.approx(left)


def test_a_difference_that_a_refit_makes_is_worth_nothing() -> None:
    slopes = np.random.default_rng(3).standard_normal((40, 3))
    own = products(slopes @ np.array([1.0, -2.0, 0.5]), slopes)
    assert remaining(own, np.zeros((3, 3))) == pytest.approx(0.0, abs=1e-9)
    assert remaining(own, 1e6 * np.eye(3)) > 1.0


def says(*sizes: float) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """A test whose difference no refit can make, as either model sees it."""
    one, other = (products(np.array([0.0, size]), np.array([[1.0], [0.0]])) for size in (sizes[0], sizes[-1]))
    return {"y": (one, other)}


def test_the_shortest_way_to_enough_is_taken() -> None:
    known = (np.zeros((1, 1)), np.zeros((1, 1)))
    table = [says(4.0), says(10.0), {}, says(1.0)]
    assert cheapest([1.0, 20.0, 1.0, 1.0], table, ["y"], known, SETTINGS) == (pytest.approx(64.0), [(0, 4)])
    assert cheapest([1.0, 2.0, 1.0, 1.0], table, ["y"], known, SETTINGS) == (pytest.approx(100.0), [(1, 1)])
    gain, chosen = cheapest([1.0] * 6, [says(0.1)] * 6, ["y"], known, SETTINGS)
    assert gain == pytest.approx(SETTINGS.most * SETTINGS.repeats * 0.01)
    assert [count for _, count in chosen] == [SETTINGS.repeats] * SETTINGS.most


def test_the_weaker_of_both_truths_counts() -> None:
    known = (np.zeros((1, 1)), np.zeros((1, 1)))
    assert cheapest([1.0], [says(10.0, 1.0)], ["y"], known, SETTINGS)[0] == pytest.approx(SETTINGS.repeats)
