"""Every model that can be run has as many equations as unknowns, each matched to one, and no input left open."""

import pytest

from tests.modelica.library import assert_balanced, compiled, models_in
from tests.modelica.test_validation import CLOSED_FORMS

RUN_THERE = {f"HydraulicTestBench.Validation.{name}" for name, *_ in CLOSED_FORMS}  # which looks at the same first
OTHERS = [name for package in ("Examples", "Validation") for name in models_in(package) if name not in RUN_THERE]
PUMP_BLOCK = ["alphaCMD", "alphaCMD_t", "omega", "p_A", "p_B"]


@pytest.mark.parametrize("name", OTHERS)
def test_model_is_balanced_and_complete(name: str) -> None:
    assert_balanced(compiled(name))


@pytest.mark.parametrize(
    ("name", "inputs"),
    [("Pump.A4VSGSignals", PUMP_BLOCK), ("LoadCircuit.OpenTestBench", ["alphaCMD", "alphaCMD_t", "u_ref"])],
)
def test_block_is_balanced(name: str, inputs: list[str]) -> None:
    assert_balanced(compiled(f"HydraulicTestBench.{name}"), inputs)


@pytest.mark.parametrize("name", ["SwashPlateControl", "FreeGreyBox", "LockedGreyBox"])
def test_pump_is_an_explicit_ode(name: str) -> None:
    """Nine states of physics and dead time, three of the command's rate; nothing has to be iterated."""
    model = compiled(f"HydraulicTestBench.Pump.{name}")
    assert_balanced(model, ["alphaCMD", "alphaCMD_t"])
    assert model.structure().n_states == 12
    assert model.structure().n_algebraic_loops == 0
