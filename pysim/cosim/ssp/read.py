"""An SSP 1.0 package as a system: what `write_ssp` writes, and what of others is no more than that."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

from pysim.cosim.connection import Connection
from pysim.cosim.gauss_seidel import GaussSeidel
from pysim.cosim.iterated import Iterated
from pysim.cosim.jacobi import Jacobi
from pysim.cosim.members import Fmu
from pysim.cosim.order import Order
from pysim.cosim.ssp._names import DESCRIPTION, OSP, RUN, SSC, SSD, SSV
from pysim.cosim.system import System
from pysim.cosim.system_file import SystemFile
from pysim.io import extracted, read_model
from pysim.types import BadInput, Experiment, Model

Element = ElementTree.Element
_INTERFACE = {"CoSimulation": "co-simulation", "ModelExchange": "model-exchange", "any": ""}
_SHARED_LIBRARY = "application/x-fmu-sharedlibrary"


def read_ssp(path: Path | str, *, stop: float | None = None, step: float | None = None) -> SystemFile:
    """A system with its run.

    Understood are components that are FMUs in the package, connections with a factor, and parameter values written in
    place. Systems within systems, signal dictionaries, parameter files and mappings are refused.

    Args:
        stop, step: s, in place of what the package says.
    Raises:
        BadInput: no SSP package, or one with parts that are not understood.
    """
    path = Path(path)
    if not path.is_file():
        raise BadInput(f"no SSP package at {path}")
    folder = extracted(path)
    root = _parsed(path, folder)
    system = root.find(f"{{{SSD}}}System")
    if system is None:
        raise BadInput(f"{path}: its {DESCRIPTION} has no System; export it again")
    for nested in system.iterfind(f"{{{SSD}}}Elements/*"):
        if nested.tag != f"{{{SSD}}}Component":
            kind = nested.tag.rpartition("}")[2]
            raise BadInput(f"{path}: {nested.get('name')} is a {kind}; flatten the system into components")
    run = root.find(f".//{{{RUN}}}Run")
    names = () if run is None else tuple(r.get("name", "") for r in run.iterfind(f"{{{RUN}}}Record"))
    components = system.iterfind(f"{{{SSD}}}Elements/{{{SSD}}}Component")
    members = tuple(_fmu(path, folder, element, names) for element in components)
    wires = tuple(_wire(path, element) for element in system.iterfind(f"{{{SSD}}}Connections/{{{SSD}}}Connection"))
    wired = _told(path, members, wires)
    size = _step(path, root) if step is None else step
    return SystemFile(
        name=root.get("name") or path.stem,
        system=wired,
        experiment=_experiment(path, root, run, names or tuple(wired.outputs), size, stop),
        step=size,
        order=_order(run),
        doubling=None,
    )


def _parsed(path: Path, folder: Path) -> Element:
    try:
        return ElementTree.parse(folder / DESCRIPTION).getroot()
    except OSError as error:
        raise BadInput(f"{path} holds no {DESCRIPTION}; it is no SSP package") from error
    except ElementTree.ParseError as error:
        raise BadInput(f"{path}: its {DESCRIPTION} cannot be read ({error}); export it again") from error


def _told(path: Path, members: tuple[Fmu, ...], wires: tuple[Connection, ...]) -> System:
    try:
        return System(members, wires)
    except BadInput as error:
        raise BadInput(f"{path}: {error}") from error


def _fmu(path: Path, folder: Path, element: Element, recorded: tuple[str, ...]) -> Fmu:
    name, source = element.get("name", ""), element.get("source", "")
    if element.get("type", _SHARED_LIBRARY) != _SHARED_LIBRARY:
        raise BadInput(f"{path}: {name} is of type {element.get('type')}; only FMUs with shared libraries can be run")
    fmu = (folder / source).resolve()
    if not fmu.is_relative_to(folder.resolve()):
        raise BadInput(f"{path}: {name} comes from {source!r}, outside the package; put the FMU into resources/")
    model = read_model(fmu)
    interface = _INTERFACE[element.get("implementation", "any")]
    own = tuple(variable for member, _, variable in (n.partition(".") for n in recorded) if member == name)
    inner = tuple(variable for variable in own if model[variable].causality not in ("input", "output"))
    try:
        return Fmu(name, model, parameters=_parameters(path, element, model), record=inner, interface=interface)
    except BadInput as error:
        raise BadInput(f"{path}: {error}") from error


def _parameters(path: Path, component: Element, model: Model) -> dict[str, float]:
    found: dict[str, float] = {}
    for binding in component.iterfind(f"{{{SSD}}}ParameterBindings/{{{SSD}}}ParameterBinding"):
        if binding.get("source") is not None or binding.find(f"{{{SSD}}}ParameterMapping") is not None:
            raise BadInput(f"{path}: {component.get('name')} takes parameters from a file; write the values in place")
        prefix = binding.get("prefix", "")
        for parameter in binding.iterfind(f".//{{{SSV}}}Parameter"):
            name = prefix + parameter.get("name", "")
            found[model[name].name] = _number(path, name, parameter)
    return found


def _number(path: Path, name: str, parameter: Element) -> float:
    text = next((child.get("value", "") for child in parameter), "")
    if text in ("true", "false"):
        return float(text == "true")
    try:
        return float(text)
    except ValueError:
        raise BadInput(f"{path}: {name} = {text!r} is no number; only numbers can be set") from None


def _wire(path: Path, element: Element) -> Connection:
    ends = [element.get(key) for key in ("startElement", "startConnector", "endElement", "endConnector")]
    if None in ends:
        raise BadInput(f"{path}: a connection ends at the system's own connector; connect components with each other")
    factor = None
    for transformation in element:
        if transformation.tag != f"{{{SSC}}}LinearTransformation" or float(transformation.get("offset", "0")) != 0.0:
            raise BadInput(f"{path}: the connection to {ends[2]}.{ends[3]} has more than a factor; use a factor alone")
        factor = float(transformation.get("factor", "1"))
    return Connection(f"{ends[0]}.{ends[1]}", f"{ends[2]}.{ends[3]}", factor)


def _step(path: Path, root: Element) -> float:
    for space, name, key in ((RUN, "Run", "step"), (OSP, "FixedStepAlgorithm", "baseStepSize")):
        found = root.find(f".//{{{space}}}{name}")
        if found is not None and found.get(key) is not None:
            return float(found.get(key, ""))
    raise BadInput(f"{path} does not say its step; give one (--step)")


def _order(run: Element | None) -> Order:
    kind, lines = ("jacobi", False) if run is None else (run.get("order"), run.get("lines") == "true")
    if kind == "iterated":
        return Iterated()
    return GaussSeidel(lines=lines) if kind == "gauss-seidel" else Jacobi(lines)


def _experiment(
    path: Path, root: Element, run: Element | None, names: tuple[str, ...], step: float, stop: float | None
) -> Experiment:
    span = root.find(f"{{{SSD}}}DefaultExperiment")
    start, end = (float(span.get(k, "nan")) if span is not None else np.nan for k in ("startTime", "stopTime"))
    start, end = (0.0 if np.isnan(start) else start), (end if stop is None else stop)
    if not start + step <= end < np.inf:
        raise BadInput(f"{path}: no step lies between {start:g} s and {end:g} s; give the end of the run (--stop)")
    every = step if run is None or run.get("every") is None else max(float(run.get("every", "")), step)
    rows = np.asarray(start + every * np.arange(int((end - start) / every + 1e-6) + 1), dtype=np.float64)
    return Experiment(rows, names, start=start)
