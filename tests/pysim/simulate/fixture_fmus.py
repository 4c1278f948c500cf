"""Small FMUs from the C files beside this one, compiled in the test session; none of fmu_build is involved."""

from __future__ import annotations

import inspect
import re
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from xml.sax.saxutils import quoteattr

from fmpy import platform, platform_tuple, sharedLibraryExtension
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model

_SOURCES = Path(__file__).parent / "fixtures"


@dataclass(frozen=True)
class Fixture:
    """What the XML has to say of one C file."""

    source: str
    states: tuple[str, ...]
    inputs: tuple[str, ...] = ()
    parameters: tuple[tuple[str, float], ...] = ()
    outputs: tuple[str, ...] = ()
    indicators: int = 0
    starts: tuple[float, ...] = ()
    tangents: bool = True

    @property
    def table(self) -> list[tuple[str, int, dict[str, str]]]:
        """Name, value reference and attributes of every variable, in the order of the XML."""
        rows = [("time", 0, {"causality": "independent", "variability": "continuous"})]
        starts = self.starts or (0.0,) * len(self.states)
        for i, (name, start) in enumerate(zip(self.states, starts, strict=True)):
            rows.append((name, 100 + i, {"causality": "local", "initial": "exact", "start": str(start), "unit": "m"}))
        for i, name in enumerate(self.states):
            rows.append((f"der({name})", 200 + i, {"causality": "local", "derivative": name}))
        rows += [(n, 300 + i, {"causality": "input", "start": "0", "unit": "N"}) for i, n in enumerate(self.inputs)]
        fixed = {"causality": "parameter", "variability": "fixed"}
        rows += [(n, 400 + i, {**fixed, "start": str(v)}) for i, (n, v) in enumerate(self.parameters)]
        rows += [(n, 500 + i, {"causality": "output", "unit": "W"}) for i, n in enumerate(self.outputs)]
        return rows


OSCILLATOR = Fixture(
    "oscillator",
    ("x", "v"),
    inputs=("u", "u_rate"),
    parameters=(("w", 2.0), ("D", 0.1), ("lie", 0.0)),
    outputs=("power", "y_rate"),
)
BALL = Fixture(
    "ball", ("h", "v"), parameters=(("g", 9.81), ("e", 0.8)), outputs=("bounces",), indicators=1, starts=(1.0, 0.0)
)
GATES = Fixture(
    "gates",
    ("x",),
    parameters=(("a", 0.3), ("b", 0.31), ("s", 40.0)),
    outputs=("at_a", "at_b", "events"),
    indicators=2,
)
CLOCK = Fixture("clock", ("x",), parameters=(("period", 0.3), ("last", 1e9)), outputs=("level",))
STIFF = Fixture("stiff", ("x", "y"), parameters=(("rate", 1e5),), outputs=("miss",), starts=(0.0, 1.0))
FRAGILE = Fixture(
    "fragile", ("x",), parameters=(("manner", 0.0), ("refuse", 0.0)), outputs=("root",), starts=(1.0,), tangents=False
)
HOARDER = Fixture("hoarder", ("x",), inputs=("u",))
CARELESS = Fixture("careless", ("x",), outputs=("level",))
WHOLE = Fixture("whole", ("x",), outputs=("level",))
FOLLOWER = Fixture("follower", ("x",), inputs=("u",), outputs=("events", "u_seen"))


def _attributes(**values: str) -> str:
    return "".join(f" {k}={quoteattr(v)}" for k, v in values.items())


def _xml_2(f: Fixture) -> str:
    index = {name: i + 1 for i, (name, _, _) in enumerate(f.table)}
    variables = []
    for name, reference, attributes in f.table:
        real = {k: v for k, v in attributes.items() if k in ("start", "unit", "derivative")}
        if "derivative" in real:
            real["derivative"] = str(index[real["derivative"]])
        outer = {k: v for k, v in attributes.items() if k not in real and k != "derivative"}
        variables.append(
            f"<ScalarVariable{_attributes(name=name, valueReference=str(reference), **outer)}>"
            f"<Real{_attributes(**real)}/></ScalarVariable>"
        )
    unknowns = "".join(f'<Unknown index="{index[n]}"/>' for n in f.outputs)
    derivatives = "".join(f'<Unknown index="{index[f"der({n})"]}"/>' for n in f.states)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{f.source}" guid="{f.source}" numberOfEventIndicators="{f.indicators}">
