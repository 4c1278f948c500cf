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

Of `redeclare X part = value` the value is lost, and the attributes of X where the part is of a predefined type. Of
`part(attribute = a) = value` nothing is left in an extends clause, nor inside another modification. Of
`part.attribute = a` nothing is left in the modification of a component.

Of `part(x(start = 1))` an x of the parts of that part takes the start too, if it has a modification.
"""

from collections.abc import Iterator, Mapping

from fmu_build.front.rumoca.refused.miscounted import PREDEFINED
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import PREFIXES, Declaration, Kind, Modifier, modifiers
from fmu_build.text.lookup import Libraries, is_use
from fmu_build.text.modify import Redeclaration, redeclarations
from fmu_build.text.tokens import Tokens, bracket, dotted_name, split, split_name

MODIFIABLE = ("model", "block", "class", "record")


def refuse_lost_redeclarations(source: ClassText, classes: Libraries) -> None:
    """Look through the class, its bases, the classes of its parts, and those they are redeclared to.

    Raises:
        BuildError: a redeclaration would be lost; says what to write instead.
    """
    for here in classes.used(source):
        for declaration in here.declarations:
            _check_element(declaration, here)
            _check_constraint(declaration, here, classes)
            if is_use(declaration):
                _check_values(declaration, here)
                _check_dots(declaration.arguments, here)
                used = classes.resolve(declaration.class_name, here)
                _check_namesakes(declaration.modifiers, declaration, used, here, classes)
                for found in redeclarations(declaration.modification):
                    _check(found, declaration, used, here, classes)


def _check_element(declaration: Declaration, here: ClassText) -> None:
    is_followed = declaration.kind is Kind.CLASS and not here.classes[declaration.name].is_extension
    if "redeclare" in declaration.prefixes and not is_followed:
        raise here.error(
            f"the compiler cannot redeclare {declaration.name} as an element of its own; write it in the extends "
            f"clause, as in extends Base(redeclare ... {declaration.name})",
            declaration.start,
        )
    for found in redeclarations(declaration.constraint):
        raise here.error(
            f"the compiler cannot redeclare {found.part} behind constrainedby; write it in the modification of "
            f"{declaration.name} itself",
            found.start,
        )


def _check_constraint(declaration: Declaration, here: ClassText, classes: Libraries) -> None:
    """Refuse what stands behind `constrainedby` alone, unless the default class cannot be used anyway."""
    of_class = declaration.kind is Kind.EXTENDS
    repeated = [] if of_class else list(_words(declaration.modifiers).values())
    lost = [text for text in _constraint(declaration).values() if text not in repeated]
    default = classes.resolve(declaration.class_name, here)
    is_usable = of_class or default is None or "partial" not in default.prefixes
    if lost and is_usable and here.kind in MODIFIABLE:
        cure = f"write it at each part of class {here.name}" if of_class else "write it before constrainedby too"
        raise here.error(f"the compiler would lose {lost[0]} behind constrainedby; {cure}", declaration.start)


def _constraint(declaration: Declaration) -> dict[str, str]:
    tokens = declaration.constraint
    return _words(modifiers(bracket(tokens, dotted_name(tokens, 1)[1])[1:-1]))


def _words(given: Mapping[str, Modifier]) -> dict[str, str]:
    return {name: modifier.words for name, modifier in given.items()}


def _check_values(declaration: Declaration, here: ClassText) -> None:
    """Refuse a value behind the bracket of a modified part where it would be lost with the bracket."""
    lost_at = 1 if declaration.kind is Kind.EXTENDS else 2
    opened: list[int] = []
    tokens = declaration.modification
    for at, (token, _) in enumerate(tokens):
        if token in "([{":
            opened.append(at)
        elif token in ")]}":
            if not opened:  # the compiler says where the syntax is wrong
                return
            name, offset = tokens[opened.pop() - 1]
            if len(opened) >= lost_at and at + 1 < len(tokens) and tokens[at + 1][0] == "=":
                raise here.error(
                    f"the compiler loses both attributes and value of {name}(...) = ... here; set the attributes in a "
                    f"class of their own, and the value, {name} = ..., in one that extends it",
                    offset,
                )


def _check_dots(arguments: Tokens, here: ClassText) -> None:
    """Refuse names with dots on the left of a modification's equals signs."""
    for part in split(arguments, ","):
        begin = next((k for k, token in enumerate(part) if token.text not in PREFIXES), 0)
        name, behind = dotted_name(part, begin)
        if "." in name and part[behind : behind + 1] and part[behind].text in ("=", "("):
            parts = split_name(name)
            value = " = ..." if part[behind].text == "=" else "(...)"
            raise here.error(
                f"the compiler would lose what is given to {name} here; write it in brackets, "
                f"{'('.join(parts)}{value}{')' * (len(parts) - 1)}",
                part[begin].start,
            )
        for modifier in modifiers(part).values():
            _check_dots(modifier.inside, here)


