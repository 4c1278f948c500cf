"""modelDescription.xml of FMI 2.0, for model exchange and co-simulation."""

from collections.abc import Iterable
from xml.etree.ElementTree import Element

from fmu_build.emit.description import (
    GENERATION_TOOL,
    Description,
    add,
    add_default_experiment,
    add_log_categories,
    add_units,
    enumeration_name,
    enumerations,
    flag,
    initial_of,
    limits,
    needs_completed_steps,
    reinitialised,
    start_of,
    text_of,
    unit_attributes,
    xml_type,
)
from fmu_build.emit.structure import ModelStructure, Unknown, model_structure
from fmu_build.lower.ode_model import OdeModel, Variable

_ABILITIES = {
    "canNotUseMemoryManagementFunctions": "true",  # the runtime takes its one block from calloc
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "true",
}


def fmi2_description(model: OdeModel, about: Description) -> str:
    """The XML text for a model whose variable table is complete; a value reference is a row of it."""
    structure = model_structure(model)
    root = Element(
        "fmiModelDescription",
        {
            "fmiVersion": "2.0",
            "modelName": model.name,
            "guid": about.token,
            **({"description": model.description} if model.description else {}),
            "generationTool": GENERATION_TOOL,
            "variableNamingConvention": "structured",
            "numberOfEventIndicators": str(len(structure.event_indicators)),
        },
    )
    _add_interfaces(root, model, about)
    add_units(root, model.variables)
    _add_types(root, model)
    add_log_categories(root)
    add_default_experiment(root, model.default_experiment)
    _add_variables(root, model)
    _add_structure(root, structure)
    return text_of(root)


def _add_interfaces(root: Element, model: OdeModel, about: Description) -> None:
    exchange = add(
        root,
        "ModelExchange",
        modelIdentifier=about.identifier,
        completedIntegratorStepNotNeeded=flag(not needs_completed_steps(model)),
        **_ABILITIES,
    )
    simulation = add(
        root,
        "CoSimulation",
        modelIdentifier=about.identifier,
        canHandleVariableCommunicationStepSize="true",
        **_ABILITIES,
    )
    for interface in (exchange, simulation):
        files = add(interface, "SourceFiles")
        for name in about.sources:
            add(files, "File", name=name)


def _add_types(root: Element, model: OdeModel) -> None:
    found = list(enumerations(model.variables))
    if not found:
        return
    parent = add(root, "TypeDefinitions")
    for name, literals in found:
        element = add(add(parent, "SimpleType", name=name), "Enumeration")
        for value, literal in enumerate(literals, start=1):
            add(element, "Item", name=literal, value=str(value))


def _add_variables(root: Element, model: OdeModel) -> None:
    parent = add(root, "ModelVariables")
    row_of = {variable.name: row for row, variable in enumerate(model.variables)}
    reinit = reinitialised(model)
    for row, variable in enumerate(model.variables):
        element = add(
            parent,
            "ScalarVariable",
            name=variable.name,
            valueReference=str(row),
            description=variable.description or None,
            causality=variable.causality,
            variability=variable.variability,
            initial=initial_of(variable),
        )
        state = variable.derivative_of
        add(
            element,
            xml_type(variable),
            declaredType=enumeration_name(variable.enumeration) if variable.enumeration else None,
            quantity=_quantity(variable),
            **unit_attributes(variable),
            **limits(variable),
            start=start_of(variable),
            derivative=None if state is None else str(row_of[state] + 1),
            reinit="true" if variable.vector == "x" and variable.index in reinit else None,
        )


def _quantity(variable: Variable) -> str | None:
    return None if xml_type(variable) == "Boolean" else variable.quantity or None


def _add_structure(root: Element, structure: ModelStructure) -> None:
    parent = add(root, "ModelStructure")
    _add_unknowns(parent, "Outputs", structure.outputs)
    _add_unknowns(parent, "Derivatives", structure.derivatives)
    _add_unknowns(parent, "InitialUnknowns", structure.initial_unknowns)


def _add_unknowns(parent: Element, tag: str, unknowns: Iterable[Unknown]) -> None:
    """FMI 2 counts variables from 1."""
    listed = list(unknowns)
    if not listed:
        return
    group = add(parent, tag)
    for unknown in listed:
        add(
            group,
            "Unknown",
            index=str(unknown.row + 1),
            dependencies=" ".join(str(row + 1) for row in unknown.dependencies),
            dependenciesKind=None if unknown.kinds is None else " ".join(unknown.kinds),
        )
