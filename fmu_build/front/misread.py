"""Finds valid declarations that rumoca 0.10.2 miscounts, where a model fails for it."""

from collections.abc import Iterator
from itertools import pairwise

from fmu_build.errors import BuildError
from fmu_build.front.class_lookup import ClassLookup, FoundClass
from fmu_build.front.declarations import Declaration, Kind, bracket
from fmu_build.front.source import ClassSource
from fmu_build.front.used_classes import used_classes

PREDEFINED = ("Real", "Integer", "Boolean", "String")
_FAILURES = ("unbalanced model", "types or sizes do not agree")


def misread(message: str, source: ClassSource, classes: ClassLookup) -> BuildError | None:
    """The error at the declaration to blame; None where the message is of another kind, or none is found."""
    written = classes.full(source.name)
    if written is None or not message.startswith(_FAILURES):
        return None
    for here in used_classes(written, classes):
        for declaration in here.of_kind(Kind.COMPONENT):
            if _is_outer_variable(declaration, here, classes):
                return here.error(
                    f"outer {declaration.class_name} {declaration.declared[0]} is a plain variable, which is not "
                    "supported with inner and outer; put it into a model or a connector, and make that inner and outer",
                    declaration.offset,
                )
            for offset in _each_before_arrays(declaration, here, classes):
                return here.error(
                    "each in front of a modification with arrays inside is not supported; leave each out, and write "
                    "the arrays for every element",
                    offset,
                )
    return None


def _is_outer_variable(declaration: Declaration, here: FoundClass, classes: ClassLookup) -> bool:
    if "outer" not in declaration.prefixes:
        return False
    meant = classes.resolve(declaration.class_name, here)
    return declaration.class_name in PREDEFINED if meant is None else meant.text.kind == "type"


def _each_before_arrays(declaration: Declaration, here: FoundClass, classes: ClassLookup) -> Iterator[int]:
    """Offsets of `each` in `each b(k = {1, 2})`, where b is an array of parts."""
    tokens = declaration.modification
    meant = classes.resolve(declaration.class_name, here)
    for at, (word, offset) in enumerate(tokens):
        inside = bracket(tokens, at + 2) if word == "each" else ()
        has_arrays = any(token == "=" and value == "{" for (token, _), (value, _) in pairwise(inside))
        if has_arrays and meant is not None and _is_array(tokens[at + 1][0], meant, classes):
            yield offset


def _is_array(part: str, owner: FoundClass, classes: ClassLookup) -> bool:
    for _, declaration in classes.elements(part, owner):
        words = [word for word, _ in declaration.modification]
        if declaration.kind is Kind.COMPONENT:
            return words[0] == "[" or words[words.index(part) + 1 :][:1] == ["["]
    return False
