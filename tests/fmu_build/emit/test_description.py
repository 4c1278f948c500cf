"""modelDescription.xml of both FMI versions: no finding, and what the standard asks for in the places that matter."""

import zipfile
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from fmpy.validation import validate_fmu

from fmu_build.emit import (
    Description,
    complete_table,
    fmi2_description,
    fmi3_build_description,
    fmi3_description,
    model_identifier,
)
from fmu_build.errors import BuildError
from fmu_build.lower.ode_model import Check, ScalarType
from tests import ode_models
from tests.ode_models import PARAMETER, ode_model, real, symbols

WRITERS = {2: fmi2_description, 3: fmi3_description}


def describe(model, fmi):
    return WRITERS[fmi](complete_table(model), Description("{token}", model_identifier(model.name), ("model.c",)))


def variables(model, fmi):
    """{name: (variable's attributes, attributes of its type)}; FMI 3 has both in one element."""
    parent = ElementTree.fromstring(describe(model, fmi)).find("ModelVariables")
    return {e.get("name"): (e.attrib, e.attrib if fmi == 3 else e[0].attrib) for e in parent}


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_description_may_hold_what_xml_does_not_have(fmi):
    s = symbols(p=1)
    angle = real("angle", "p", 0, PARAMETER, start=1.0, description="Angle \alpha, \tin\nrad \x00")
    found = ElementTree.fromstring(describe(ode_model("M", s, (angle,)), fmi)).iter()
    assert "Angle \\alpha, \tin\nrad \N{REPLACEMENT CHARACTER}" in [element.get("description") for element in found]


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("build", ode_models.ALL)
def test_fmpy_finds_nothing(build, fmi, tmp_path):
    with zipfile.ZipFile(tmp_path / "m.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", describe(build(), fmi))
    assert validate_fmu(str(tmp_path / "m.fmu")) == []


@pytest.mark.parametrize("fmi", [2, 3])
def test_states_and_derivatives_are_linked(fmi):
    found = variables(ode_models.oscillator(), fmi)
    row = int(found["x"][0]["valueReference"])
    assert found["der(x)"][1]["derivative"] == str(row + (fmi == 2))
    assert found["x"][1]["start"] == "0.1"
    assert "start" not in found["der(x)"][1]
    assert "initial" not in found["F"][0]


@pytest.mark.parametrize("fmi", [2, 3])
def test_only_reinitialised_states_say_so(fmi):
    found = variables(ode_models.bouncing_ball(), fmi)
    assert "reinit" not in found["h"][1]
    assert found["v"][1]["reinit"] == "true"


@pytest.mark.parametrize("fmi", [2, 3])
def test_another_name_of_a_reinitialised_state_is_no_state(fmi):
    model = ode_models.bouncing_ball()
    speed = next(variable for variable in model.variables if variable.name == "v")
    found = variables(replace(model, variables=(*model.variables, replace(speed, name="w"))), fmi)
    assert found["v"][1]["reinit"] == "true"
    assert "reinit" not in found["w"][1]


def small(**attributes):
    s = symbols(p=1)
    return ode_model("Small", s, (real("a", "p", 0, PARAMETER, start=3.0, **attributes),))


@pytest.mark.parametrize("fmi", [2, 3])
def test_units_and_display_units(fmi):
    root = ElementTree.fromstring(describe(small(unit="m3/s", display_unit="l/min", quantity="VolumeFlowRate"), fmi))
    unit = root.find("UnitDefinitions/Unit[@name='m3/s']")
    assert unit.find("BaseUnit").attrib == {"m": "3", "s": "-1"}
    assert unit.find("DisplayUnit").attrib == {"name": "l/min", "factor": "60000.0"}
    assert variables(small(unit="m3/s", display_unit="l/min"), fmi)["a"][1]["displayUnit"] == "l/min"


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ({"unit": "foo"}, 'a: unit "foo"'),
        ({"unit": "m.foo2"}, 'a: unit "m.foo2"'),
        ({"unit": "Pa", "display_unit": "furlong"}, 'a: displayUnit "furlong"'),
    ],
)
def test_a_unit_that_cannot_be_read_is_refused(attributes, message, fmi):
    with pytest.raises(BuildError, match=message):
        describe(small(**attributes), fmi)


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_display_unit_that_is_the_unit_is_left_out(fmi):
    assert "displayUnit" not in variables(small(unit="Pa", display_unit="Pa"), fmi)["a"][1]


