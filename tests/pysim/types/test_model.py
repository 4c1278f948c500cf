import pickle
from dataclasses import replace
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


def shown(name: str, role: str, unit: str, variable: str) -> MeasuredSignal:
    return MeasuredSignal(name, role, unit, "", variable)


def test_a_signal_shows_a_variable_of_its_unit_only() -> None:
    own = model(variable("u", "input", "%"), variable("y", "output", "N.m"))
    assert own.measured(shown("c", "input", "%", "u"), "the plan").name == "u"
    assert own.measured(shown("c", "output", "N.m", "y"), "the plan").name == "y"
    assert own.measured(shown("c", "output", "Nm", "y"), "the plan").name == "y"  # the same, spoken
    with pytest.raises(
        BadInput, match=r"of the plan: y is no input but of causality output in m\.fmu; name the command"
    ):
        own.measured(shown("c", "input", "N.m", "y"), "the plan")


@pytest.mark.parametrize(
    ("counts_in", "cure"),
    [
        ("bar", "pysim.io.in_model_units turns the data of a data set into the units of a model"),
        ("V", 'write unit = "V" below [signals.c], with factor and offset that turn the column into it, or another'),
        (
            "1",
            'write unit = "1" below [signals.c], with factor and offset that make the column the number of the model',
        ),
        ("furlong", 'which is no unit that is known: write unit = "1" below [signals.c], with factor and offset that'),
    ],
)
def test_another_unit_is_refused_with_a_way_out(counts_in: str, cure: str) -> None:
    with pytest.raises(BadInput) as caught:
        model(variable("y", "output", counts_in)).measured(shown("c", "output", "Pa", "y"), "data set 'x'")
    own = "without a unit" if counts_in == "1" else f"in '{counts_in}'"
    assert str(caught.value).startswith(f"signal 'c' of data set 'x' is in 'Pa', y of m.fmu {own}; {cure}")


def test_data_without_a_unit_are_the_numbers_of_a_model_whose_unit_is_not_known() -> None:
    own = model(variable("y", "output", "furlong"))
    assert own.measured(shown("c", "output", "1", "y"), "data set 'x'").name == "y"


def test_a_model_that_declares_no_units_counts_in_those_of_the_data() -> None:
    own = replace(model(variable("y", "output")), declares_units=False)
    assert own.measured(shown("c", "output", "Pa", "y"), "data set 'x'").name == "y"


@pytest.mark.parametrize(
    ("role", "name", "words"),
    [
        ("output", "alfaPercent", '; near it: alphaPercent; write variable = "alphaPercent" below [signals."Weg 1"]'),
        ("output", "zz", '; its outputs: alphaPercent, p; write variable = "..." below [signals."Weg 1"]'),
        ("input", "zz", '; its inputs: (none); write variable = "..." below [signals."Weg 1"]'),
    ],
)
def test_a_variable_that_is_not_there_is_said_with_its_signal_and_the_cure(role: str, name: str, words: str) -> None:
    own = model(variable("alphaPercent", "output", "%"), variable("p", "output", "Pa"), variable("q", "local"))
    with pytest.raises(BadInput) as caught:
        own.measured(shown("Weg 1", role, "%", name), "data set 'x'")
    assert str(caught.value) == f"signal 'Weg 1' of data set 'x': m.fmu has no variable '{name}'{words}"


def test_a_file_of_a_cache_goes_by_the_name_of_its_model() -> None:
    digest = "31c6464d" * 8
    for stem in (digest, f"{digest}-{digest[:32]}"):
        kept = replace(model(), path=Path(f"{stem}.fmu"), name="Rig.Pump")
        assert (kept.label, model().label) == ("Rig.Pump", "m.fmu")
    with pytest.raises(BadInput, match=r"^Rig\.Pump has no variable 'x'; pysim model Rig\.Pump lists them$"):
        kept["x"]
