import pickle
from pathlib import Path

import pytest

from pysim.types import Abilities, BadInput, MeasuredSignal, Model, Variable
from tests.pysim import comparisons as linear


def test_representation_is_short():
    text = repr(linear.model())
    assert "Linear" in text
    assert "linear.fmu" in text
    assert "Variable" not in text


def test_unknown_name_is_refused_with_those_near_it():
    with pytest.raises(BadInput, match=r"linear\.fmu has no variable 'angel'; near it: angle"):
        linear.model()["angel"]


def test_comparison_goes_to_another_process():
    comparison = pickle.loads(pickle.dumps(linear.comparison("a")))
    assert comparison.passes
    assert dict(comparison.overrides) == {"k": 2.5}


def variable(name: str, causality: str, unit: str = "1") -> Variable:
    return Variable(name, 0, "Real", causality, "continuous", 0.0, unit, None, "", None, None, None, None)


def model(*variables: Variable) -> Model:
    return Model(Path("m.fmu"), "m", "t", variables, Abilities(2, True, False, False, False, 0, (), ()))


def test_only_an_input_named_like_the_command_with_t_behind_it_takes_its_rate() -> None:
    own = model(*(variable(n, c) for n, c in (("u", "input"), ("u_t", "input"), ("v", "input"), ("v_t", "local"))))
    assert own.rate_input("u") == "u_t"
    assert own.rate_input("v") is None
    assert own.rate_input("w") is None
    assert own.rate_inputs(("u", "v")) == {"u_t": "u"}
    assert own.rate_inputs(("u", "u_t")) == {}


def test_a_signal_shows_a_variable_of_its_unit_only() -> None:
    own = model(variable("u", "input", "%"), variable("y", "output", "m"))
    assert own.measured(MeasuredSignal("c", "input", "%", "", "u"), "the plan").name == "u"
    assert own.measured(MeasuredSignal("c", "output", "m", "", "y"), "the plan").name == "y"
    with pytest.raises(BadInput, match=r"'c' of the plan is in 'mm', y of m\.fmu in 'm'; give both the same unit"):
        own.measured(MeasuredSignal("c", "output", "mm", "", "y"), "the plan")
    with pytest.raises(BadInput, match=r"m\.fmu: y is no input but of causality output; name the command"):
        own.measured(MeasuredSignal("c", "input", "m", "", "y"), "the plan")
