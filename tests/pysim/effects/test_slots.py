"""Slots of our pump and of a user's model, read from the text, and which effects they take."""

from pathlib import Path

import pytest

from pysim.effects import fitting, read_catalogue, slots
from pysim.types import BadInput
from tests.modelica.library import LIBRARY
from tests.modelica.test_probes import SLOTS
from tests.pysim.effects.test_catalogue import library

FREE = "HydraulicTestBench.Pump.FreeGreyBox"

AXIS = """
package Axis
  partial model PartialTorque
    input Real w(unit="rad/s");
    output Real tau(unit="N.m");
  end PartialTorque;
  model NoTorque extends PartialTorque; equation tau = 0; end NoTorque;
  model Filtered "A law with a state of its own"
    extends PartialTorque;
    Real z(start=0, fixed=true);
  equation
    der(z) = w - z;
    der(tau) = z;
  end Filtered;
  model Cogging
    extends PartialTorque;
    parameter Real T_c(unit="N.m", min=0, max=1) = 0;
  equation
    tau = T_c;
    annotation(__HydraulicTestBench(effect="axis.cogging", slot="bearing"));
  end Cogging;
  model Homeless
    extends PartialTorque;
    parameter Real T_c(unit="N.m", min=0, max=1) = 0;
  equation
    tau = T_c;
    annotation(__HydraulicTestBench(effect="axis.homeless", slot="nowhere"));
  end Homeless;
  model Stranger "Of the right slot's name, but not of its kind"
    parameter Real T_c(unit="N.m", min=0, max=1) = 0;
    output Real tau = T_c;
    annotation(__HydraulicTestBench(effect="axis.stranger", slot="bearing"));
  end Stranger;
  model Bare "Slots, one of them without constrainedby"
    replaceable NoTorque bearing "At the motor" annotation(Dialog(tab="constrainedby"));
    replaceable Filtered far(z(start=1)) constrainedby PartialTorque(w(min=0)) "At the load";
    replaceable Real number = 3;
    NoTorque fixed;
  equation
    bearing.w = 1; far.w = 2; fixed.w = 3;
  end Bare;
  model Tuned extends Bare; end Tuned;
end Axis;
"""


def test_the_pumps_slots_are_those_of_the_guide() -> None:
    found = {slot.name: slot for slot in slots(FREE, [LIBRARY])}
    assert {name: set(slot.gives) for name, slot in found.items()} == {name: set(of) for name, of in SLOTS.items()}
    assert found["pistonForce"].takes == "HydraulicTestBench.Interfaces.PartialPistonForce"
    assert found["pistonForce"].filling == "HydraulicTestBench.Interfaces.Neutral.PistonForce"
    assert found["pistonForce"].description == "Force on the piston beside Eq. 3.9"


def test_what_a_slot_sees() -> None:
    found = {slot.name: slot for slot in slots(FREE, [LIBRARY])}
    assert (found["pistonForce"].sees, found["pistonForce"].nodes) == (("x", "v"), ())
    assert (found["angleSensor"].sees, found["oil"].sees) == (("s", "s_t"), ("p1", "p2"))
    assert (found["supply"].sees, found["supply"].nodes) == (("Q",), ("Q",))
    assert (found["spool"].sees, found["internalLeakage"].sees) == (("u_ref",), ("dp",))


@pytest.mark.parametrize("name", ["Axis.Bare", "Axis.Tuned"])
def test_a_users_slots(tmp_path: Path, name: str) -> None:
    bearing, far = slots(name, [library(tmp_path, AXIS)])
    assert (bearing.name, bearing.filling, bearing.takes) == ("bearing", "Axis.NoTorque", "Axis.PartialTorque")
    assert (bearing.gives, bearing.description) == (("tau",), "At the motor")
    assert (far.name, far.takes, far.gives, far.description) == ("far", "Axis.PartialTorque", ("tau",), "At the load")


def test_an_effect_fits_by_name_and_kind(tmp_path: Path) -> None:
    places = [LIBRARY, library(tmp_path, AXIS)]
    catalogue = read_catalogue(*places)
    bench = fitting(catalogue, "HydraulicTestBench.LoadCircuit.OpenTestBench", places)
    assert [effect.name for effect in fitting(catalogue, "Axis.Tuned", places)] == ["axis.cogging"]
    own = {"axis.cogging", "axis.homeless", "axis.stranger"}
    assert {e.name for e in catalogue} - {e.name for e in fitting(catalogue, FREE, places)} - {
        e.name for e in bench
    } == own


def test_an_unknown_class_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"no class Axis\.Nothing"):
        slots("Axis.Nothing", [library(tmp_path, AXIS)])
