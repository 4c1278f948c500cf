"""Refuses redeclarations and modifications that rumoca 0.10.2 would drop without a word.

It follows `redeclare X part` only in the modification of a component, or of the very class that declares `part`.
Through a base class that merely inherits the part, inside another modification, as an element of its own or behind
`constrainedby`, the redeclaration is lost and the model silently stays what it was. `redeclare model X = Y` is
followed through bases and as an element too, but not inside another modification; `redeclare model extends X` ends
rumoca's process.

Of `part(attribute = a) = value` nothing is left in an extends clause, nor inside another modification.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from fmu_build.front.class_lookup import ClassLookup, FoundClass
from fmu_build.front.declarations import (
    CLASS_KINDS,
    PREFIXES,
    Declaration,
    Kind,
    Token,
    behind_brackets,
    dotted_name,
)


@dataclass(frozen=True)
class Redeclaration:
    """`redeclare class_name part` or `redeclare model part = class_name` in a modification."""

    part: str
    class_name: str
    kind: str  # of the class, as "package"; empty for a part
    is_nested: bool  # inside the modification of a part
    offset: int


def refuse_lost_redeclarations(source: FoundClass, classes: ClassLookup) -> None:
    """Look through the class, its bases, the classes of its parts, and those they are redeclared to.

    Raises:
        BuildError: a redeclaration would be lost; says what to write instead.
    """
    seen = {source.full_name}
    waiting = [source]
    while waiting:
        here = waiting.pop()
        for used in _checked(here, classes):
            if used.full_name not in seen:
                seen.add(used.full_name)
                waiting.append(used)


def _checked(here: FoundClass, classes: ClassLookup) -> Iterator[FoundClass]:
    """Check each declaration of a class; yields the classes it uses."""
    for declaration in here.text.declarations:
        _check_element(declaration, here)
        if declaration.kind not in (Kind.EXTENDS, Kind.COMPONENT) and "redeclare" not in declaration.prefixes:
            continue
        used = classes.resolve(declaration.class_name, here)
        if used is not None:
            yield used
        _check_values(declaration, here)
        for found in redeclarations(declaration.modification):
            _check(found, declaration, used, here, classes)
            replacement = classes.resolve(found.class_name, here) if found.class_name else None
            if replacement is not None:
                yield replacement


def _check_element(declaration: Declaration, here: FoundClass) -> None:
    is_followed = declaration.kind is Kind.CLASS and not here.text.classes[declaration.declared[0]].is_extension
    if "redeclare" in declaration.prefixes and not is_followed:
        name = ", ".join(declaration.declared)
        raise here.error(
            f"the compiler cannot redeclare {name} as an element of its own; write it in the extends clause, as in "
            f"extends Base(redeclare ... {name})",
            declaration.offset,
        )
    for found in redeclarations(declaration.constraint):
        raise here.error(
            f"the compiler cannot redeclare {found.part} behind constrainedby; write it in the modification of "
            f"{', '.join(declaration.declared)} itself",
            found.offset,
        )


def _check_values(declaration: Declaration, here: FoundClass) -> None:
    """Refuse a value behind the bracket of a modified part where it would be lost with the bracket."""
    lost_at = 1 if declaration.kind is Kind.EXTENDS else 2
    opened: list[int] = []
    tokens = declaration.modification
    for at, (token, _) in enumerate(tokens):
        if token in "([{":
            opened.append(at)
        elif token in ")]}":
            name, offset = tokens[opened.pop() - 1]
            if len(opened) >= lost_at and at + 1 < len(tokens) and tokens[at + 1][0] == "=":
                raise here.error(
                    f"the compiler loses both attributes and value of {name}(...) = ... here; set the attributes in a "
                    f"class of their own, and the value, {name} = ..., in one that extends it",
                    offset,
                )


def _check(
    found: Redeclaration, declaration: Declaration, used: FoundClass | None, here: FoundClass, classes: ClassLookup
) -> None:
    if found.is_nested:
        raise here.error(
            f"the compiler cannot redeclare {found.part} inside a part of another part; write a class of that part "
            f"with {found.part} redeclared, and use it here",
            found.offset,
        )
    if used is None:
        raise here.error(
            f"{declaration.class_name} is not found, so it is not certain that {found.part} can be redeclared; "
            "give the class its full name",
            found.offset,
        )
    owner = _owner(found.part, used, classes, set())
    if owner is None:
        raise here.error(f"{used.full_name} has no replaceable part {found.part} to redeclare", found.offset)
    if owner.full_name != used.full_name and declaration.kind is Kind.EXTENDS and not found.kind:
        raise here.error(
            f"the compiler cannot redeclare {found.part} through {used.full_name}, which only inherits it; extend "
            f"{owner.full_name} instead, with the modifications that {used.full_name} makes",
            found.offset,
        )


def _owner(part: str, used: FoundClass, classes: ClassLookup, seen: set[str]) -> FoundClass | None:
    """The class that declares `part` replaceable: `used` or one of its bases."""
    if used.full_name in seen:
        return None
    seen.add(used.full_name)
    if any(part in element.declared and "replaceable" in element.prefixes for element in used.text.declarations):
        return used
    for element in used.of_kind(Kind.EXTENDS):
        base = classes.resolve(element.class_name, used)
        owner = _owner(part, base, classes, seen) if base is not None else None
        if owner is not None:
            return owner
    return None


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
        return Redeclaration(part, dotted_name(tokens, behind + 1)[0], tokens[at][0], is_nested, offset)
    class_name, behind = dotted_name(tokens, at)
    part = dotted_name(tokens, behind_brackets(tokens, behind))[0]
    return Redeclaration(part, class_name, "", is_nested, offset)
