"""Packages as other tools write them: the layout of OMSimulator and of libcosim, by hand."""

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from pysim.cosim import cosimulate
from pysim.cosim.ssp import read_ssp
from pysim.types import BadInput
from tests.pysim.cosim.described import MASS, SPRING
from tests.pysim.simulate.text_models import text_model

SPACES = " ".join(
    f'xmlns:{prefix}="http://ssp-standard.org/SSP1/{name}"'
    for prefix, name in (
        ("ssd", "SystemStructureDescription"),
        ("ssc", "SystemStructureCommon"),
        ("ssv", "SystemStructureParameterValues"),
    )
)
OMS = 'xmlns:oms="https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"'
OSP = 'xmlns:osp="http://opensimulationplatform.com/SSP/OSPAnnotations"'

# Geometry everywhere, a parameter file for the whole system, connectors of the system, the step in an annotation.
OMSIMULATOR = f"""<?xml version="1.0"?>
<ssd:SystemStructureDescription {SPACES} {OMS} name="model" version="1.0">
  <ssd:System name="root">
    <ssd:Connectors><ssd:Connector name="speed" kind="output"><ssc:Real unit="m/s"/></ssd:Connector></ssd:Connectors>
    <ssd:ParameterBindings><ssd:ParameterBinding source="resources/root%20values.ssv"/></ssd:ParameterBindings>
    <ssd:Elements>
      <ssd:Component name="mass" type="application/x-fmu-sharedlibrary" source="resources/0001_Mass.fmu">
        <ssd:Connectors>
          <ssd:Connector name="F" kind="input"><ssc:Real/><ssd:ConnectorGeometry x="0.0" y="0.5"/></ssd:Connector>
          <ssd:Connector name="v" kind="output"><ssc:Real unit="m/s"/></ssd:Connector>
          <ssd:Connector name="m" kind="parameter"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
        <ssd:ElementGeometry x1="0" y1="0" x2="1" y2="1"/>
        <ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>
          <ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>
            <ssv:Parameter name="m"><ssv:Real value="99"/></ssv:Parameter>
          </ssv:Parameters></ssv:ParameterSet>
        </ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>
      </ssd:Component>
      <ssd:Component name="spring" type="application/x-fmu-sharedlibrary" source="resources/0002_Spring.fmu"/>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="spring" startConnector="F" endElement="mass" endConnector="F">
        <ssd:ConnectionGeometry pointsX="0 1" pointsY="0 1"/>
      </ssd:Connection>
      <ssd:Connection startElement="mass" startConnector="v" endElement="spring" endConnector="v"/>
      <ssd:Connection startElement="mass" startConnector="v" endConnector="speed"/>
    </ssd:Connections>
    <ssd:Annotations><ssc:Annotation type="org.openmodelica"><oms:Annotations><oms:SimulationInformation>
      <oms:FixedStepMaster description="oms-ma" stepSize="0.001000" absoluteTolerance="0.0001"/>
    </oms:SimulationInformation></oms:Annotations></ssc:Annotation></ssd:Annotations>
  </ssd:System>
  <ssd:DefaultExperiment startTime="0.000000" stopTime="0.500000"/>
</ssd:SystemStructureDescription>
"""

VALUES = f"""<ssv:ParameterSet {SPACES} version="1.0" name="parameters"><ssv:Parameters>
  <ssv:Parameter name="mass.m"><ssv:Real value="4"/></ssv:Parameter>
  <ssv:Parameter name="spring.k"><ssv:Real value="100"/></ssv:Parameter>
</ssv:Parameters></ssv:ParameterSet>
"""

LIBCOSIM = f"""<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription {SPACES} {OSP} name="simple" version="1.0">
  <ssd:System name="simple system">
    <ssd:Elements>
      <ssd:Component name="mass" source="resources/0001_Mass.fmu"/>
      <ssd:Component name="spring" source="resources/0002_Spring.fmu"/>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="spring" startConnector="F" endElement="mass" endConnector="F">
        <ssc:LinearTransformation factor="0.5" offset="3"/>
      </ssd:Connection>
      <ssd:Connection startElement="mass" startConnector="v" endElement="spring" endConnector="v"/>
    </ssd:Connections>
  </ssd:System>
  <ssd:DefaultExperiment><ssd:Annotations><ssc:Annotation type="com.opensimulationplatform">
    <osp:Algorithm><osp:FixedStepAlgorithm baseStepSize="1e-3"/></osp:Algorithm>
  </ssc:Annotation></ssd:Annotations></ssd:DefaultExperiment>
</ssd:SystemStructureDescription>
"""


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("fmus")
    text_model(MASS, folder)
    text_model(SPRING, folder)
    text_model(SPRING.replace("Spring", "Coarse").replace("m/s", "mm/s"), folder)
    return {"0001_Mass": folder / "Mass_2.fmu", "0002_Spring": folder / "Spring_2.fmu", "mm": folder / "Coarse_2.fmu"}


def package(
    place: Path, fmus: dict[str, Path], text: str, *, spring: str = "0002_Spring", values: str = VALUES
) -> Path:
    with zipfile.ZipFile(place, "w") as archive:
        archive.writestr("SystemStructure.ssd", text)
        archive.writestr("resources/root values.ssv", values)
        archive.write(fmus["0001_Mass"], "resources/0001_Mass.fmu")
        archive.write(fmus[spring], "resources/0002_Spring.fmu")
    return place


