"""A system's FMUs and wires as an SSP 1.0 package."""

from __future__ import annotations

import io
import itertools
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from pysim.cosim.connection import Connection
from pysim.cosim.gauss_seidel import GaussSeidel
from pysim.cosim.iterated import Iterated
from pysim.cosim.members import Fmu, Isolated
from pysim.cosim.ssp._names import DESCRIPTION, OSP, RUN, SSC, SSD, SSV, base_unit
from pysim.cosim.ssp._settings import lost_settings
from pysim.cosim.system import owner
from pysim.cosim.system_file import SystemFile
from pysim.io import write_file
from pysim.types import BadInput, Model, Port

Element = ElementTree.Element
_sub = ElementTree.SubElement
_KINDS = {"Float64": "Real", "Float32": "Real", "Real": "Real", "Boolean": "Boolean", "Enumeration": "Integer"}
_IMPLEMENTATION = {"co-simulation": "CoSimulation", "model-exchange": "ModelExchange"}


@dataclass(frozen=True)
class _Package:
    """What of a system the package can hold, and in words what it cannot."""

    fmus: Mapping[str, Fmu]
    wires: tuple[Connection, ...]
    starts: Mapping[str, float]  # "member.variable" -> number
    left_out: tuple[str, ...]


def write_ssp(file: SystemFile, path: Path | str, *, fmus_only: bool = False) -> tuple[str, ...]:
    """Write an .ssp archive: the FMUs, their parameters, the wires, and the experiment's start, end and step.

    SSP holds FMUs. It has no room for Python blocks, for signals over time, nor for power bonds. Neither has it for how
    steps are doubled, sorted and iterated, nor for settings of an FMU beside its parameters: these are never refused.

    Args:
        fmus_only: leave parts without room out, and the wires to them, instead of refusing.
    Returns:
        what was left out, a phrase each; parts, then settings.
    Raises:
        BadInput: the system has parts that SSP cannot hold, or none that it can.
    """
    path = Path(path)
    package = _packed(file)
    if package.left_out and not fmus_only:
        raise BadInput(
            f"{path.name}: SSP holds FMUs and cannot hold {'; '.join(package.left_out)}; leave that out with "
            "write_ssp(..., fmus_only=True) in Python"
        )
    if not package.fmus:
        raise BadInput(f"{path.name}: the system has no FMU; there is nothing to export")
    resources = _resources(package.fmus)
    path.parent.mkdir(parents=True, exist_ok=True)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(DESCRIPTION, _description(file, package, resources))
        for fmu, name in resources.items():
            archive.write(fmu, name)
    write_file(path, content.getvalue())
    return (*package.left_out, *lost_settings(file, package.fmus))


def _packed(file: SystemFile) -> _Package:
    fmus, out, system, experiment = {}, [], file.system, file.experiment
    for member in system.members:
        core = member.member if isinstance(member, Isolated) else member
        if isinstance(core, Fmu):
            fmus[member.name] = core
        else:
            out.append(f"{member.name}, which is Python")
    wires = tuple(c for c in system.connections if {owner(c.source), owner(c.target)} <= fmus.keys())
    out += [f"the wire {c}" for c in system.connections if c not in wires]
    starts = {f"{name}.{variable}": value for name, fmu in fmus.items() for variable, value in fmu.parameters.items()}
    starts |= {name: value for name, value in experiment.overrides.items() if owner(name) in fmus}
    for name, signal in experiment.inputs.items():
        if owner(name) not in fmus:
            continue
        constant = signal.starts.size == 1 and not signal.cubics[0, 1:].any() and not signal.sines.any()
        if constant:
            starts[name] = float(signal.cubics[0, 0])
        else:
            out.append(f"the signal of {name}")
    out += [f"the power bond {bond.name}" for bond in system.bonds]
    return _Package(fmus, wires, starts, tuple(out))


def _resources(fmus: Mapping[str, Fmu]) -> dict[Path, str]:
    """File -> its name in the package; an FMU that is there twice is stored once."""
    names: dict[Path, str] = {}
    for name, fmu in fmus.items():
        if fmu.model.path not in names:
            names[fmu.model.path] = _unused((fmu.model.path.stem, name), names.values())
    return names


def _unused(stems: tuple[str, str], names: Collection[str]) -> str:
    """The first name that nobody has, also where capital letters make no difference."""
    taken = {name.casefold() for name in names}
    numbered = (f"{stems[-1]}_{k}" for k in itertools.count(2))
    candidates = (f"resources/{stem}.fmu" for stem in itertools.chain(stems, numbered))
    return next(name for name in candidates if name.casefold() not in taken)


