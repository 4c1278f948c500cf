"""Names that cannot be resolved: rumoca quotes them without their place."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from fmu_build.errors import BuildError, WrongCall
from fmu_build.front.rumoca.refused.constants import names_used
from fmu_build.front.rumoca.refused.miscounted import PREDEFINED
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Kind
from fmu_build.text.lookup import Libraries
from fmu_build.text.tokens import is_name, split_name

_QUOTED = re.compile(r"unresolved [\w ]+: '(.+)'$|base class not found: `(.+)` does not exist$")
_STANDARD = "Modelica"


class UnresolvedName(WrongCall):
    """A name in the Modelica text that no compiler could find."""


def unresolved(message: str, source: ClassText, classes: Libraries) -> BuildError | None:
    """The error with the line where the name is written; None where the message is of another kind.

    It is an UnresolvedName only if nothing is known under the name's first part: what is missing inside of something
    that is declared may be rumoca's own fault.
    """
    quoted = _QUOTED.match(message)
    if not quoted:
        return None
    name = (quoted.group(1) or quoted.group(2)).removeprefix(".")
    used = list(_used(source, classes))
    untyped = next(filter(None, (_untyped(name, here, classes) for here in used)), None)
    if untyped is not None:
        return untyped
    file, line = _place(name, used) or source.place(source.start)
    first = split_name(name)[0]
    message += _cure(first, classes)
    is_begun = first != name and any(_is_declared(first, here, classes) for here in used)
    return (BuildError if is_begun else UnresolvedName)(message, file, line)


def _untyped(name: str, here: ClassText, classes: Libraries) -> UnresolvedName | None:
    """Of `part.flange`, where the class of `part` is in none of the libraries: the error at the part's declaration."""
    owner: ClassText | None = here
    for part in split_name(name)[:-1]:
        found = next(classes.elements(part, owner), None) if owner is not None else None
        if found is None or found[1].kind is not Kind.COMPONENT:
            return None
        where, element = found
        owner = classes.resolve(element.class_name, where)
        if owner is None and element.class_name not in PREDEFINED:
            message = f"{part} is a {element.class_name}, which is in none of the libraries"
            message += _cure(split_name(element.class_name)[0], classes) or "; name its library with --library"
            return UnresolvedName(message, where.source.file, where.source.line(element.start))
    return None


def _cure(first: str, classes: Libraries) -> str:
    """For a name whose first part is that of the standard library, where nobody has named it."""
    if first != _STANDARD or any(library.stem == _STANDARD for library in classes.places):
        return ""
    return f"; name the Modelica Standard Library too: --library path/to/{_STANDARD}"


def _is_declared(name: str, here: ClassText, classes: Libraries) -> bool:
    components = (declaration.name for declaration in here.of_kind(Kind.COMPONENT))
    return name in components or classes.resolve(name, here) is not None


def _used(source: ClassText, classes: Libraries) -> Iterator[ClassText]:
    """The class, its bases, the classes of its parts and the functions it calls, and theirs."""
    waiting = [classes.full(source.full_name)]
    seen = set()
    while waiting:
        here = waiting.pop(0)
        if here is None or here.full_name in seen:
            continue
        seen.add(here.full_name)
        yield here
        named = [d.class_name for d in here.declarations if d.kind in (Kind.EXTENDS, Kind.COMPONENT)]
        waiting += [classes.resolve(name, here) for name in (*named, *sorted(names_used(here.words)))]


def _place(name: str, used: Sequence[ClassText]) -> tuple[Path, int] | None:
    wanted = [token for part in split_name(name) for token in (part, ".")][:-1]
    for here in used:
        words = list(here.words)
        for at in range(len(words) - len(wanted) + 1):
            is_part = at > 1 and words[at - 1] == "." and (is_name(words[at - 2]) or words[at - 2] in "])")
            is_modified = at > 0 and words[at - 1] in "(," and words[at + len(wanted) : at + len(wanted) + 1] == ["="]
            if words[at : at + len(wanted)] == wanted and not is_part and not is_modified:
                return here.source.file, here.source.line(here.tokens[at].start)
    return None
