"""The classes that make up a model, along declarations and redeclarations."""

from collections.abc import Iterator
from dataclasses import dataclass

from fmu_build.front.class_lookup import ClassLookup, FoundClass
from fmu_build.front.declarations import (
    CLASS_KINDS,
    PREFIXES,
    Declaration,
    Kind,
    behind_indices,
    bracket,
    dotted_name,
)
from fmu_build.front.tokens import Token


@dataclass(frozen=True)
class Redeclaration:
    """`redeclare class_name part` or `redeclare model part = class_name` in a modification."""

    part: str
    class_name: str
    modification: tuple[Token, ...]  # of the new class or part, with its brackets
    kind: str  # of the class, as "package"; empty for a part
    is_nested: bool  # inside the modification of a part
    offset: int


def used_classes(source: FoundClass, classes: ClassLookup) -> Iterator[FoundClass]:
    """The class, its bases, the classes of its parts, and those they are redeclared to."""
    seen = {source.full_name}
    waiting = [source]
    while waiting:
        here = waiting.pop()
        yield here
        for name in _names(here):
            used = classes.resolve(name, here)
            if used is not None and used.full_name not in seen:
                seen.add(used.full_name)
                waiting.append(used)


def is_use(declaration: Declaration) -> bool:
    """Whether an element brings the class that it names into the model."""
    return declaration.kind in (Kind.EXTENDS, Kind.COMPONENT) or "redeclare" in declaration.prefixes


def _names(here: FoundClass) -> Iterator[str]:
    for declaration in here.text.declarations:
        if is_use(declaration):
            yield declaration.class_name
            yield from (found.class_name for found in redeclarations(declaration.modification) if found.class_name)


def redeclarations(tokens: tuple[Token, ...]) -> Iterator[Redeclaration]:
    """Those in a modification, in the modifications of its parts too."""
    depth = 0
    for at, (token, offset) in enumerate(tokens):
        depth += (token in "([{") - (token in ")]}")
        if token == "redeclare":
            yield _redeclaration(tokens, at + 1, depth > 1, offset)


def _redeclaration(tokens: tuple[Token, ...], at: int, is_nested: bool, offset: int) -> Redeclaration:
    while at < len(tokens) and tokens[at][0] in PREFIXES:
        at += 1
    if at < len(tokens) and tokens[at][0] in CLASS_KINDS:
        part, behind = dotted_name(tokens, at + 1)
        class_name, behind = dotted_name(tokens, behind + 1)
        return Redeclaration(part, class_name, bracket(tokens, behind), tokens[at][0], is_nested, offset)
    class_name, behind = dotted_name(tokens, at)
    part, behind = dotted_name(tokens, behind_indices(tokens, behind))
    modification = bracket(tokens, behind_indices(tokens, behind))
    return Redeclaration(part, class_name, modification, "", is_nested, offset)