<ModelExchange modelIdentifier="{f.source}" providesDirectionalDerivative="{str(f.tangents).lower()}"/>
<UnitDefinitions><Unit name="m"/><Unit name="N"/><Unit name="W"/></UnitDefinitions>
<ModelVariables>{"".join(variables)}</ModelVariables>
<ModelStructure><Outputs>{unknowns}</Outputs><Derivatives>{derivatives}</Derivatives></ModelStructure>
</fmiModelDescription>
"""


def _xml_3(f: Fixture) -> str:
    reference = {name: r for name, r, _ in f.table}
    variables, structure = [], []
    for name, number, attributes in f.table:
        values = dict(attributes)
        if "derivative" in values:
            values["derivative"] = str(reference[values["derivative"]])
        variables.append(f"<Float64{_attributes(name=name, valueReference=str(number), **values)}/>")
    structure += [f'<Output valueReference="{reference[n]}"/>' for n in f.outputs]
    structure += [f'<ContinuousStateDerivative valueReference="{reference[f"der({n})"]}"/>' for n in f.states]
    for i in range(f.indicators):
        variables.append(f'<Float64 name="z{i}" valueReference="{600 + i}" causality="local"/>')
        structure.append(f'<EventIndicator valueReference="{600 + i}"/>')
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="{f.source}" instantiationToken="{f.source}">
<ModelExchange modelIdentifier="{f.source}" needsCompletedIntegratorStep="true"
 providesDirectionalDerivatives="{str(f.tangents).lower()}"/>
<UnitDefinitions><Unit name="m"/><Unit name="N"/><Unit name="W"/></UnitDefinitions>
<ModelVariables>{"".join(variables)}</ModelVariables>
<ModelStructure>{"".join(structure)}</ModelStructure>
</fmiModelDescription>
"""


def _stubs(source: str) -> str:
    """FMPy wants every function of the standard; those that front.c and the source leave out return an error."""
    present = set(re.findall(r"fmi[23]\w+(?=\()", (_SOURCES / "front.c").read_text()))
    own = (_SOURCES / f"{source}.c").read_text()
    sizes = re.findall(r"^SIZE\((\w+),", own, re.MULTILINE)
    present |= {f"fmi3{verb}{size}" for verb in ("Get", "Set") for size in sizes}
    wanted = {n for kind in (FMU2Model, FMU3Model) for n, _ in inspect.getmembers(kind) if re.match("fmi[23][A-Z]", n)}
    return "".join(f"EXPORT int {name}(void) {{ return ERROR; }}\n" for name in sorted(wanted - present))


@lru_cache
def _library(source: str, folder: Path) -> Path:
    target, stubs = folder / f"{source}{sharedLibraryExtension}", folder / "stubs.c"
    stubs.write_text(f'#define MODEL "{source}.c"\n#include "front.c"\n' + _stubs(source))
    compiler = [shutil.which("gcc")] if shutil.which("gcc") else [sys.executable, "-m", "ziglang", "cc"]
    options = ["-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Werror", "-I", str(_SOURCES), "-o", str(target)]
    subprocess.run([*compiler, *options, str(stubs), "-lm"], check=True)
    return target


def build(fixture: Fixture, fmi: int, folder: Path) -> Path:
    """An FMU of that version in that folder."""
    path = folder / f"{fixture.source}{'' if fixture.tangents else '_plain'}_{fmi}.fmu"
    if not path.exists():
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("modelDescription.xml", _xml_2(fixture) if fmi == 2 else _xml_3(fixture))
            binary = _library(fixture.source, folder)
            archive.write(binary, f"binaries/{platform if fmi == 2 else platform_tuple}/{binary.name}")
    return path
