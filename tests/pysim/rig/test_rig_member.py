import pytest

from pysim.cosim import System
from pysim.rig import rig_member, rig_system
from pysim.types import BadInput
from tests.pysim.rig.rigs import model


def test_there_is_no_loop_and_nothing_is_left_to_drive() -> None:
    system = rig_system(rig_member(model("LoadCircuit.Rig")))
    assert isinstance(system, System)
    assert system.loops == ()
    driven = {connection.target for connection in system.connections}
    assert {name for name, port in system.inputs.items() if name not in driven and port.start is None} == {
        "speed.reference",
        "load.reference",
        "load.speed",
    }


def test_only_the_pulses_speed_follows_a_command_at_once() -> None:
    """What the member takes off; anything else would be seen a step late."""
    declared = dict(model("LoadCircuit.Rig").abilities.feedthrough)
    follows = {name: set(inputs or ()) for name, inputs in declared.items() if inputs is None or inputs}
    assert follows == {"omegaS": {"alphaCMD"}}


def test_parameters_and_interface_are_passed_on() -> None:
    rig = rig_member(model("LoadCircuit.Rig"), interface="co-simulation", parameters={"Jeff": 0.1})
    assert rig.interface == "co-simulation"
    assert rig.parameters == {"alphaCMD_t": 0.0, "Jeff": 0.1}
    with pytest.raises(BadInput, match="no_such"):
        rig_member(model("LoadCircuit.Rig"), parameters={"no_such": 1.0})
