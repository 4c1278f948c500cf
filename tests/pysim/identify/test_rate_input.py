from pathlib import Path

from pysim.identify import rate_input
from pysim.types import Abilities, Model, Variable


def variable(name: str, causality: str) -> Variable:
    return Variable(name, 0, "Real", causality, "continuous", 0.0, "1", None, "", None, None, None, None)


def test_only_an_input_named_like_the_command_with_t_behind_it_takes_its_rate() -> None:
    variables = (variable("u", "input"), variable("u_t", "input"), variable("v", "input"), variable("v_t", "local"))
    model = Model(Path("m.fmu"), "m", "t", variables, Abilities(2, True, False, False, False, 0, (), ()))
    assert rate_input(model, "u") == "u_t"
    assert rate_input(model, "v") is None
    assert rate_input(model, "w") is None
