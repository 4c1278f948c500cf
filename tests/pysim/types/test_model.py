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
        BadInput, match=r"of the plan: y is no input but of causality output in m\.fmu; its inputs: u; "
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
    ("role", "name", "words", "likely"),
    [
        ("output", "alfaPercent", "near it: alphaPercent", "alphaPercent"),
        ("output", "zz", "its outputs: alphaPercent, p", "..."),
        ("input", "zz", "its inputs: (none)", "..."),
    ],
)
def test_a_variable_that_is_not_there_is_said_with_its_signal_and_the_cure(
    role: str, name: str, words: str, likely: str
) -> None:
    own = model(variable("alphaPercent", "output", "%"), variable("p", "output", "Pa"), variable("q", "local"))
    with pytest.raises(BadInput) as caught:
        own.measured(shown("Weg 1", role, "%", name), "data set 'x'")
    said = f"signal 'Weg 1' of data set 'x': m.fmu has no variable '{name}'; {words}"
    cure = f'variables={{"Weg 1": "{likely}"}} in pysim.load, or variable = "{likely}" below [signals."Weg 1"]'
    assert str(caught.value) == f"{said}; write {cure}"


@pytest.mark.parametrize(
    ("causality", "variability", "moves"),
    [
        ("output", "continuous", True),
        ("output", "constant", True),  # whoever made the model says that it is measured
        ("local", "continuous", True),
        ("local", "discrete", True),
        ("input", "continuous", True),
        ("parameter", "tunable", False),
        ("calculatedParameter", "fixed", False),
        ("local", "constant", False),
        ("independent", "continuous", False),
    ],
)
def test_what_cannot_move_is_no_signal_and_is_not_offered(causality: str, variability: str, moves: bool) -> None:
    own = model(variable("y", "output", "Pa"), replace(variable("p_s", causality, "Pa"), variability=variability))
    if moves:
        assert own.measured(shown("p_s", "output", "Pa", "p_s"), "data set 'x'").name == "p_s"
        return
    for name in ("p_s", "p_l"):
        with pytest.raises(BadInput) as caught:
            own.measured(shown("c", "output", "Pa", name), "data set 'x'")
        assert str(caught.value).endswith(
            '; its outputs: y; write variables={"c": "y"} in pysim.load, or variable = "y" below [signals.c]'
        )


def test_an_input_is_offered_for_an_input_only() -> None:
    own = model(variable("u", "input"), variable("u_v", "output"))
    for role, name in (("input", "u"), ("output", "u_v")):
        with pytest.raises(BadInput, match=f'variables={{"c": "{name}"}}'):
            own.measured(shown("c", role, "1", "u_w"), "data set 'x'")


def test_a_file_of_a_cache_goes_by_the_name_of_its_model() -> None:
    digest = "31c6464d" * 8
    for stem in (digest, f"{digest}-{digest[:32]}"):
        kept = replace(model(), path=Path(f"{stem}.fmu"), name="Rig.Pump")
        assert (kept.label, model().label) == ("Rig.Pump", "m.fmu")
    with pytest.raises(BadInput, match=r"^Rig\.Pump has no variable 'x'; pysim model Rig\.Pump lists them$"):
        kept["x"]
