"""A run is differentiated through events that change neither a state nor its derivative, and only through those.

A ramp x = r t passes p at T = p/r. Behind it y' is what a law says, and a parameter moves y as the closed form says.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.simulate import Esdirk, Sensitivities, sensitivities, sensitivities_many
from pysim.types import Experiment, Model, Signal
from tests.pysim.simulate.fixture_fmus import OSCILLATOR
from tests.pysim.simulate.text_models import RELAY, text_model

R, P, TIMES = 0.8, 0.5, np.linspace(0.0, 2.0, 41)
BEHIND = np.maximum(TIMES - P / R, 0.0)  # s since the ramp passed p
TIGHT = Esdirk(1e-8, 1e-8, derivative_tol=1e-6)


def ramp(law: str, tmp_path: Path, declared: str = "", events: str = "", fmi: int = 2) -> Model:
    return text_model(
        f"""model Ramp
  parameter Real r = {R};
  parameter Real p = {P};
  {declared}
  output Real x(start=0, fixed=true);
  output Real y(start=0, fixed=true);
equation
  der(x) = r;
  der(y) = {law};
  {events}
end Ramp;
""",
        tmp_path,
        fmi=fmi,
    )


def by_p_and_r(model: Model, names: tuple[str, ...] = ("y",)) -> Sensitivities:
    return sensitivities(model, Experiment(TIMES, names), ("p", "r"), solver=TIGHT)


def test_a_kink_of_the_slope(tmp_path):
    found = by_p_and_r(ramp("if x > p then x - p else 0", tmp_path))  # y = r (t - T)^2 / 2
    by_r = BEHIND**2 / 2 + BEHIND * P / R
    np.testing.assert_allclose(found.by_parameter[:, 0], np.stack([-BEHIND, by_r], axis=1), atol=1e-5)
    assert found.exact


def test_a_kink_by_the_offset_of_the_states(tmp_path):
    model = ramp("if x > p then x - p else 0", tmp_path)
    experiment = Experiment(TIMES, ("y",), offset=np.zeros(2))
    (found,) = sensitivities_many(model, [experiment], (), offset=True, solver=TIGHT)
    np.testing.assert_allclose(found.by_offset[:, 0], np.stack([BEHIND, np.ones(41)], axis=1), atol=1e-5)
    assert found.exact


def test_a_command_that_jumps_past_a_condition(tmp_path):
    """No parameter moves the time of the jump: x = exp(-t/T) - 1 up to 1 s, then towards 1."""
    model, push = text_model(RELAY, tmp_path), Signal.steps([0.0, 1.0], [-1.0, 1.0])
    found = sensitivities(model, Experiment(TIMES, ("x",), {"u": push}), ("T",), solver=TIGHT)
    before, after = np.minimum(TIMES, 1.0), np.maximum(TIMES - 1.0, 0.0)
    turned = np.exp(-1 / 0.5) - 1  # x at 1 s
    by_first = before / 0.25 * np.exp(-before / 0.5)
    by_t = by_first * np.exp(-after / 0.5) + (turned - 1) * after / 0.25 * np.exp(-after / 0.5)
    np.testing.assert_allclose(found.by_parameter[:, 0, 0], by_t, atol=1e-5)
    assert found.exact


def test_a_counter_that_nothing_depends_on(tmp_path):
    counter = "when x > pre(last) + 0.1 then last = x; n = pre(n) + 1; end when;"
    declared = "discrete Real last(start=0, fixed=true); output Integer n(start=0, fixed=true);"
    found = by_p_and_r(ramp("p*x", tmp_path, declared, counter))  # y = p r t^2 / 2
    expected = np.stack([R * TIMES**2 / 2, P * TIMES**2 / 2], axis=1)
    np.testing.assert_allclose(found.by_parameter[:, 0], expected, atol=1e-6)
    assert found.exact
    assert found.record.statistics["events"] >= 15


@pytest.mark.parametrize(
    ("law", "declared", "events", "by_p"),
    [
        pytest.param("if x > p then 1 else 0", "", "", -np.sign(BEHIND) / R, id="the slope jumps"),
        pytest.param(
            "if x > p then time - te else 0",
            "discrete Real te(start=0, fixed=true);",
            "when x > p then te = time; end when;",
            -BEHIND / R,
            id="a time is remembered",
        ),
    ],
)
def test_what_depends_on_the_time_of_an_event_comes_from_differences(law, declared, events, by_p, tmp_path):
    found = by_p_and_r(ramp(law, tmp_path, declared, events))
    np.testing.assert_allclose(found.by_parameter[:, 0, 0], by_p, atol=2e-4)
    assert not found.exact
    assert "events" in found.message


def test_a_recorded_time_of_an_event_comes_from_differences(tmp_path):
    held = "when x > p then last = time; end when;"
    found = by_p_and_r(ramp("0", tmp_path, "output Real last(start=0, fixed=true);", held), ("last",))
    np.testing.assert_allclose(found.by_parameter[:, 0, 0], np.sign(BEHIND) / R, atol=1e-6)
    assert not found.exact


@pytest.mark.parametrize("fmi", [2, 3])
def test_an_fmu_says_what_depends_on_a_number_that_an_event_left(tmp_path, fixture_model, fmi):
    events = "when x > p then te = time; n = 1; end when;"
    declared = "discrete Real te(start=0, fixed=true); Integer n(start=0, fixed=true);"
    model = ramp("n*x", tmp_path, f"{declared} Real since = time - te;", events, fmi)
    assert model.abilities.held == {"te", "since"}
    (tmp_path / "slope").mkdir()
    slope = ramp("if x > p then time - te else 0", tmp_path / "slope", declared, events, fmi)
    assert slope.abilities.held == {"te", "der(y)"}
    assert fixture_model(OSCILLATOR, fmi).abilities.held is None


def test_without_that_word_every_event_makes_differences(tmp_path):
    model = ramp("if x > p then x - p else 0", tmp_path)
    silent = replace(model, abilities=replace(model.abilities, held=None))
    assert not by_p_and_r(silent).exact


def test_sampling_that_nothing_depends_on(tmp_path):
    clock = "when sample(0.05, 0.05) then n = pre(n) + 1; end when;"
    found = by_p_and_r(ramp("p*x - 100*(y^3 + y)", tmp_path, "Integer n(start=0, fixed=true);", clock))
    assert found.exact
    assert found.record.statistics["events"] >= 38


@pytest.mark.parametrize("fmi", [2, 3])
def test_what_depends_on_a_delayed_value_comes_from_differences(tmp_path, fmi):
    model = ramp("delay(p*x, 0.3)", tmp_path, fmi=fmi)  # y = p r (t - 0.3)^2 / 2
    assert model.abilities.delayed == {"der(y)"}
    found = by_p_and_r(model)
    np.testing.assert_allclose(found.by_parameter[:, 0, 0], R * np.maximum(TIMES - 0.3, 0.0) ** 2 / 2, atol=1e-5)
    assert not found.exact
