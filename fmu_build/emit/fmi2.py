"""modelDescription.xml of FMI 2.0, for model exchange and co-simulation."""

from collections.abc import Iterable
from xml.etree.ElementTree import Element

from fmu_build.emit.description import (
    GENERATION_TOOL,
    Description,
    add,
    add_default_experiment,
    add_items,
    add_log_categories,
    add_memory,
    add_units,
    enumerations,
    flag,
    needs_completed_steps,
    reinitialised,
    text_of,
    unknown_attributes,
    value_attributes,
    variable_attributes,
    xml_type,
)
from fmu_build.emit.structure import ModelStructure, Unknown, model_structure
from fmu_build.lower.ode_model import OdeModel

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
    add_memory(add(add(root, "VendorAnnotations"), "Tool", name=GENERATION_TOOL), structure)
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
        add_items(element, literals)


def _add_variables(root: Element, model: OdeModel) -> None:
    parent = add(root, "ModelVariables")
    rows = {variable.name: row for row, variable in enumerate(model.variables)}
    reinit = reinitialised(model)
    for row, variable in enumerate(model.variables):
        element = add(parent, "ScalarVariable", **variable_attributes(variable, row))
        add(element, xml_type(variable), **value_attributes(variable, rows, reinit, first=1))


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
        add(group, "Unknown", index=str(unknown.row + 1), **unknown_attributes(unknown, first=1))
