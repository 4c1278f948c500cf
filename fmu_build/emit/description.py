"""What the modelDescription.xml files of FMI 2 and FMI 3 have in common."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from fmu_build.emit.influence import Layout, direct_influence
from fmu_build.emit.names import structured
from fmu_build.emit.structure import ModelStructure, Unknown
from fmu_build.emit.table import derivative_rows
from fmu_build.emit.units import BASE_UNITS, Unit, conversion, parse_unit
from fmu_build.errors import BuildError
from fmu_build.lower.ode_model import DefaultExperiment, OdeModel, ScalarType, Variable

GENERATION_TOOL = "fmu_build"
_ESCAPES = {"\a": r"\a", "\b": r"\b", "\f": r"\f", "\v": r"\v"}  # as Modelica writes them
_NOT_IN_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")
LOG_CATEGORIES = {  # as in runtime/src/log.c
    "logStatusError": "Calls that cannot be carried out",
    "logStatusWarning": "Assertions of level warning that do not hold",
    "logStatusDiscard": "Points where the model cannot be evaluated",
    "logEvents": "Events as they happen",
}


@dataclass(frozen=True)
class Description:
    """An XML file's content beside the model itself.

    Args:
        token: guid or instantiation token; the same as in model.c.
        sources: the .c files to compile, relative to the folder of sources.
    """

    token: str
    identifier: str
    sources: tuple[str, ...]


def model_identifier(class_name: str) -> str:
    """The name of the binary, made of the letters, digits and underscores that C allows."""
    return re.sub(r"\W", "_", class_name, flags=re.ASCII)


def text_of(root: Element) -> str:
    r"""The file's text: indented, in a fixed order, the same bytes for the same content.

    Of a sign that XML does not have, as in "\alpha", stays how Modelica writes it.
    """
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    text = _NOT_IN_XML.sub(lambda sign: _ESCAPES.get(sign[0], "\N{REPLACEMENT CHARACTER}"), text)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def add(parent: Element, tag: str, **attributes: str | None) -> Element:
    """A new child; attributes that are None are left out."""
    return ElementTree.SubElement(parent, tag, {k: v for k, v in attributes.items() if v is not None})


def number(value: float, scalar_type: ScalarType = ScalarType.REAL) -> str:
    """A value as XML Schema writes xs:double, xs:int and xs:boolean."""
    if scalar_type is ScalarType.BOOLEAN:
        return "true" if value else "false"
    if scalar_type is ScalarType.INTEGER:
        return str(round(value))
    return {"inf": "INF", "-inf": "-INF", "nan": "NaN"}.get(repr(float(value)), repr(float(value)))


def flag(value: bool) -> str:
    return "true" if value else "false"


def xml_type(variable: Variable) -> str:
    """Real, Integer, Boolean or Enumeration."""
    return "Enumeration" if variable.enumeration else variable.scalar_type.value


def variable_attributes(variable: Variable, row: int) -> dict[str, str | None]:
    """What a variable is; its value reference is its row of the table.

    Raises:
        BuildError: a name that FMI does not allow.
    """
    return {
        "name": structured(variable.name),
        "valueReference": str(row),
        "description": variable.description or None,
        "causality": variable.causality,
        "variability": variable.variability,
        "initial": _initial(variable),
    }


def value_attributes(
    variable: Variable, rows: Mapping[str, int], reinit: Collection[int], *, first: int
) -> dict[str, str | None]:
    """What its value is.

    Args:
        rows: variables' names -> rows of the table.
        reinit: rows of the continuous states that an event may change.
        first: number of the first variable: 1 in FMI 2, 0 in FMI 3.
    """
    state = variable.derivative_of
    return {
        "declaredType": enumeration_name(variable.enumeration) if variable.enumeration else None,
        "quantity": None if xml_type(variable) == "Boolean" else variable.quantity or None,
        **_unit_attributes(variable),
        **_limits(variable),
        "start": _start(variable),
        "derivative": None if state is None else str(rows[state] + first),
        "reinit": "true" if rows[variable.name] in reinit else None,
    }


def unknown_attributes(unknown: Unknown, *, first: int) -> dict[str, str | None]:
    """What an unknown of the model structure depends on; `first` as for `value_attributes`."""
    return {
        "dependencies": " ".join(str(row + first) for row in unknown.dependencies),
        "dependenciesKind": None if unknown.kinds is None else " ".join(unknown.kinds),
    }


def _initial(variable: Variable) -> str | None:
    """`initial` as FMI wants it written: not for inputs and time."""
    return None if variable.causality in ("input", "independent") else variable.initial


def _start(variable: Variable) -> str | None:
    """The start value where FMI wants one: for inputs, and with initial = exact."""
    if variable.causality == "input" or variable.initial == "exact":
        return number(variable.start or 0.0, variable.scalar_type)
    return None


def _limits(variable: Variable) -> dict[str, str | None]:
    """min, max and nominal; FMI knows a positive nominal value and those of Real only."""
    if variable.scalar_type is ScalarType.BOOLEAN:
        return {}
    found = {
        name: None if value is None else number(value, variable.scalar_type)
        for name, value in (("min", variable.min), ("max", variable.max))
    }
    if variable.scalar_type is ScalarType.REAL and variable.nominal:
        found["nominal"] = number(abs(variable.nominal))
    return found


def _unit_attributes(variable: Variable) -> dict[str, str | None]:
    """unit, and displayUnit where it is another one.

    Raises:
        BuildError: a unit that cannot be read, or cannot be shown in the other one: an importer could not convert it.
    """
    if not variable.unit or variable.scalar_type is not ScalarType.REAL:
        return {}
    unit = _readable(variable, "unit", variable.unit)
    name = variable.display_unit
    if not name or name == variable.unit:
        return {"unit": variable.unit}
    if conversion(unit, _readable(variable, "displayUnit", name)) is None:
        raise BuildError(
            f'{variable.name}: displayUnit "{name}" does not measure the same quantity as unit "{variable.unit}"; '
            "choose a unit that can be converted, with rad where an angle is meant and Hz or rev where cycles are."
        )
    return {"unit": variable.unit, "displayUnit": name}


def _readable(variable: Variable, attribute: str, text: str) -> Unit:
    unit = parse_unit(text)
    if unit is None:
        raise BuildError(
            f'{variable.name}: {attribute} "{text}" is not a unit; write it with SI symbols as "N.m", "m3/s" or '
            '"kg/(m.s2)".'
        )
    return unit


def add_units(root: Element, variables: Iterable[Variable]) -> None:
    """UnitDefinitions, in the order of first use."""
    displays: dict[str, dict[str, None]] = {}
    for variable in variables:
        attributes = _unit_attributes(variable)
        unit, display = attributes.get("unit"), attributes.get("displayUnit")
        if unit is not None:
            shown = displays.setdefault(unit, {})
            if display is not None:
                shown[display] = None
    if not displays:
        return
    parent = add(root, "UnitDefinitions")
    for name, shown in displays.items():
        _add_unit(parent, name, list(shown))


def _add_unit(parent: Element, name: str, displays: list[str]) -> None:
    element, unit = add(parent, "Unit", name=name), parse_unit(name)
    assert unit is not None  # _unit_attributes has seen to it
    exponents = {b: str(e) for b, e in zip(BASE_UNITS, unit.exponents, strict=True) if e}
    add(element, "BaseUnit", **exponents, **_scale(unit.factor, unit.offset))
    for display_name in displays:
        display = parse_unit(display_name)
        scale = None if display is None else conversion(unit, display)
        assert scale is not None  # likewise
        add(element, "DisplayUnit", name=display_name, **_scale(*scale))


def _scale(factor: float, offset: float) -> dict[str, str | None]:
    return {
        "factor": None if factor == 1.0 else number(factor),
        "offset": None if offset == 0.0 else number(offset),
    }


def enumerations(variables: Iterable[Variable]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """(type name, literals) of each enumeration, in the order of first use."""
    literals = dict.fromkeys(v.enumeration for v in variables if v.enumeration)
    return ((enumeration_name(names), names) for names in literals)


def add_items(enumeration: Element, literals: Iterable[str]) -> None:
    """Values count from 1, as in Modelica."""
    for value, literal in enumerate(literals, start=1):
        add(enumeration, "Item", name=literal, value=str(value))


def enumeration_name(literals: tuple[str, ...]) -> str:
    return f"enumeration({', '.join(literals)})"


def add_default_experiment(root: Element, experiment: DefaultExperiment) -> None:
    values = {
        "startTime": experiment.start,
        "stopTime": experiment.stop,
        "tolerance": experiment.tolerance,
        "stepSize": experiment.interval,
    }
    given = {name: number(value) for name, value in values.items() if value is not None}
    if given:
        add(root, "DefaultExperiment", **given)


def add_memory(annotation: Element, structure: ModelStructure) -> None:
    """Value references of what depends on more than states, inputs and parameters tell."""
    held, delayed = (" ".join(map(str, rows)) for rows in (structure.held, structure.delayed))
    add(annotation, "memory", held=held, delayed=delayed)


def add_log_categories(root: Element) -> None:
    parent = add(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        add(parent, "Category", name=name, description=description)


def reinitialised(model: OdeModel) -> set[int]:
    """Rows of the continuous states that an event may change; other names of these are no states to FMI."""
    s = model.symbols
    layout, masks = Layout.of(s), direct_influence(s, model.updates_x)
    return {row for k, (row, _) in enumerate(derivative_rows(model)) if masks[k] != layout.bit("x", k)}


def needs_completed_steps(model: OdeModel) -> bool:
    """Whether the host must report its steps: delay() remembers them, `assert` and constraints are looked at after."""
    return bool(model.delays or model.checks or model.constrained)
