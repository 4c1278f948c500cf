"""FMUs with one fault each, from planted.c: compiled once, told apart by their token."""

import functools
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from fmu_build.pack import host_platform
from tests.generated_c import ZIG

SOURCE = Path(__file__).with_name("planted.c")
_FAULTS = re.search(r"NONE, (.*?)\n};", SOURCE.read_text(encoding="utf-8"), re.DOTALL)
FAULTS = ("NONE", *re.split(r",\s+", _FAULTS[1].strip()))

_DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Mass" guid="fault {fault}" numberOfEventIndicators="0">
<ModelExchange modelIdentifier="mass" canGetAndSetFMUstate="true" providesDirectionalDerivative="true"/>
<CoSimulation modelIdentifier="mass" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true"/>
<DefaultExperiment startTime="0" stopTime="1" stepSize="0.005"/>
<ModelVariables>
<ScalarVariable name="x" valueReference="0" causality="local" variability="continuous" initial="exact"><Real start="0.5"/></ScalarVariable>
<ScalarVariable name="v" valueReference="1" causality="local" variability="continuous" initial="exact"><Real start="0"/></ScalarVariable>
<ScalarVariable name="der(x)" valueReference="2" causality="local" variability="continuous" initial="calculated"><Real derivative="1"/></ScalarVariable>
<ScalarVariable name="der(v)" valueReference="3" causality="local" variability="continuous" initial="calculated"><Real derivative="2"/></ScalarVariable>
<ScalarVariable name="u" valueReference="4" causality="input" variability="continuous"><Real start="0"/></ScalarVariable>
<ScalarVariable name="y" valueReference="5" causality="output" variability="continuous" initial="calculated"><Real/></ScalarVariable>
<ScalarVariable name="m" valueReference="6" causality="parameter" variability="fixed" initial="exact"><Real start="2" min="0.1"/></ScalarVariable>
<ScalarVariable name="k" valueReference="7" causality="parameter" variability="fixed" initial="exact"><Real start="80"/></ScalarVariable>
<ScalarVariable name="d" valueReference="8" causality="parameter" variability="fixed" initial="exact"><Real start="1"/></ScalarVariable>
<ScalarVariable name="g" valueReference="9" causality="parameter" variability="fixed" initial="exact"><Real start="3"/></ScalarVariable>
</ModelVariables>
<ModelStructure>
<Outputs><Unknown index="6" dependencies="1"/></Outputs>
<Derivatives><Unknown index="3" dependencies="2"/>
<Unknown index="4" dependencies="1 2 5" dependenciesKind="fixed fixed fixed"/></Derivatives>
<InitialUnknowns><Unknown index="3"/><Unknown index="4"/><Unknown index="6"/></InitialUnknowns>
</ModelStructure>
</fmiModelDescription>
"""  # noqa: E501


def planted(fault: str, folder: Path) -> Path:
    """The FMU with one of FAULTS, written into the folder."""
    output = folder / f"{fault.lower()}.fmu"
    with zipfile.ZipFile(output, "w") as archive:
        archive.writestr("modelDescription.xml", _DESCRIPTION.format(fault=FAULTS.index(fault)))
        archive.writestr(f"binaries/{_platform()}/mass{_suffix()}", library())
    return output


def _platform() -> str:
    return {"linux": "linux64", "win32": "win64", "darwin": "darwin64"}[sys.platform]


def _suffix() -> str:
    return {"linux": ".so", "win32": ".dll", "darwin": ".dylib"}[sys.platform]


@functools.cache
def library() -> bytes:
    """planted.c compiled for this machine; no sanitiser, whose traps would come before the faults.

    For the target of our FMUs and without debug data, so that zig compiles its start-up code once for both.
    """
    words = ["-target", host_platform().zig_target, "-std=c11", "-O1", "-g0", "-s", "-shared"]
    words += ["-fPIC", "-Wall", "-Wextra", "-Werror", "-fno-sanitize=all"]
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / f"mass{_suffix()}"
        subprocess.run([str(ZIG), "cc", *words, str(SOURCE), "-o", str(target)], check=True)
        return target.read_bytes()
