"""Every model that can be run has as many equations as unknowns, each matched to one."""

import pytest

from tests.modelica.library import compiled, models_in

PUMPS = [f"HydraulicTestBench.Pump.{name}" for name in ("SwashPlateControl", "FreeGreyBox", "LockedGreyBox")]


BLOCKS = ["HydraulicTestBench.Pump.A4VSGSignals", "HydraulicTestBench.LoadCircuit.OpenTestBench"]


@pytest.mark.parametrize("name", [*PUMPS, *BLOCKS, *models_in("Examples"), *models_in("Validation")])
def test_model_is_balanced(name: str) -> None:
    structure = compiled(name).structure()
    assert structure.n_equations == structure.n_unknowns
    assert structure.is_balanced
    assert structure.is_matched


@pytest.mark.parametrize("name", PUMPS)
def test_pump_is_an_explicit_ode(name: str) -> None:
    """Nine states of physics and dead time, three of the command's rate; nothing has to be iterated."""
    structure = compiled(name).structure()
    assert structure.n_states == 12
    assert structure.n_algebraic_loops == 0
    assert list(compiled(name).inputs.names) == ["alphaCMD", "alphaCMD_t"]


@pytest.mark.parametrize("name", [*models_in("Examples"), *models_in("Validation")])
def test_example_is_complete(name: str) -> None:
    """No input is left open."""
    assert list(compiled(name).inputs.names) == []
