"""Refuses redeclarations and modifications that rumoca 0.10.2 would drop without a word.

It follows `redeclare X part` only in the modification of a component, or of the very class that declares `part`.
Through a base class that merely inherits the part, inside another modification, as an element of its own or behind
`constrainedby`, the redeclaration is lost and the model silently stays what it was. `redeclare model X = Y` is
followed through bases and as an element too, but not inside another modification; `redeclare model extends X` ends
rumoca's process.

Of `part(attribute = a) = value` nothing is left in an extends clause, nor inside another modification.
"""

from fmu_build.front.class_lookup import ClassLookup, FoundClass
from fmu_build.front.declarations import Declaration, Kind
from fmu_build.front.used_classes import Redeclaration, is_use, redeclarations, used_classes


def refuse_lost_redeclarations(source: FoundClass, classes: ClassLookup) -> None:
    """Look through the class, its bases, the classes of its parts, and those they are redeclared to.

    Raises:
        BuildError: a redeclaration would be lost; says what to write instead.
    """
    for here in used_classes(source, classes):
        for declaration in here.text.declarations:
            _check_element(declaration, here)
            if is_use(declaration):
                _check_values(declaration, here)
                used = classes.resolve(declaration.class_name, here)
                for found in redeclarations(declaration.modification):
                    _check(found, declaration, used, here, classes)


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
    declared = classes.elements(found.part, used)
    owner = next((here for here, element in declared if "replaceable" in element.prefixes), None)
    if owner is None:
        raise here.error(f"{used.full_name} has no replaceable part {found.part} to redeclare", found.offset)
    if owner.full_name != used.full_name and declaration.kind is Kind.EXTENDS and not found.kind:
        raise here.error(
            f"the compiler cannot redeclare {found.part} through {used.full_name}, which only inherits it; extend "
            f"{owner.full_name} instead, with the modifications that {used.full_name} makes",
            found.offset,
        )