def _description(file: SystemFile, package: _Package, resources: Mapping[Path, str]) -> bytes:
    for prefix, space in (("ssd", SSD), ("ssc", SSC), ("ssv", SSV), ("osp", OSP), ("run", RUN)):
        ElementTree.register_namespace(prefix, space)
    root = Element(f"{{{SSD}}}SystemStructureDescription", {"name": file.name, "version": "1.0"})
    system = _sub(root, f"{{{SSD}}}System", {"name": _identifier(file.name)})
    elements = _sub(system, f"{{{SSD}}}Elements")
    units: set[str] = set()
    for name, fmu in package.fmus.items():
        units |= _component(elements, name, fmu, resources[fmu.model.path], package)
    if package.wires:
        wires = _sub(system, f"{{{SSD}}}Connections")
        for connection in package.wires:
            _wire(wires, connection)
    if units:
        declared = _sub(root, f"{{{SSD}}}Units")
        for unit in sorted(units):
            _sub(_sub(declared, f"{{{SSC}}}Unit", {"name": unit}), f"{{{SSC}}}BaseUnit", base_unit(unit) or {})
    _experiment(root, file, package.fmus)
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return text


def _identifier(name: str) -> str:
    return "".join(c if c.isalnum() else "_" for c in name) or "system"


def _component(elements: Element, name: str, fmu: Fmu, source: str, package: _Package) -> set[str]:
    """One component; the units that its connectors name."""
    implementation = _IMPLEMENTATION[fmu.interface]
    component = _sub(
        elements, f"{{{SSD}}}Component", {"name": name, "source": source, "implementation": implementation}
    )
    connectors, units = _sub(component, f"{{{SSD}}}Connectors"), set()
    for kind, ports in (("input", fmu.inputs), ("output", fmu.outputs)):
        for port in ports:
            if fmu.model[port.name].causality != kind:
                continue  # what is only recorded
            units |= _connector(connectors, kind, port, fmu.model)
    starts = {n.partition(".")[2]: v for n, v in package.starts.items() if owner(n) == name}
    if starts:
        binding = _sub(_sub(component, f"{{{SSD}}}ParameterBindings"), f"{{{SSD}}}ParameterBinding")
        values = _sub(
            _sub(binding, f"{{{SSD}}}ParameterValues"), f"{{{SSV}}}ParameterSet", {"version": "1.0", "name": name}
        )
        parameters = _sub(values, f"{{{SSV}}}Parameters")
        for variable, value in starts.items():
            kind = _kind(fmu.model, variable)
            _sub(
                _sub(parameters, f"{{{SSV}}}Parameter", {"name": variable}),
                f"{{{SSV}}}{kind}",
                {"value": _text(kind, value)},
            )
    return units


def _connector(connectors: Element, kind: str, port: Port, model: Model) -> set[str]:
    connector, of_type = (
        _sub(connectors, f"{{{SSD}}}Connector", {"name": port.name, "kind": kind}),
        _kind(model, port.name),
    )
    known = of_type == "Real" and port.unit != "1" and base_unit(port.unit) is not None
    _sub(connector, f"{{{SSC}}}{of_type}", {"unit": port.unit} if known else {})
    return {port.unit} if known else set()


def _kind(model: Model, name: str) -> str:
    return _KINDS.get(model[name].type, "Integer")


def _text(kind: str, value: float) -> str:
    if kind == "Boolean":
        return "true" if value else "false"
    return repr(float(value)) if kind == "Real" else str(round(value))


def _wire(wires: Element, connection: Connection) -> None:
    (start, output), (end, target) = (name.split(".", 1) for name in (connection.source, connection.target))
    ends = {"startElement": start, "startConnector": output, "endElement": end, "endConnector": target}
    wire = _sub(wires, f"{{{SSD}}}Connection", ends)
    if (connection.gain, connection.offset) != (1.0, 0.0):
        law = {"factor": repr(connection.gain)} | ({"offset": repr(connection.offset)} if connection.offset else {})
        _sub(wire, f"{{{SSC}}}LinearTransformation", law)


def _experiment(root: Element, file: SystemFile, fmus: Mapping[str, Fmu]) -> None:
    """Start, end, and in annotations the step: for libcosim, and with the rest of the run for `read_ssp`."""
    times = file.experiment.times
    span = {"startTime": repr(file.experiment.start), "stopTime": repr(float(times[-1]))}
    annotations = _sub(_sub(root, f"{{{SSD}}}DefaultExperiment", span), f"{{{SSD}}}Annotations")
    osp = _sub(annotations, f"{{{SSC}}}Annotation", {"type": "com.opensimulationplatform"})
    _sub(_sub(osp, f"{{{OSP}}}Algorithm"), f"{{{OSP}}}FixedStepAlgorithm", {"baseStepSize": repr(file.step)})
    own = _sub(annotations, f"{{{SSC}}}Annotation", {"type": RUN})
    kind = {GaussSeidel: "gauss-seidel", Iterated: "iterated"}.get(type(file.order), "jacobi")
    lines = "true" if getattr(file.order, "lines", False) and kind != "iterated" else "false"
    every = float(times[1] - times[0]) if times.size > 1 else file.step
    run = _sub(own, f"{{{RUN}}}Run", {"step": repr(file.step), "order": kind, "lines": lines, "every": repr(every)})
    for name in (name for name in file.experiment.record if owner(name) in fmus):
        _sub(run, f"{{{RUN}}}Record", {"name": name})
