"""The readers with a right input each: Modelica, a data set, a log, an FMU's description, an SSP, a plan, a system."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType
from unittest.mock import patch

import fmu_build
from fmu_build.front import load
from pysim.bench import read_plan
from pysim.cosim import read_system_file
from pysim.cosim.ssp import read_ssp
from pysim.io import read_dataset, read_model, read_single_log
from pysim.types import BadInput

REFUSED = (BadInput, fmu_build.BuildError)
_FMU = "HydraulicTestBench.Pump.CommandRateInput"

_MODELICA = b"""package L
  partial model Slot "A law" input Real x; output Real f(unit = "N"); end Slot;
  model Spring extends Slot; parameter Real k(min = 0, unit = "N/m") = 2; equation f = -k*x; end Spring;
  model Cart
    replaceable Spring slot constrainedby Slot annotation(choicesAllMatching = true);
    parameter Integer n = 3;
    Real x[n](each start = 1, each fixed = true);
  equation
    slot.x = x[1];
    for i in 1:n loop der(x[i]) = if x[i] > 0.5 then slot.f else -x[i]; end for;
    when sample(0, 0.1) then assert(n > 1, "few"); end when;
  end Cart;
  model M extends Cart(redeclare Spring slot(k = 4), n = 2); end M;
end L;
"""
_DATASET = b"""[dataset]
name = "lag"
description = "one step"

[signals.u]
role = "input"
unit = "1"
variable = "u"

[signals.y]
role = "output"
unit = "m"
variable = "y"
noise = 1e-3

[[records]]
kind = "step"
use = "fit"
file = "a.csv"
columns = ["time", "u", "y"]
"""
_LOG = b"time (s);u (1);y (m)\n" + b"".join(b"%.2f;%d;%.4f\n" % (0.1 * k, k > 3, 0.01 * k) for k in range(12))
_SYSTEM = b"""[system]
name = "two"

[members.a]
fmu = "a.fmu"
parameters = { s = 1.0 }

[members.b]
fmu = "a.fmu"

[[connections]]
from = "a.rate"
to = "b.s_t"
factor = 2.0

[inputs]
"a.s_t" = 0.0
"b.s" = 1.0

[run]
stop = 1.0
step = 0.1
record = ["b.rate"]
order = "jacobi"
"""
_SSD = b"""<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
 xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" version="1.0" name="two"><ssd:System name="s">
<ssd:Elements>
<ssd:Component name="a" type="application/x-fmu-sharedlibrary" source="resources/a.fmu"><ssd:Connectors>
<ssd:Connector name="s" kind="input"><ssc:Real/></ssd:Connector>
<ssd:Connector name="rate" kind="output"><ssc:Real/></ssd:Connector></ssd:Connectors></ssd:Component>
<ssd:Component name="b" type="application/x-fmu-sharedlibrary" source="resources/a.fmu"><ssd:Connectors>
<ssd:Connector name="s_t" kind="input"><ssc:Real/></ssd:Connector></ssd:Connectors></ssd:Component>
</ssd:Elements>
<ssd:Connections>
<ssd:Connection startElement="a" startConnector="rate" endElement="b" endConnector="s_t"/>
</ssd:Connections>
</ssd:System><ssd:DefaultExperiment startTime="0" stopTime="1"/></ssd:SystemStructureDescription>
"""


@dataclass(frozen=True)
class Kind:
    """One reader.

    Args:
        right: an input that it takes.
        read: (input, an empty folder) -> anything; raises one of REFUSED.
    """

    right: Callable[[], bytes]
    read: Callable[[bytes, Path], object]


def _modelica(data: bytes, folder: Path) -> object:
    (folder / "L.mo").write_bytes(data)
    return load("L.M", [folder / "L.mo"], {})


def _dataset(data: bytes, folder: Path) -> object:
    (folder / "dataset.toml").write_bytes(data)
    (folder / "a.csv").write_bytes(_LOG)
    return read_dataset(folder)


def _log(data: bytes, folder: Path) -> object:
    (folder / "a.csv").write_bytes(data)
    return read_single_log(folder / "a.csv", "step", ("time", "u", "y"), ("1", "m"))


def _fmu(description: bytes, path: Path) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", description)
    return path


@cache
def _right_description() -> bytes:
    with zipfile.ZipFile(fmu_build.build(_FMU)) as archive:
        return archive.read("modelDescription.xml")


def _description(data: bytes, folder: Path) -> object:
    return read_model(_fmu(data, folder / "a.fmu"))


def _ssp(data: bytes, folder: Path) -> object:
    with zipfile.ZipFile(folder / "a.ssp", "w") as archive:
        archive.writestr("SystemStructure.ssd", data)
        archive.write(_fmu(_right_description(), folder / "a.fmu"), "resources/a.fmu")
    with patch.dict(os.environ, {"HTB_CACHE": str(folder / "cache")}):  # it unpacks: the user's cache would fill
        return read_ssp(folder / "a.ssp", step=0.1)


def _plan(data: bytes, folder: Path) -> object:
    (folder / "plan.toml").write_bytes(data)
    return read_plan(folder / "plan.toml")


def _right_plan() -> bytes:
    import pysim.bench

    return (Path(pysim.bench.__file__).parent / "plans" / "thesis.toml").read_bytes()


def _system(data: bytes, folder: Path) -> object:
    _fmu(_right_description(), folder / "a.fmu")
    (folder / "system.toml").write_bytes(data)
    return read_system_file(folder / "system.toml")


KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "Modelica": Kind(lambda: _MODELICA, _modelica),
        "data set": Kind(lambda: _DATASET, _dataset),
        "log": Kind(lambda: _LOG, _log),
        "FMU description": Kind(_right_description, _description),
        "SSP": Kind(lambda: _SSD, _ssp),
        "plan": Kind(_right_plan, _plan),
        "system": Kind(lambda: _SYSTEM, _system),
    }
)
