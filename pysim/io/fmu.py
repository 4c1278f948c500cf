"""Read what an FMU says of itself."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

from fmpy.model_description import ModelDescription, ModelVariable, Unknown, read_model_description

from pysim.io.archive import stamp
from pysim.io.archive_check import DAMAGED, check_archive
from pysim.types import Abilities, BadInput, CoSimulation, Model, Variable


def read_model(path: Path | str, *, faulty: bool = False) -> Model:
    """Read the variable table and the abilities of an FMU (FMI 2.0 or 3.0). Loads and extracts nothing.

    Args:
        faulty: take one whose states it does not tell, too, without those, as a check of FMUs has to.
    Raises:
        BadInput: no such file, not an FMU, one that `check_archive` refuses, FMI 1.0, or a derivative that does not
            say of which state.
    """
    path = Path(path)
    if not path.is_file():
        raise BadInput(f"no FMU at {path}; correct the path")
    try:
        check_archive(path)
        description = read_model_description(str(path), validate=False)
    except (*DAMAGED, KeyError) as error:
        raise BadInput(f"{path} is not an FMU: {error}; export it again") from error
    except BadInput:
        raise
    except Exception as error:  # FMPy raises bare exceptions for whatever it cannot read
        raise BadInput(f"{path}: its modelDescription.xml cannot be read: {' '.join(str(error).split())}") from error
    if description.fmiMajorVersion not in (2, 3):
        raise BadInput(f"{path} is an FMI {description.fmiVersion} FMU; export it as FMI 2.0 or 3.0")
    return Model(
        path=path.resolve(),
        name=description.modelName,
        token=description.guid,
        variables=tuple(_variable(v) for v in description.modelVariables),
        abilities=_abilities(description, path, _states(description, path, faulty)),
        stop_time=_stop_time(description),
        stamp=stamp(path),
        declares_units=any(_unit(v) for v in description.modelVariables if v.causality != "independent"),
    )


def _stop_time(d: ModelDescription) -> float | None:
    return _number(d.defaultExperiment.stopTime) if d.defaultExperiment is not None else None


def _variable(v: ModelVariable) -> Variable:
    return Variable(
        name=v.name,
        reference=v.valueReference,
        type=v.type + "".join(f"[{size}]" for size in v.shape or ()),
        causality=v.causality or "local",
        variability=v.variability or "continuous",
        start=_number(v.start),
        unit=_unit(v) or "1",
        display_unit=v.displayUnit or _declared(v, "displayUnit"),
        description=v.description or "",
        min=_number(v.min or _declared(v, "min")),
        max=_number(v.max or _declared(v, "max")),
        nominal=_number(v.nominal or _declared(v, "nominal")),
        derivative_of=v.derivative.name if v.derivative is not None else None,
    )


def _unit(v: ModelVariable) -> str | None:
    return v.unit or _declared(v, "unit")


def _declared(v: ModelVariable, attribute: str) -> str | None:
    """An attribute the variable takes from its type definition."""
    return getattr(v.declaredType, attribute) if v.declaredType is not None else None


def _number(text: str | None) -> float | None:
    """An attribute as a number; None where there is none, or where it is a string or an array."""
    if text in ("true", "false"):
        return float(text == "true")
    try:
        return None if text is None else float(text)
    except ValueError:
        return None


def _states(d: ModelDescription, path: Path, faulty: bool) -> tuple[str, ...]:
    """Their names in the order of the state vector."""
    for name in (u.variable.name for u in d.derivatives if u.variable.derivative is None):
        if not faulty:
            raise BadInput(
                f"{path}: its model structure lists {name} among the derivatives, no attribute says of which state; "
                "export it again with the attribute derivative"
            )
    return tuple(u.variable.derivative.name for u in d.derivatives if u.variable.derivative is not None)


def _abilities(d: ModelDescription, path: Path, states: tuple[str, ...]) -> Abilities:
    kind = d.modelExchange or d.coSimulation
    if kind is None:
        raise BadInput(f"{path} offers neither model exchange nor co-simulation; export it with one of them")
    derivatives, ours = [u.variable for u in d.derivatives], (d.generationTool or "").startswith("fmu_build ")
    root = _root(path) if ours or d.fmiMajorVersion == 3 else None
    return Abilities(
        fmi=d.fmiMajorVersion,
        model_exchange=d.modelExchange is not None,
        co_simulation=d.coSimulation is not None,
        directional_derivatives=kind.providesDirectionalDerivative
        or (root is not None and _provides_derivatives_3(root, type(kind).__name__)),
        state_handling=kind.canGetAndSetFMUstate,
        event_indicators=d.numberOfEventIndicators,
        states=states,
        derivatives=tuple(v.name for v in derivatives),
        library=kind.modelIdentifier,
        needs_completed_step=getattr(kind, "needsCompletedIntegratorStep", False),
        single_instance=kind.canBeInstantiatedOnlyOncePerProcess,
        dependencies=tuple(_dependencies(u) for u in d.derivatives),
        output_dependencies=tuple((u.variable.name, _dependencies(u)) for u in d.outputs),
        initial_dependencies=tuple((u.variable.name, _dependencies(u)) for u in d.initialUnknowns),
        feedthrough=tuple((u.variable.name, _inputs(u)) for u in d.outputs),
        stepping=_stepping(d),
        **(_memory(d, root) if root is not None and ours else {}),
    )


def _stepping(d: ModelDescription) -> CoSimulation | None:
    c = d.coSimulation
    if c is None:
        return None
    return CoSimulation(
        library=c.modelIdentifier,
        variable_step=_flag(c.canHandleVariableCommunicationStepSize),
        state_handling=_flag(c.canGetAndSetFMUstate),
        event_mode=_flag(c.hasEventMode),
        early_return=_flag(c.mightReturnEarlyFromDoStep),
        single_instance=_flag(c.canBeInstantiatedOnlyOncePerProcess),
    )


def _flag(value: bool | str) -> bool:
    return value in (True, "true", "1")


def _inputs(unknown: Unknown) -> frozenset[str] | None:
    """The inputs an output depends on, as far as it is declared."""
    if unknown.dependencies is None:
        return None
    return frozenset(v.name for v in unknown.dependencies if v.causality == "input")


def _dependencies(unknown: Unknown) -> frozenset[str] | None:
    return None if unknown.dependencies is None else frozenset(v.name for v in unknown.dependencies)


def _root(path: Path) -> ElementTree.Element:
    """modelDescription.xml itself, for what FMPy 0.3.32 does not look for.

    Raises:
        BadInput: it is not in the encoding that it names, such as UTF-16 that calls itself UTF-8.
    """
    with zipfile.ZipFile(path) as archive:
        try:
            return ElementTree.fromstring(archive.read("modelDescription.xml"))
        except (ElementTree.ParseError, LookupError, ValueError) as error:
            raise BadInput(f"{path}: its modelDescription.xml cannot be read: {error}; export it in UTF-8") from error


def _memory(d: ModelDescription, root: ElementTree.Element) -> dict[str, frozenset[str]]:
    """What an FMU built here says in an annotation of what depends on held and on delayed values; else nothing."""
    tool = root.find("./VendorAnnotations/Tool[@name='fmu_build']/memory")
    found = tool if tool is not None else root.find("./Annotations/Annotation[@type='fmu_build']/memory")
    if found is None:
        return {}
    references = {kind: {int(one) for one in found.get(kind, "").split()} for kind in ("held", "delayed")}
    return {
        kind: frozenset(v.name for v in d.modelVariables if v.valueReference in own) for kind, own in references.items()
    }


def _provides_derivatives_3(root: ElementTree.Element, kind: str) -> bool:
    """FMI 3 writes providesDirectionalDerivatives, with an s."""
    element = root.find(kind)
    return element is not None and element.get("providesDirectionalDerivatives") in ("true", "1")
