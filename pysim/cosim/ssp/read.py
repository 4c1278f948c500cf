"""An SSP 1.0 package as a system: what `write_ssp` writes, and what of other tools' packages is of that kind."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pysim.cosim._rows import row_times
from pysim.cosim.connection import Connection, signal_conversion
from pysim.cosim.gauss_seidel import GaussSeidel
from pysim.cosim.iterated import Iterated
from pysim.cosim.jacobi import Jacobi
from pysim.cosim.members import Fmu
from pysim.cosim.order import Order
from pysim.cosim.ssp._names import DESCRIPTION, OSP, RUN, SSC, SSD
from pysim.cosim.ssp._parameters import Value, bound_values, in_units_of, inside
from pysim.cosim.system import System
from pysim.cosim.system_file import SystemFile
from pysim.io import extracted, read_model
from pysim.types import BadInput, Experiment, with_place

Element = ElementTree.Element
_INTERFACE = {"CoSimulation": "co-simulation", "ModelExchange": "model-exchange", "any": ""}
_SHARED_LIBRARY = "application/x-fmu-sharedlibrary"


def read_ssp(path: Path | str, *, stop: float | None = None, step: float | None = None) -> SystemFile:
    """A system with its run.

    Understood are components that are FMUs in the package, connections between them with unit conversion or a linear
    transformation, and parameter values in place or in .ssv files, of a component or of the system. The step is that of
    our own, libcosim's or OMSimulator's annotation. Systems within systems, mappings, signal dictionaries, and inputs
    of the whole system are refused.

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
    system = _flat(path, root)
    run = root.find(f".//{{{RUN}}}Run")
    names = () if run is None else tuple(r.get("name", "") for r in run.iterfind(f"{{{RUN}}}Record"))
    members = _members(path, folder, system, names)
    wires = tuple(_wires(path, system, with_place(str(path), lambda: System(members))))
    wired = with_place(str(path), lambda: System(members, wires))
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
        root = ElementTree.parse(folder / DESCRIPTION).getroot()
    except OSError as error:
        raise BadInput(f"{path} holds no {DESCRIPTION}; it is no SSP package") from error
    except (ElementTree.ParseError, LookupError, ValueError) as error:  # the last two: of an encoding
        raise BadInput(f"{path}: its {DESCRIPTION} cannot be read ({error}); export it again") from error
    if root.tag != f"{{{SSD}}}SystemStructureDescription":
        raise BadInput(f"{path}: its {DESCRIPTION} begins with {root.tag}, which is not SSP 1.0; export it as that")
    return root


def _flat(path: Path, root: Element) -> Element:
    """The system, which is made of components alone."""
    system = root.find(f"{{{SSD}}}System")
    if system is None:
        raise BadInput(f"{path}: its {DESCRIPTION} has no System; export it again")
    for nested in system.iterfind(f"{{{SSD}}}Elements/*"):
        if nested.tag != f"{{{SSD}}}Component":
            kind = nested.tag.rpartition("}")[2]
            raise BadInput(f"{path}: {nested.get('name')} is a {kind}; flatten the system into components")
    return system


def _members(path: Path, folder: Path, system: Element, recorded: tuple[str, ...]) -> tuple[Fmu, ...]:
    """The components; values that the system gives go before their own."""
    components = list(system.iterfind(f"{{{SSD}}}Elements/{{{SSD}}}Component"))
    own = {c.get("name", ""): list(bound_values(path, folder, c)) for c in components}
    for value in bound_values(path, folder, system):
        name, _, variable = value.name.partition(".")
        if name not in own:
            raise BadInput(f"{path}: the system sets {value.name}, which is of no component; name component.variable")
        own[name].append(value._replace(name=variable))
    return tuple(_fmu(path, folder, c, own[c.get("name", "")], recorded) for c in components)


