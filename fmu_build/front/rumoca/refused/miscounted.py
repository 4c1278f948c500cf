"""Finds valid declarations that rumoca 0.10.2 miscounts, where a model fails for it."""

from collections.abc import Iterator
from itertools import pairwise

from fmu_build.errors import BuildError
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Declaration, Kind
from fmu_build.text.lookup import Libraries
from fmu_build.text.tokens import bracket

PREDEFINED = ("Real", "Integer", "Boolean", "String")
_FAILURES = ("unbalanced model", "types or sizes do not agree")


def miscounted(message: str, source: ClassText, classes: Libraries) -> BuildError | None:
    """The error at the declaration that caused it; None where the message is of another kind, or none is found."""
    written = classes.full(source.full_name)
    if written is None or not message.startswith(_FAILURES):
        return None
    for here in classes.used(written):
        for declaration in here.of_kind(Kind.COMPONENT):
            if _is_outer_variable(declaration, here, classes):
                return _error(
                    here,
                    f"outer {declaration.class_name} {declaration.name} is a plain variable, which is not "
                    "supported with inner and outer; put it into a model or a connector, and make that inner and outer",
                    declaration.start,
                )
            for offset in _each_before_arrays(declaration, here, classes):
                return _error(
                    here,
                    "each in front of a modification with arrays inside is not supported; leave each out, and write "
                    "the arrays for every element",
                    offset,
                )
    return None


def _is_outer_variable(declaration: Declaration, here: ClassText, classes: Libraries) -> bool:
    if "outer" not in declaration.prefixes:
        return False
    meant = classes.resolve(declaration.class_name, here)
    return declaration.class_name in PREDEFINED if meant is None else meant.kind == "type"


def _each_before_arrays(declaration: Declaration, here: ClassText, classes: Libraries) -> Iterator[int]:
    """Offsets of `each` in `each b(k = {1, 2})`, where b is an array of parts."""
    tokens = declaration.modification
    meant = classes.resolve(declaration.class_name, here)
    for at, (word, offset) in enumerate(tokens):
        inside = bracket(tokens, at + 2) if word == "each" else ()
        has_arrays = any(token == "=" and value == "{" for (token, _), (value, _) in pairwise(inside))
        if has_arrays and meant is not None and _is_array(tokens[at + 1][0], meant, classes):
            yield offset


def _is_array(part: str, owner: ClassText, classes: Libraries) -> bool:
    for _, declaration in classes.elements(part, owner):
        if declaration.kind is Kind.COMPONENT:
            return bool(declaration.dimensions)
    return False


def _error(here: ClassText, message: str, offset: int) -> BuildError:
    return BuildError(message, *here.place(offset))