def test_a_package_of_omsimulator_runs(tmp_path: Path, fmus: dict[str, Path]) -> None:
    file = read_ssp(package(tmp_path / "a.ssp", fmus, OMSIMULATOR))
    assert (file.name, file.step, file.experiment.times[-1]) == ("model", 1e-3, pytest.approx(0.5))
    assert [(c.source, c.target) for c in file.system.connections] == [("spring.F", "mass.F"), ("mass.v", "spring.v")]
    record = cosimulate(file.system, file.experiment, step=file.step, order=file.order)
    # The system's m = 4 goes before the component's 99: the frequency is sqrt(100/4) = 5 rad/s.
    np.testing.assert_allclose(record["mass.v"], -0.5 * np.sin(5 * record.time), atol=5e-3)


def test_a_package_of_libcosim_runs(tmp_path: Path, fmus: dict[str, Path]) -> None:
    place = package(tmp_path / "a.ssp", fmus, LIBCOSIM)
    with pytest.raises(BadInput, match="give the end of the run"):
        read_ssp(place)
    file = read_ssp(place, stop=0.2)
    record = cosimulate(file.system, file.experiment, step=file.step, order=file.order)
    # m = 2 and k = 50 under 0.5 F + 3: about 0.12 m with sqrt(12.5) rad/s, from 0.1 m
    omega = np.sqrt(12.5)
    np.testing.assert_allclose(record["mass.v"], 0.02 * omega * np.sin(omega * record.time), atol=1e-3)


def test_a_stop_between_two_steps_is_refused(tmp_path: Path, fmus: dict[str, Path]) -> None:
    place = package(tmp_path / "a.ssp", fmus, OMSIMULATOR)
    with pytest.raises(BadInput, match=r"a\.ssp: stop = 0\.2005 s is no whole number of steps of 0\.001 s"):
        read_ssp(place, stop=0.2005)


def test_units_are_converted_as_the_standard_has_it(tmp_path: Path, fmus: dict[str, Path]) -> None:
    file = read_ssp(package(tmp_path / "a.ssp", fmus, OMSIMULATOR, spring="mm"))
    assert file.system.drivers["spring.v"].factor == 1000.0
    told = OMSIMULATOR.replace('endConnector="v"/>', 'endConnector="v" suppressUnitConversion="true"/>')
    with pytest.raises(BadInput, match=r"the output is in 'm/s', the input in 'mm/s'; give factor=1000"):
        read_ssp(package(tmp_path / "b.ssp", fmus, told, spring="mm"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('source="resources/0002_Spring.fmu"', 'source="http://a.b/c.fmu"', "outside the package"),
        ('source="resources/0002_Spring.fmu"', 'source="resources/none.fmu"', "which is not in the package"),
        ('source="resources/0002_Spring.fmu"', 'source="resources/%00.fmu"', "which is not in the package"),
        ('source="resources/0002_Spring.fmu"', "", "which is not in the package|outside the package"),
        ("0001_Mass.fmu", '0001_Mass.fmu" implementation="ScheduledExecution', "only co-simulation and model exchange"),
        (
            'stopTime="0.500000"',
            'stopTime="1e300"',
            "1e\\+303 rows are more than 10,000,000; let rows be further apart",
        ),
        ("root%20values", "other", "a parameter file of root comes from 'resources/other.ssv', which is not in the"),
        ("/SSP1/SystemStructureDescription", "/Draft/SystemStructureDescription", "which is not SSP 1.0"),
        ('stepSize="0.001000"', 'stepSize="fast"', "stepSize = 'fast' of a FixedStepMaster is no number"),
        (
            '<ssd:ConnectionGeometry pointsX="0 1" pointsY="0 1"/>',
            "<ssc:BooleanMappingTransformation/>",
            "a BooleanMap",
        ),
        (
            'startElement="mass" startConnector="v" endElement="spring"',
            'startConnector="w" endElement="spring"',
            r"spring\.v is driven by the system's own connector w",
        ),
        ('<ssd:ParameterBinding source="resources/root%20values.ssv"/>', "MAPPING", "root maps parameters to other"),
    ],
)
def test_the_rest_is_refused_in_one_sentence(
    tmp_path: Path, fmus: dict[str, Path], old: str, new: str, message: str
) -> None:
    assert old in OMSIMULATOR
    mapping = (
        '<ssd:ParameterBinding source="resources/root%20values.ssv"><ssd:ParameterMapping/></ssd:ParameterBinding>'
    )
    place = package(tmp_path / "a.ssp", fmus, OMSIMULATOR.replace(old, new.replace("MAPPING", mapping)))
    with pytest.raises(BadInput, match=message) as caught:
        read_ssp(place)
    assert str(caught.value).startswith(str(place))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("mass.m", "weight", "the system sets weight, which is of no component"),
        ("mass.m", "mass.weight", "no variable 'weight'"),
        ('value="4"', 'value="4" unit="N"', "m is given in 'N', and the FMU has it in 'kg'"),
        ("</ssv:Parameters>", "", "cannot be read"),
    ],
)
def test_parameter_files_are_checked(tmp_path: Path, fmus: dict[str, Path], old: str, new: str, message: str) -> None:
    place = package(tmp_path / "a.ssp", fmus, OMSIMULATOR, values=VALUES.replace(old, new))
    with pytest.raises(BadInput, match=rf"^{re.escape(str(place))}.*{message}"):
        read_ssp(place)
