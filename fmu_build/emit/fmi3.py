"""modelDescription.xml of FMI 3.0, for model exchange and co-simulation, and its buildDescription.xml."""

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
from fmu_build.emit.structure import ModelStructure, model_structure
from fmu_build.lower.ode_model import OdeModel

_ABILITIES = {
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "providesDirectionalDerivatives": "true",
    "providesAdjointDerivatives": "true",
}
_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}


def fmi3_description(model: OdeModel, about: Description) -> str:
    """The XML text for a model whose variable table is complete; a value reference is a row of it."""
    root = Element(
        "fmiModelDescription",
        {
            "fmiVersion": "3.0",
            "modelName": model.name,
            "instantiationToken": about.token,
            **({"description": model.description} if model.description else {}),
            "generationTool": GENERATION_TOOL,
            "variableNamingConvention": "structured",
        },
    )
    _add_interfaces(root, model, about)
    add_units(root, model.variables)
    _add_types(root, model)
    add_log_categories(root)
    add_default_experiment(root, model.default_experiment)
    _add_variables(root, model)
    structure = model_structure(model)
    _add_structure(root, structure)
    add_memory(add(add(root, "Annotations"), "Annotation", type=GENERATION_TOOL), structure)
    return text_of(root)


def fmi3_build_description(about: Description) -> str:
    """sources/buildDescription.xml: how to compile the sources elsewhere."""
    root = Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    configuration = add(root, "BuildConfiguration", modelIdentifier=about.identifier)
    files = add(configuration, "SourceFileSet", language="C11")
    for name in about.sources:
        add(files, "SourceFile", name=name)
    return text_of(root)


def _add_interfaces(root: Element, model: OdeModel, about: Description) -> None:
    add(
        root,
        "ModelExchange",
        modelIdentifier=about.identifier,
        needsCompletedIntegratorStep=flag(needs_completed_steps(model)),
        **_ABILITIES,
    )
    add(
        root,
        "CoSimulation",
        modelIdentifier=about.identifier,
        canHandleVariableCommunicationStepSize="true",
        providesIntermediateUpdate="true",
        mightReturnEarlyFromDoStep="true",
        canReturnEarlyAfterIntermediateUpdate="true",
        hasEventMode="true",
        **_ABILITIES,
    )


def _add_types(root: Element, model: OdeModel) -> None:
    found = list(enumerations(model.variables))
    if not found:
        return
    parent = add(root, "TypeDefinitions")
    for name, literals in found:
        element = add(parent, "EnumerationType", name=name)
        add_items(element, literals)


def _add_variables(root: Element, model: OdeModel) -> None:
    parent = add(root, "ModelVariables")
    rows = {variable.name: row for row, variable in enumerate(model.variables)}
    reinit = reinitialised(model)
    for row, variable in enumerate(model.variables):
        value = value_attributes(variable, rows, reinit, first=0)
        add(parent, _TYPES[xml_type(variable)], **variable_attributes(variable, row), **value)


def _add_structure(root: Element, structure: ModelStructure) -> None:
    parent = add(root, "ModelStructure")
    for tag, unknowns in (
        ("Output", structure.outputs),
        ("ContinuousStateDerivative", structure.derivatives),
        ("InitialUnknown", structure.initial_unknowns),
        ("EventIndicator", structure.event_indicators),
    ):
        for unknown in unknowns:
            add(parent, tag, valueReference=str(unknown.row), **unknown_attributes(unknown, first=0))
