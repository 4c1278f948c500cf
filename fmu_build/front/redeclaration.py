"""Refuses redeclarations that rumoca 0.10.2 would drop without a word.

It follows `redeclare X part` only into the class that declares `part` itself: through a class that merely inherits the
part, or into a part of a part, the redeclaration is lost and the model silently stays what it was. (`redeclare model
X = Y` is followed everywhere.)
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.errors import BuildError
from fmu_build.front.source import CLASS_KINDS, ClassSource, find_class

KINDS = frozenset(CLASS_KINDS.split("|"))
PREFIXES = frozenset(
    ("each", "final", "replaceable", "redeclare", "inner", "outer", "parameter", "constant", "input", "output", "flow")
)
NAME = re.compile(r"[A-Za-z_]\w*$")
Statement = Sequence[str]


@dataclass(frozen=True)
class Redeclaration:
    """`redeclare ... part` in the modification of a base class or of a component."""

    part: str
    is_class: bool  # `redeclare model part = ...`
    is_nested: bool  # inside the modification of a part


class _Lookup:
    """Classes by name, each read once."""

    def __init__(self, libraries: Sequence[Path]) -> None:
        self._libraries = libraries
        self._found: dict[str, ClassSource | None] = {}

    def resolve(self, name: str, scope: str) -> ClassSource | None:
        """From the innermost enclosing package outwards; None for built-in types and for what is no class."""
        if not name or name in ("Real", "Integer", "Boolean", "String"):
            return None
        enclosing = scope.split(".")
        candidates = (".".join([*enclosing[:count], name]) for count in range(len(enclosing), -1, -1))
        return next((found for found in map(self._read, candidates) if found is not None), None)

    def _read(self, full_name: str) -> ClassSource | None:
        if full_name not in self._found:
            try:
                self._found[full_name] = find_class(full_name, self._libraries)
            except BuildError:
                self._found[full_name] = None
        return self._found[full_name]


def refuse_lost_redeclarations(source: ClassSource, libraries: Sequence[Path]) -> None:
    """Look through the class, its bases and the classes of its parts.

    Raises:
        BuildError: a redeclaration would be lost; says which class to extend instead.
    """
    classes = _Lookup(libraries)
    seen = {source.name}
    waiting = [source]
    while waiting:
        here = waiting.pop()
        for statement in _statements(here.tokens):
            used = classes.resolve(_class_of(statement), here.name)
            for found in _redeclarations(statement):
                _check(found, statement, used, here, classes)
            if used is not None and used.name not in seen:
                seen.add(used.name)
                waiting.append(used)


def _check(
    found: Redeclaration, statement: Statement, used: ClassSource | None, here: ClassSource, classes: _Lookup
) -> None:
    if found.is_nested and not found.is_class:
        raise BuildError(
            f"the compiler cannot redeclare {found.part} inside a part of another part; write a class of that part "
            f"with {found.part} redeclared, and use it here",
            here.file,
            here.line,
        )
    if used is None or found.is_nested:
        return
    owner = _owner(found.part, used, classes)
    if owner is None:
        raise BuildError(f"{used.name} has no replaceable part {found.part} to redeclare", here.file, here.line)
    if owner.name != used.name and _is_base(statement) and not found.is_class:
        raise BuildError(
            f"the compiler cannot redeclare {found.part} through {used.name}, which only inherits it; extend "
            f"{owner.name} instead, with the modifications that {used.name} makes",
            here.file,
            here.line,
        )


def _owner(part: str, used: ClassSource, classes: _Lookup) -> ClassSource | None:
    """The class that declares `part`: `used` or one of its bases."""
    for statement in _statements(used.tokens):
        if "replaceable" in statement and part in statement:
            return used
    for statement in _statements(used.tokens):
        base = classes.resolve(_class_of(statement), used.name) if _is_base(statement) else None
        owner = _owner(part, base, classes) if base is not None else None
        if owner is not None:
            return owner
    return None


def _statements(tokens: Sequence[str]) -> Iterator[Statement]:
    """Declarations and equations: the tokens between semicolons, without a class header before the first one."""
    begin, depth = 0, 0
    for at, token in enumerate(tokens):
        depth += (token in "([{") - (token in ")]}")
        if token == ";" and depth == 0:
            yield _without_header(tokens[begin:at])
            begin = at + 1


def _without_header(statement: Statement) -> Statement:
    """`model M "text" extends A(...)` -> `extends A(...)`; a short class `model M = A(...)` stays."""
    start = next((at for at, token in enumerate(statement) if token in KINDS or token == "partial"), None)
    if start != 0 or "=" in statement[:5]:
        return statement
    rest = statement[statement.index(next(token for token in statement if token in KINDS)) + 2 :]
    while rest and rest[0].startswith('"'):
        rest = rest[1:]
    return rest


def _is_base(statement: Statement) -> bool:
    return statement[0] == "extends" or _is_short_class(statement) if statement else False


def _is_short_class(statement: Statement) -> bool:
    return len(statement) > 3 and statement[0] in KINDS and statement[2] == "="


def _class_of(statement: Statement) -> str:
    """The dotted class name a declaration begins with, or an empty text."""
    at = 3 if _is_short_class(statement) else 1 if _is_base(statement) else 0
    while at < len(statement) and statement[at] in PREFIXES:
        at += 1
    return _dotted(statement, at)[0]


def _dotted(tokens: Sequence[str], at: int) -> tuple[str, int]:
    """The dotted name at a place, and the place behind it."""
    parts: list[str] = []
    while at < len(tokens) and NAME.match(tokens[at]):
        parts.append(tokens[at])
        at += 1
        if at >= len(tokens) or tokens[at] != ".":
            break
        at += 1
    return ".".join(parts), at


def _redeclarations(statement: Statement) -> Iterator[Redeclaration]:
    depth = 0
    for at, token in enumerate(statement):
        depth += (token in "([{") - (token in ")]}")
        if token == "redeclare" and depth > 0:
            name = at + 1
            while statement[name] in PREFIXES:
                name += 1
            is_class = statement[name] in KINDS
            part = statement[name + 1] if is_class else _dotted(statement, _dotted(statement, name)[1])[0]
            yield Redeclaration(part, is_class, is_nested=depth > 1)
