"""The library that joins ours to the Modelica Standard Library: its models, where that is installed.

A folder on MODELICAPATH that holds `Modelica`, `ModelicaServices` and `Complex.mo` of version 4.0.0 is enough for our
own compiler; OpenModelica brings its own.
"""

import os
import re
from pathlib import Path

import numpy as np
import pytest

import fmu_build
from fmu_build.openmodelica import what_is_missing
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record
from tests.modelica.library import LIBRARY

JOINED = LIBRARY.parent / "HydraulicTestBenchMSL"
PLACES = [Path(place) for place in os.environ.get("MODELICAPATH", "").split(os.pathsep) if place]
STANDARD = next((place for place in PLACES if (place / "Modelica" / "package.mo").is_file()), None)
with_standard_library = pytest.mark.skipif(STANDARD is None, reason="no Modelica 4.0.0 on MODELICAPATH")
MISSING = what_is_missing()
with_omc = pytest.mark.skipif(bool(MISSING), reason=MISSING)


def test_versions_it_uses_are_those_there_are() -> None:
    uses = re.search(r"uses\((.*?)\)\),", (JOINED / "package.mo").read_text(encoding="utf-8"))
    ours = re.search(r'version="([^"]+)"', (LIBRARY / "package.mo").read_text(encoding="utf-8"))
    assert uses
    assert ours
    assert f'HydraulicTestBench(version="{ours[1]}")' in uses[0]
    assert 'Modelica(version="4.0.0")' in uses[0]


def ran(name: str, stop: float, recorded: tuple[str, ...]) -> Record:
    assert STANDARD is not None
    libraries = [STANDARD / "Modelica", STANDARD / "ModelicaServices", JOINED]
    model = read_model(fmu_build.build(f"HydraulicTestBenchMSL.Examples.{name}", libraries=libraries))
    run = Experiment(np.linspace(0, stop, 501), recorded)
    return simulate(model, run, solver=Rodas(rtol=1e-7, atol=1e-7))


@pytest.mark.slow
@with_standard_library
def test_pump_twists_its_coupling() -> None:
    record = ran("ElasticDrive", 1.0, ("volume.p", "coupling.phi_rel", "pump.QActual", "pump.alpha"))
    end = {name: float(record[name][-1]) for name in record.names}
    torque = end["pump.alpha"] / np.deg2rad(15) * 71e-6 / (2 * np.pi) * end["volume.p"]
    assert -2e4 * end["coupling.phi_rel"] == pytest.approx(torque, rel=1e-4)
    assert 6e-6 * np.sqrt(2 / 875 * end["volume.p"]) == pytest.approx(end["pump.QActual"], rel=1e-4)


@pytest.mark.slow
@with_standard_library
def test_controller_of_blocks_reaches_its_reference() -> None:
    assert ran("SpeedControl", 30.0, ("bench.omega",))["bench.omega"][-1] == pytest.approx(20, rel=1e-3)


@pytest.mark.slow
@with_standard_library
def test_mass_is_hoisted_with_its_weight_in_the_wire() -> None:
    record = ran("Payload", 5.0, ("load.v", "wire.F_w", "load.s"))
    assert record["load.v"][-1] == pytest.approx(0.4, abs=2e-3)
    assert record["wire.F_w"][-1] == pytest.approx(4905, rel=2e-3)
    falling = record.time < 0.1  # slack: the drum has taken 0.4 t of the 0.1 m, the mass has fallen 4.9 t^2
    assert np.abs(record["load.s"] + 9.9 + 9.81 / 2 * record.time**2)[falling].max() < 1e-4
    assert record["wire.F_w"].min() == 0


@with_omc
@pytest.mark.parametrize("name", (JOINED / "Examples" / "package.order").read_text(encoding="utf-8").split())
def test_example_is_balanced_in_openmodelica(name: str) -> None:
    omc = pytest.importorskip("OMPython").OMCSessionLocal()
    try:
        assert omc.sendExpression('loadModel(Modelica, {"4.0.0"})'), omc.sendExpression("getErrorString()")
        for library in (LIBRARY, JOINED):
            assert omc.sendExpression(f'loadFile("{(library / "package.mo").as_posix()}")')
        report = omc.sendExpression(f"checkModel(HydraulicTestBenchMSL.Examples.{name})")
        counts = re.search(r"has (\d+) equation\(s\) and (\d+) variable\(s\)", report)
        assert counts, report
        assert counts[1] == counts[2], report
    finally:
        omc.sendExpression("quit()")
