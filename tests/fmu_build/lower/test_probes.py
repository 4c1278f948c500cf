"""Probes: inputs added to single equations, against closed forms, and the names that cannot carry one."""

import textwrap

import numpy as np
import pytest
from scipy.linalg import expm

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.lower import OdeModel, lower
from tests.fmu_build.lower.reference_runner import Runner

LINEAR = """
model Mass "m a = F - c v - k x, with an alias on the way of the force and of the measurement"
  parameter Real m(unit="kg") = 2;
  parameter Real c = 3;
  parameter Real k = 8;
  input Real F(unit="N");
  Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real a(unit="m/s2");
  Real f(unit="N");
  Real f_seen(unit="N");
  output Real y(unit="m");
equation
  der(x) = v;
  der(v) = a;
  f = F;
  f_seen = f;
  m*a = f_seen - c*v - k*x;
  y = x;
end Mass;
"""
A = np.array([[0.0, 1.0], [-4.0, -1.5]])  # of (x, v), m = 2, c = 3, k = 8


@pytest.fixture
def made(tmp_path):
    """Modelica text of a class M or Mass, probes -> OdeModel."""

    def make(text: str, *probes: str) -> OdeModel:
        name = text.split()[1]
        (tmp_path / "m.mo").write_text(textwrap.dedent(text), encoding="utf-8")
        return lower(load(name, [tmp_path / "m.mo"]), probes)

    return make


def driven(model: OdeModel, time: float, **inputs: float) -> Runner:
    order = {v.name: v.index for v in model.variables if v.causality == "input"}
    values = [0.0] * len(order)
    for name, value in inputs.items():
        values[order[name.replace("__", ".")]] = value
    return Runner(model, inputs=lambda t: values).run(time)


def step_response(push: np.ndarray, time: float) -> np.ndarray:
    """(2,): x and v after `push` (of der(x), der(v)) has acted from rest: A^-1 (e^At - 1) push."""
    return np.linalg.solve(A, (expm(A * time) - np.eye(2)) @ push)


@pytest.mark.parametrize(
    ("name", "push", "shift_of_y"),
    [
        ("x", [1.0, 0.0], 0.0),
        ("v", [0.0, 1.0], 0.0),
        ("a", [0.0, 1.0], 0.0),
        ("f", [0.0, 0.5], 0.0),
        ("f_seen", [0.0, 0.5], 0.0),
        ("y", [0.0, 0.0], 0.7),
    ],
)
def test_a_probe_adds_to_its_own_equation(made, name, push, shift_of_y):
    run = driven(made(LINEAR, name), 0.8, **{f"probe__{name}": 0.7})
    x, v = step_response(0.7 * np.array(push), 0.8)
    assert (run.at("x"), run.at("v")) == pytest.approx((x, v), abs=1e-10)
    assert run.at("y") == pytest.approx(x + shift_of_y, abs=1e-10)


def test_what_lies_ahead_of_a_probe_does_not_see_it(made):
    run = driven(made(LINEAR, "f_seen"), 0.3, probe__f_seen=5.0, F=2.0)
    assert (run.at("f"), run.at("f_seen")) == pytest.approx((2.0, 7.0), abs=1e-12)


def test_each_probe_has_its_variables_unit_and_says_what_it_does(made):
    rows = {v.name: v for v in made(LINEAR, "x", "v", "f").variables}
    assert [rows[f"probe.{name}"].unit for name in ("x", "v", "f")] == ["m/s", "m/s2", "N"]
    assert rows["probe.x"].description == "Added to der(x); 0 leaves the model as it is"
    assert rows["probe.f"].description == "Added to f; 0 leaves the model as it is"
    assert (rows["probe.f"].causality, rows["probe.f"].start) == ("input", 0.0)


def test_at_zero_the_model_is_what_it_is_without(made):
    plain, probed = (driven(made(LINEAR, *probes), 0.8, F=1.3) for probes in ((), ("x", "v", "a", "f", "y")))
    assert [probed.at(name) for name in ("x", "v", "a", "y")] == [plain.at(name) for name in ("x", "v", "a", "y")]