def test_a_display_unit_of_another_quantity_is_refused():
    with pytest.raises(BuildError, match='a: displayUnit "l/min"'):
        describe(small(unit="Pa", display_unit="l/min"), 2)
    with pytest.raises(BuildError, match=r'a: displayUnit "rad/s".*Hz or rev where cycles are'):
        describe(small(unit="1/s", display_unit="rad/s"), 2)


@pytest.mark.parametrize("fmi", [2, 3])
def test_cycles_are_shown_in_revolutions(fmi):
    root = ElementTree.fromstring(describe(small(unit="Hz", display_unit="rpm"), fmi))
    assert root.find("UnitDefinitions/Unit[@name='Hz']/BaseUnit").attrib == {"s": "-1"}
    assert root.find("UnitDefinitions/Unit/DisplayUnit").attrib == {"name": "rpm", "factor": "60.0"}


@pytest.mark.parametrize("fmi", [2, 3])
def test_enumerations_have_a_type(fmi):
    model = small(scalar_type=ScalarType.INTEGER, enumeration=("Low", "High"))
    model = replace(model, variables=(replace(model.variables[0], variability="fixed", start=2.0, min=1.0, max=2.0),))
    root = ElementTree.fromstring(describe(model, fmi))
    items = [(item.get("name"), item.get("value")) for item in root.iter("Item")]
    assert items == [("Low", "1"), ("High", "2")]
    found = variables(model, fmi)["a"][1]
    assert (found["declaredType"], found["start"], found["max"]) == ("enumeration(Low, High)", "2", "2")


@pytest.mark.parametrize("fmi", [2, 3])
def test_limits_and_special_numbers(fmi):
    found = variables(small(min=float("-inf"), max=1e60, nominal=-1e5), fmi)["a"][1]
    assert (found["min"], found["max"], found["nominal"]) == ("-INF", "1e+60", "100000.0")


def test_text_is_escaped():
    text = describe(replace(small(), description='a < b & "c"'), 3)
    assert ElementTree.fromstring(text).get("description") == 'a < b & "c"'


def test_indicators_are_counted_without_those_of_time():
    assert ElementTree.fromstring(describe(ode_models.sampled_delay(), 2)).get("numberOfEventIndicators") == "0"
    assert ElementTree.fromstring(describe(ode_models.bouncing_ball(), 2)).get("numberOfEventIndicators") == "2"


def test_build_description_lists_the_sources():
    root = ElementTree.fromstring(fmi3_build_description(Description("t", "M", ("model.c", "fmi3.c"))))
    assert [e.get("name") for e in root.iter("SourceFile")] == ["model.c", "fmi3.c"]


@pytest.mark.parametrize(("name", "identifier"), [("A.B.C", "A_B_C"), ("'ä b'.C", "___b__C")])
def test_model_identifiers_are_c_identifiers(name, identifier):
    assert model_identifier(name) == identifier


@pytest.mark.parametrize("fmi", [2, 3])
def test_steps_are_asked_for_by_delays_assertions_and_constraints(fmi):
    s = symbols(p=1)
    checked = replace(small(), checks=(Check(s.p[0] > 0, "a must be positive"),), symbols=s)
    bound = replace(ode_models.implicit_decay(), constrained=(True,))
    name, wanted = {
        2: ("completedIntegratorStepNotNeeded", "false"),
        3: ("needsCompletedIntegratorStep", "true"),
    }[fmi]
    models = (small(), False), (checked, True), (ode_models.sampled_delay(), True), (bound, True)
    for model, needs in models:
        shown = ElementTree.fromstring(describe(model, fmi)).find("ModelExchange").get(name)
        assert (shown == wanted) == needs
