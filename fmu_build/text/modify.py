"""Values of parameters as Modelica modifications, put into those that are there already, and redeclarations in them."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from fmu_build.text.declarations import CLASS_KINDS, PREFIXES, name_at
from fmu_build.text.tokens import (
    TextError,
    Tokens,
    behind_brackets,
    bracket,
    depth_change,
    dotted_name,
    split,
    split_name,
    tokenise,
    written,
)

# Parameter or component -> its value as text, or those of what is in it.
_Tree = dict[str, "str | _Tree"]
_ELEMENT = re.compile(r"(.+)\[(\d+)\]")


def with_values(modifications: Sequence[str], values: Mapping[str, float]) -> list[str]:
    """The modifications with parameters set; a value that is there already gives way, other attributes stay.

    Args:
        modifications: as they stand in an extends clause, without commas: "a(min=0)=1", "redeclare Class part".
        values: by full name with dots. Of an array each element is given, as "part.c[1]", "part.c[2]".
    Raises:
        TextError: an element of an array is missing, or one of an array of parts is set.
    """
    tree: _Tree = {}
    for name, value in _whole(values).items():
        *path, last = split_name(name)
        here = tree
        for part in path:
            below = here.setdefault(part, {})
            if isinstance(below, str) or part.endswith("]"):
                raise TextError(f"{name} cannot be set beside {part}; set it in a class that extends this one")
            here = below
        here[last] = value
    return _merged(modifications, tree)


def _whole(values: Mapping[str, float]) -> dict[str, str]:
    """Values as text, the elements of an array as one."""
    found: dict[str, str] = {}
    arrays: dict[str, dict[int, float]] = {}
    for name, value in values.items():
        element = _ELEMENT.fullmatch(name)
        if element:
            arrays.setdefault(element[1], {})[int(element[2])] = value
        else:
            found[name] = repr(float(value))
    for name, elements in arrays.items():
        missing = set(range(1, max(elements) + 1)) - set(elements)
        if missing or min(elements) < 1:
            raise TextError(f"{name} is an array, of which some elements are not given; give each from {name}[1] on")
        found[name] = "{" + ", ".join(repr(float(elements[k])) for k in sorted(elements)) + "}"
    return found


def _merged(modifications: Sequence[str], tree: _Tree) -> list[str]:
    rest, found = dict(tree), []
    for text in modifications:
        tokens = tokenise(text)
        name = tokens[name_at(tokens)].text
        found.append(_set(text, rest.pop(name)) if name in rest else text)
    return found + [_set(name, value) for name, value in rest.items()]


def _set(text: str, value: str | _Tree) -> str:
    """One modification with a value, or with values in its bracket."""
    tokens = tokenise(text)
    at = name_at(tokens)
    own = bracket(tokens, at + 1)
    last = own[-1] if own else tokens[at]
    if isinstance(value, str):
        return f"{text[: last.end]}={value}"
    inside = [written(text, part) for part in split(own[1:-1], ",")]
    return f"{text[: tokens[at].end]}({', '.join(_merged(inside, value))}){text[last.end :]}"


@dataclass(frozen=True)
class Redeclaration:
    """`redeclare class_name part` or `redeclare model part = class_name` in a modification."""

    part: str
    class_name: str
    modification: Tokens  # of the new class or part, with its brackets
    kind: str  # of the class, as "package"; empty for a part
    is_nested: bool  # inside the modification of a part
    has_value: bool  # behind an equals sign; of a part
    start: int


def redeclarations(tokens: Tokens) -> Iterator[Redeclaration]:
    """Those in a modification with its bracket, in the modifications of its parts too."""
    depth = 0
    for at, token in enumerate(tokens):
        depth += depth_change(token)
        if token.text == "redeclare":
            yield _redeclaration(tokens, at + 1, depth > 1, token.start)


def _redeclaration(tokens: Tokens, at: int, is_nested: bool, start: int) -> Redeclaration:
    while at < len(tokens) and tokens[at].text in PREFIXES:
        at += 1
    if at < len(tokens) and tokens[at].text in CLASS_KINDS:
        part, behind = dotted_name(tokens, at + 1)
        class_name, behind = dotted_name(tokens, behind + 1)
        return Redeclaration(part, class_name, bracket(tokens, behind), tokens[at].text, is_nested, False, start)
    class_name, behind = dotted_name(tokens, at)
    part, behind = dotted_name(tokens, _behind_sizes(tokens, behind))
    at = _behind_sizes(tokens, behind)
    given = bracket(tokens, at)
    has_value = [token.text for token in tokens[at + len(given) :][:1]] == ["="]
    return Redeclaration(part, class_name, given, "", is_nested, has_value, start)


def _behind_sizes(tokens: Tokens, at: int) -> int:
    return behind_brackets(tokens, at) if at < len(tokens) and tokens[at].text == "[" else at