def _check_namesakes(
    given: Mapping[str, Modifier], declaration: Declaration, used: ClassText | None, here: ClassText, classes: Libraries
) -> None:
    """Refuse `part(x(start = 1))` where the class of the part, which is `used`, modifies an x of its own parts."""
    if used is None:
        return
    is_part = declaration.kind is Kind.COMPONENT or given != declaration.modifiers
    for name, modifier in given.items():
        for part, inside in _modified_parts(used, classes) if modifier.inside and is_part else ():
            if part not in given and name in inside and inside[name].inside:
                raise here.error(
                    f"the compiler would give {name}({here.text(modifier.inside)}) to {part}.{name} too; write it in a "
                    f"class that extends {used.full_name}, and use that one here",
                    declaration.start,
                )
        for owner, element in classes.elements(name, used):
            inner = classes.resolve(element.class_name, owner)
            _check_namesakes(modifiers(modifier.inside), declaration, inner, here, classes)


def _modified_parts(used: ClassText, classes: Libraries) -> Iterator[tuple[str, Mapping[str, Modifier]]]:
    for one in classes.ancestry(used):
        for declaration in one.declarations:
            if declaration.kind is Kind.COMPONENT:
                yield declaration.name, declaration.modifiers
            elif declaration.kind is Kind.EXTENDS:
                yield from ((name, modifiers(m.inside)) for name, m in declaration.modifiers.items())


def _check(
    found: Redeclaration, declaration: Declaration, used: ClassText | None, here: ClassText, classes: Libraries
) -> None:
    if found.is_nested:
        raise here.error(
            f"the compiler cannot redeclare {found.part} inside a part of another part; write a class of that part "
            f"with {found.part} redeclared, and use it here",
            found.start,
        )
    if used is None:
        raise here.error(
            f"{declaration.class_name} is not found, so it is not certain that {found.part} can be redeclared; "
            "give the class its full name",
            found.start,
        )
    declared = (one for one in classes.elements(found.part, used) if "replaceable" in one[1].prefixes)
    owner, replaced = next(declared, (None, None))
    if owner is None or replaced is None:
        raise here.error(f"{used.full_name} has no replaceable part {found.part} to redeclare", found.start)
    if owner.full_name != used.full_name and declaration.kind is Kind.EXTENDS and not found.kind:
        raise here.error(
            f"the compiler cannot redeclare {found.part} through {used.full_name}, which only inherits it; extend "
            f"{owner.full_name} instead, with the modifications that {used.full_name} makes",
            found.start,
        )
    if found.has_value:
        raise here.error(
            f"the compiler would lose the value of {found.part} here; redeclare it without one in a class that extends "
            f"{used.full_name}, and give the value, {found.part} = ..., to that class",
            found.start,
        )
    if found.kind in MODIFIABLE and found.modification:
        raise here.error(
            f"the compiler would lose the modification of {found.class_name} here; write it as an element of its own, "
            f"redeclare {found.kind} {found.part} = {found.class_name}(...);, of a class that extends {used.full_name}",
            found.start,
        )
    _check_what_it_replaces(found, replaced, owner, here)


def _check_what_it_replaces(found: Redeclaration, replaced: Declaration, owner: ClassText, here: ClassText) -> None:
    """Refuse where a modification of the part replaced holds for the new one, or does not, contrary to Modelica."""
    if replaced.kind is Kind.COMPONENT:
        if replaced.class_name in PREDEFINED and found.class_name not in PREDEFINED:
            raise here.error(
                f"the compiler would leave {found.part} a {replaced.class_name} without the attributes of "
                f"{found.class_name}; let {owner.full_name} declare it with a type of its own, or give them here",
                found.start,
            )
        given = {**_constraint(replaced), **modifiers(found.modification[1:-1])}
        kept = [name for name in replaced.modifiers if name not in given]
        if replaced.constraint and kept:
            raise here.error(
                f"the compiler would keep {kept[0]} of the part {found.part} that this replaces; give {kept[0]} here, "
                f"or behind constrainedby in {owner.full_name}",
                found.start,
            )
    elif found.kind in MODIFIABLE:
        default = owner.classes[found.part]
        bases = default.declarations if default.is_short else ()
        lost = [name for base in bases if not base.constraint for name in base.modifiers]
        if lost:
            raise here.error(
                f"the compiler would lose {lost[0]} of the class {found.part} that this replaces; give {lost[0]} to "
                f"the parts of that class in {owner.full_name}",
                found.start,
            )
