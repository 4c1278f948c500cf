"""Which classes are to be compiled, and what is inside of what."""

from validation.examples.every_class import models, used_by

LIBRARY = "HydraulicTestBench"


def test_partial_classes_icons_and_functions_are_left_out() -> None:
    names = models()
    assert f"{LIBRARY}.Hydraulics.Volume" in names
    assert f"{LIBRARY}.Sources.Step" in names
    assert not {n for n in names if ".Partial" in n or ".Icons." in n or ".Functions." in n or ".UsersGuide" in n}


def test_use_is_followed_through_bases_components_and_redeclarations() -> None:
    inside = used_by([f"{LIBRARY}.Examples.SignalPorts"])
    assert f"{LIBRARY}.Hydraulics.PrescribedFlow" in inside  # a component
    assert f"{LIBRARY}.Pump.ControlPiston" in inside  # of a component's base
    assert f"{LIBRARY}.Mechanics.Wire" not in inside
    assert f"{LIBRARY}.Effects.FrictionCoulomb" not in inside  # named in texts only
