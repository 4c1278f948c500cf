"""Parameter values of an SSP package: written in place, or in a file of the package."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

from pysim.cosim.connection import signal_conversion
from pysim.cosim.ssp._names import SSD, SSV
from pysim.types import BadInput, Model, with_place

Element = ElementTree.Element
_VALUES = frozenset(f"{{{SSV}}}{kind}" for kind in ("Real", "Integer", "Boolean", "String", "Enumeration", "Binary"))
_VALUE_FILE = "application/x-ssp-parameter-set"


class Value(NamedTuple):
    """What a parameter is set to, in the unit it is stated in; "" is the FMU's own."""

    name: str
    number: float
    unit: str


def bound_values(path: Path, folder: Path, element: Element) -> Iterator[Value]:
    """The values that the parameter bindings of a component, or of the system, give.

    Args:
        path: of the package, for messages.
        folder: where it was unpacked.
    Raises:
        BadInput: values that are no numbers, a mapping, or a file that is not in the package.
    """
    owner = element.get("name", "the system")
    for binding in element.iterfind(f"{{{SSD}}}ParameterBindings/{{{SSD}}}ParameterBinding"):
        if binding.find(f"{{{SSD}}}ParameterMapping") is not None:
            raise BadInput(f"{path}: {owner} maps parameters to other names; name them in the values as in the FMU")
        if binding.get("type", _VALUE_FILE) != _VALUE_FILE:
            raise BadInput(f"{path}: {owner} takes parameters of type {binding.get('type')}; write them as a .ssv file")
        source = binding.get("source")
        values = binding if source is None else _file(path, folder, owner, source, binding.get("sourceBase", "SSD"))
        prefix = binding.get("prefix", "")
        for parameter in values.iter(f"{{{SSV}}}Parameter"):
            yield _value(path, prefix + parameter.get("name", ""), parameter)


def in_units_of(path: Path, model: Model, value: Value) -> tuple[str, float]:
    """Name and number as the FMU has them.

    Raises:
        BadInput: the FMU has no such variable, or its unit is of another kind.
    """
    variable = with_place(str(path), lambda: model[value.name])
    known = signal_conversion(value.unit or variable.unit, variable.unit)
    if known is None:
        raise BadInput(
            f"{path}: {value.name} is given in {value.unit!r}, and the FMU has it in {variable.unit!r}; give it in that"
        )
    factor, offset = known
    return variable.name, factor * value.number + offset


def inside(path: Path, folder: Path, owner: str, source: str) -> Path:
    """The file of the package that a URI names.

    Raises:
        BadInput: it lies elsewhere.
    """
    parts = urlsplit(source)
    name = unquote(parts.path)
    file = (folder / name.replace("\0", "")).resolve()
    if parts.scheme or parts.netloc or not file.is_relative_to(folder.resolve()):
        raise BadInput(f"{path}: {owner} comes from {source!r}, outside the package; put the file into resources/")
    if "\0" in name or not file.is_file():
        raise BadInput(f"{path}: {owner} comes from {source!r}, which is not in the package; export it again")
    return file


def _file(path: Path, folder: Path, owner: str, source: str, base: str) -> Element:
    if base != "SSD":
        raise BadInput(f"{path}: {owner} takes parameters from within its FMU; put the file into resources/")
    file = inside(path, folder, f"a parameter file of {owner}", source)
    try:
        return ElementTree.parse(file).getroot()
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        raise BadInput(f"{path}: {source} cannot be read ({error}); export it again") from error


def _value(path: Path, name: str, parameter: Element) -> Value:
    found = next((child for child in parameter if child.tag in _VALUES), parameter)
    text = found.get("value", "")
    if text in ("true", "false"):
        return Value(name, float(text == "true"), "")
    try:
        return Value(name, float(text), found.get("unit", ""))
    except ValueError:
        raise BadInput(f"{path}: {name} = {text!r} is no number; only numbers can be set") from None