def test_an_element_of_an_array(made):
    text = """
    model M
      Real x[2](each start=1, each fixed=true);
    equation
      for i in 1:2 loop der(x[i]) = -i*x[i]; end for;
    end M;
    """
    run = driven(made(text, "x[2]"), 0.5, **{"probe__x[2]": 3.0})
    expected = np.exp(-0.5), 1.5 + (1 - 1.5) * np.exp(-1.0)
    assert (run.at("x[1]"), run.at("x[2]")) == pytest.approx(expected, rel=1e-9)


def test_a_loop_whose_equation_is_written_for_the_variable(made):
    """i = (1 - u)/2, u = i^3 + probe: the loop stays a loop."""
    text = "model M\nReal i; Real u;\nequation\ni = (1 - u)/2;\nu = i^3;\nend M;"
    run = driven(made(text, "u"), 0.0, probe__u=0.25)
    assert run.at("u") == pytest.approx(run.at("i") ** 3 + 0.25, abs=1e-12)
    assert run.at("i") == pytest.approx((1 - run.at("u")) / 2, abs=1e-12)


RIGID = """
model M
  Real p1(start=0, fixed=true); Real v1(start=0, fixed=true); Real a1;
  Real p2; Real v2; Real a2; Real f; Real load;
equation
  der(p1) = v1; der(v1) = a1; der(p2) = v2; der(v2) = a2;
  p1 = p2;
  2*a1 = 4 - f;
  3*a2 = f + load;
  load = 0;
end M;
"""


def test_a_probe_beside_a_constraint_between_states(made):
    """Two masses of 2 and 3 kg, rigidly joined and driven by 4 N, with 6 N more at the second."""
    run = driven(made(RIGID, "load"), 1.0, probe__load=6.0)
    assert run.at("p1") == pytest.approx((4 + 6) / 5 / 2, rel=1e-9)


def test_a_variable_of_the_class_in_place_of_an_input(made):
    """A force -2 x that the class computes doubles nothing but the stiffness: k = 8 becomes 10."""
    text = LINEAR.replace("  Real f_seen", "  Real spring;\n  Real f_seen")
    run = driven(made(text.replace("y = x;", "y = x;\n  spring = -2*x;"), "f=spring"), 0.8, F=1.3)
    a = np.array([[0.0, 1.0], [-5.0, -1.5]])
    x, v = np.linalg.solve(a, (expm(a * 0.8) - np.eye(2)) @ np.array([0.0, 0.65]))
    assert (run.at("x"), run.at("v")) == pytest.approx((x, v), abs=1e-10)
    with pytest.raises(BuildError, match="no continuous variable sprung to add to f"):
        made(LINEAR, "f=sprung")


TAKEN = """
model M
  model Part
    Real x = 1;
  end Part;
  Part probe;
  Real x = 2*time;
end M;
"""


@pytest.mark.parametrize(
    ("text", "name", "message"),
    [
        (LINEAR, "f_sen", "no variable f_sen to probe; near it: f_seen"),
        (LINEAR, "m", "m: it is a parameter; set it"),
        (LINEAR, "F", "F: it is an input; drive it"),
        (
            "model M\ndiscrete Real d(start=0);\nequation\nwhen time > 1 then\nd = 2;\nend when;\nend M;",
            "d",
            "discrete",
        ),
        ("model M\nReal i; Real u;\nequation\ni + u = 1;\ni^3 - u = 0;\nend M;", "u", r"loop \(with i; lines 4, 5\)"),
        (RIGID, "p2", "follows from a constraint between states"),
        (RIGID, "p1", "derivative of the input probe.p1|constraint"),
        (TAKEN, "x", "variable probe.x already; rename"),
    ],
)
def test_a_name_that_cannot_carry_a_probe_is_refused(made, text, name, message):
    with pytest.raises(BuildError, match=message):
        made(text, name)


def test_a_probe_is_asked_for_once(made):
    with pytest.raises(BuildError, match="asked for twice"):
        made(LINEAR, "x", "x")
