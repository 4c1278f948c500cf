"""Refuses redeclarations and modifications that rumoca 0.10.2 would drop without a word.

It follows `redeclare X part` only in the modification of a component, or of the very class that declares `part`.
Through a base class that merely inherits the part, inside another modification, as an element of its own or behind
`constrainedby`, the redeclaration is lost and the model silently stays what it was. `redeclare model X = Y` is
followed through bases and as an element too, but not inside another modification; `redeclare model extends X` ends
rumoca's process.

`redeclare model X = Y(k = 1)` loses k in a modification and keeps it as an element of its own.

What stands behind `constrainedby` holds for what a part is redeclared to, and not for what it is by itself; without a
`constrainedby` of its own the part's own modification holds, but rumoca lets it do so where there is one too. For
`replaceable model X = Y(k = 1)` neither holds.

Of `part(attribute = a) = value` nothing is left in an extends clause, nor inside another modification.
"""

from fmu_build.front.class_lookup import ClassLookup, FoundClass
from fmu_build.front.declarations import (
    Declaration,
    Kind,
    behind_indices,
    bracket,
    dotted_name,
    modifiers,
)
from fmu_build.front.used_classes import Redeclaration, is_use, redeclarations, used_classes

MODIFIABLE = ("model", "block", "class", "record")


def refuse_lost_redeclarations(source: FoundClass, classes: ClassLookup) -> None:
    """Look through the class, its bases, the classes of its parts, and those they are redeclared to.

    Raises:
        BuildError: a redeclaration would be lost; says what to write instead.
    """
    for here in used_classes(source, classes):
        for declaration in here.text.declarations:
            _check_element(declaration, here)
            _check_constraint(declaration, here, classes)
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


def _check_constraint(declaration: Declaration, here: FoundClass, classes: ClassLookup) -> None:
    """Refuse what stands behind `constrainedby` alone, unless the default class cannot be used anyway."""
    of_class = declaration.kind is Kind.EXTENDS
    repeated = [] if of_class else list(_own_modifiers(declaration).values())
    lost = [text for text in _constraint(declaration).values() if text not in repeated]
    default = classes.resolve(declaration.class_name, here)
    is_usable = of_class or default is None or "partial" not in default.text.prefixes
    if lost and is_usable and here.text.kind in MODIFIABLE:
        cure = f"write it at each part of class {here.text.name}" if of_class else "write it before constrainedby too"
        raise here.error(f"the compiler would lose {lost[0]} behind constrainedby; {cure}", declaration.offset)


def _constraint(declaration: Declaration) -> dict[str, str]:
    return modifiers(bracket(declaration.constraint, dotted_name(declaration.constraint, 1)[1]))


def _own_modifiers(declaration: Declaration, part: str = "") -> dict[str, str]:
    """Those in the brackets of a base, or of a component, or of one of several."""
    tokens = declaration.modification
    at = 0
    if declaration.kind is Kind.COMPONENT:
        names = (part,) if part else declaration.declared
        at = next((k + 1 for k, (word, _) in enumerate(tokens) if word in names), len(tokens))
    return modifiers(bracket(tokens, behind_indices(tokens, at)))


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
    declared = (one for one in classes.elements(found.part, used) if "replaceable" in one[1].prefixes)
    owner, replaced = next(declared, (None, None))
    if owner is None or replaced is None:
        raise here.error(f"{used.full_name} has no replaceable part {found.part} to redeclare", found.offset)
    if owner.full_name != used.full_name and declaration.kind is Kind.EXTENDS and not found.kind:
        raise here.error(
            f"the compiler cannot redeclare {found.part} through {used.full_name}, which only inherits it; extend "
            f"{owner.full_name} instead, with the modifications that {used.full_name} makes",
            found.offset,
        )
    if found.kind in MODIFIABLE and found.modification:
        raise here.error(
            f"the compiler would lose the modification of {found.class_name} here; write it as an element of its own, "
            f"redeclare {found.kind} {found.part} = {found.class_name}(...);, of a class that extends {used.full_name}",
            found.offset,
        )
    _check_what_it_replaces(found, replaced, owner, here)


def _check_what_it_replaces(found: Redeclaration, replaced: Declaration, owner: FoundClass, here: FoundClass) -> None:
    """Refuse where a modification of the part replaced holds for the new one, or does not, contrary to Modelica."""
    if replaced.kind is Kind.COMPONENT:
        given = {**_constraint(replaced), **modifiers(found.modification)}
        kept = [name for name in _own_modifiers(replaced, found.part) if name not in given]
        if replaced.constraint and kept:
            raise here.error(
                f"the compiler would keep {kept[0]} of the part {found.part} that this replaces; give {kept[0]} here, "
                f"or behind constrainedby in {owner.full_name}",
                found.offset,
            )
    elif found.kind in MODIFIABLE:
        default = owner.text.classes[found.part]
        bases = default.declarations if default.words[:1] == ("=",) else []
        lost = [name for base in bases if not base.constraint for name in _own_modifiers(base)]
        if lost:
            raise here.error(
                f"the compiler would lose {lost[0]} of the class {found.part} that this replaces; give {lost[0]} to "
                f"the parts of that class in {owner.full_name}",
                found.offset,
            )