def _fmu(path: Path, folder: Path, component: Element, values: list[Value], recorded: tuple[str, ...]) -> Fmu:
    name, kind = component.get("name", ""), component.get("type", _SHARED_LIBRARY)
    implementation = component.get("implementation", "any")
    if kind != _SHARED_LIBRARY:
        raise BadInput(f"{path}: {name} is of type {kind}; only FMUs with shared libraries can be run")
    if implementation not in _INTERFACE:
        raise BadInput(f"{path}: {name} is for {implementation}; only co-simulation and model exchange can be run")
    model = read_model(inside(path, folder, name, component.get("source", "")))
    own = tuple(variable for member, _, variable in (n.partition(".") for n in recorded) if member == name)
    inner = tuple(variable for variable in own if model[variable].causality not in ("input", "output"))
    parameters = dict(in_units_of(path, model, value) for value in values)
    interface = _INTERFACE[implementation]
    return with_place(str(path), lambda: Fmu(name, model, parameters=parameters, record=inner, interface=interface))


def _wires(path: Path, system: Element, unwired: System) -> Iterator[Connection]:
    """Connections between components; what only goes out of the system has no place in a run."""
    for element in system.iterfind(f"{{{SSD}}}Connections/{{{SSD}}}Connection"):
        start, out, end, into = (
            element.get(key) for key in ("startElement", "startConnector", "endElement", "endConnector")
        )
        if out is None or into is None:
            raise BadInput(f"{path}: a connection names no connector; export it again")
        if start is None:
            raise BadInput(
                f"{path}: {end}.{into} is driven by the system's own connector {out}; connect components with each "
                "other, or give that input a value among the component's parameters"
            )
        if end is not None:
            yield _wire(path, element, f"{start}.{out}", f"{end}.{into}", unwired)


def _wire(path: Path, element: Element, source: str, target: str, unwired: System) -> Connection:
    for transformation in (child for child in element if str(child.tag).endswith("Transformation")):
        if transformation.tag != f"{{{SSC}}}LinearTransformation":
            kind = transformation.tag.rpartition("}")[2]
            raise BadInput(f"{path}: the connection to {target} has a {kind}; use a linear transformation")
        numbers = (_number(path, transformation, key, text) for key, text in (("factor", "1"), ("offset", "0")))
        return Connection(source, target, *numbers)
    ends = unwired.outputs.get(source), unwired.inputs.get(target)
    if element.get("suppressUnitConversion") not in ("true", "1") and None not in ends:
        known = signal_conversion(*(port.unit for port in ends if port is not None))
        if known is not None and known != (1.0, 0.0):
            return Connection(source, target, *known)
    return Connection(source, target)


def _step(path: Path, root: Element) -> float:
    for name, key in ((f"{{{RUN}}}Run", "step"), (f"{{{OSP}}}FixedStepAlgorithm", "baseStepSize")):
        found = root.find(f".//{name}")
        if found is not None and found.get(key) is not None:
            return _number(path, found, key)
    # OMSimulator's, whose namespace has changed over the years
    masters = (element for element in root.iter() if str(element.tag).rpartition("}")[2] == "FixedStepMaster")
    for found in masters:
        if found.get("stepSize") is not None:
            return _number(path, found, "stepSize")
    raise BadInput(f"{path} does not say its step; give one (--step)")


def _number(path: Path, element: Element, key: str, default: str = "") -> float:
    text = element.get(key, default)
    try:
        return float(text)
    except ValueError:
        kind = element.tag.rpartition("}")[2]
        raise BadInput(f"{path}: {key} = {text!r} of a {kind} is no number; export it again") from None


def _order(run: Element | None) -> Order:
    kind, lines = ("jacobi", False) if run is None else (run.get("order"), run.get("lines") == "true")
    if kind == "iterated":
        return Iterated()
    return GaussSeidel(lines=lines) if kind == "gauss-seidel" else Jacobi(lines)


def _experiment(
    path: Path, root: Element, run: Element | None, names: tuple[str, ...], step: float, stop: float | None
) -> Experiment:
    span = root.find(f"{{{SSD}}}DefaultExperiment")
    start, end = (
        np.nan if span is None else _number(path, span, key, default)
        for key, default in (("startTime", "0"), ("stopTime", "nan"))
    )
    start, end = (0.0 if np.isnan(start) else start), (end if stop is None else stop)
    if not start + step <= end < np.inf:
        raise BadInput(f"{path}: no step lies between {start:g} s and {end:g} s; give the end of the run (--stop)")
    every = step if run is None or run.get("every") is None else max(_number(path, run, "every"), step)
    rows = with_place(str(path), lambda: row_times(start, end, step, every))
    return Experiment(rows, names, start=start)
