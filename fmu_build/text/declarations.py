"""Declarations of Modelica text: what a class extends and imports, its components, and how they are modified."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from fmu_build.text.tokens import (
    Token,
    Tokens,
    behind_brackets,
    bracket,
    depth_change,
    dotted_name,
    is_name,
    split,
    string_value,
    written,
)

CLASS_KINDS = frozenset(
    ("model", "block", "class", "package", "connector", "record", "function", "type", "operator", "optimization")
)
_VARIABILITIES = ("flow", "stream", "discrete", "parameter", "constant", "input", "output")
_CLASS_PREFIXES = ("partial", "encapsulated", "expandable", "pure", "impure")
PREFIXES = frozenset(("redeclare", "final", "each", "inner", "outer", "replaceable", *_VARIABILITIES, *_CLASS_PREFIXES))
_OPERATORS = ("then", "else", "elseif", "if", "and", "or", "not", "in")


class Kind(Enum):
    """What an element of a class is."""

    EXTENDS = "extends"  # also what a short class `model M = A(...)` is made of
    COMPONENT = "component"
    CLASS = "class"
    IMPORT = "import"


@dataclass(frozen=True, eq=False)
class Source:
    """A file and its text."""

    file: Path
    text: str

    def line(self, offset: int) -> int:
        """The line of an offset, counted from 1."""
        return self.text.count("\n", 0, offset) + 1


@dataclass(frozen=True)
class Modifier:
    """One argument of a modification, as `b(min = 0) = 2`.

    Args:
        name: what is modified; of `redeclare A.B c` it is c.
        tokens: all behind the prefixes.
        inside: those in its bracket.
        value: those behind its equals sign.
    """

    name: str
    tokens: Tokens
    inside: Tokens
    value: Tokens

    @property
    def words(self) -> str:
        """Its tokens with blanks between them."""
        return " ".join(token.text for token in self.tokens)


def name_at(tokens: Tokens) -> int:
    """Where the name stands that an argument modifies: behind the class, where one is redeclared."""
    at = next((k for k, token in enumerate(tokens) if token.text not in PREFIXES), 0)
    if any(token.text == "redeclare" for token in tokens[:at]):
        is_class = tokens[at].text in CLASS_KINDS
        at = at + 1 if is_class else behind_brackets(tokens, dotted_name(tokens, at)[1])
    return min(at, len(tokens) - 1)


def modifiers(tokens: Tokens) -> dict[str, Modifier]:
    """Arguments of a modification by their names; `tokens` are what stands in its bracket."""
    found = {}
    for part in split(tokens, ","):
        if part:
            at = name_at(part)
            inner = bracket(part, at + 1)
            behind = at + 1 + len(inner)
            value = part[behind + 1 :] if part[behind : behind + 1] and part[behind].text in ("=", ":=") else ()
            begin = next((k for k, token in enumerate(part) if token.text not in PREFIXES), 0)
            found[part[at].text] = Modifier(part[at].text, part[begin:], inner[1:-1], value)
    return found


@dataclass(frozen=True)
class Declaration:
    """One element of a class; components declared together are one each.

    Args:
        class_name: the class of a component, the one that is extended, or the imported one.
        name: of the component or class; of an import what it is called here, or `*` for all classes in it; "" of an
            extends clause.
        dimensions: brackets with sizes, those of the type first.
        modification: all behind the name, or behind the class of an extends clause: bracket, value, condition.
        constraint: what follows `constrainedby`.
        comment: strings that describe it.
        annotation: what stands in the bracket of its annotation.
        start: offset of the statement.
    """

    kind: Kind
    prefixes: frozenset[str]
    class_name: str
    name: str
    start: int
    source: Source = field(repr=False)
    dimensions: Tokens = ()
    modification: Tokens = ()
    constraint: Tokens = ()
    comment: Tokens = ()
    annotation: Tokens = ()

    @property
    def end(self) -> int:
        """Offset behind its last token, comment and annotation left out."""
        tokens = self.modification or self.dimensions
        return tokens[-1].end if tokens else self.start

    @property
    def arguments(self) -> Tokens:
        """What stands in the bracket of its modification."""
        return bracket(self.modification, 0)[1:-1]

    @property
    def modifiers(self) -> dict[str, Modifier]:
        return modifiers(self.arguments)

    @property
    def value(self) -> Tokens:
        """The expression behind its equals sign."""
        at = behind_brackets(self.modification, 0)
        rest = self.modification[at:]
        if not rest or rest[0].text not in ("=", ":="):
            return ()
        return rest[1 : next((k for k, t in enumerate(rest) if k > 1 and _is_condition(rest, k)), len(rest))]

    @property
    def description(self) -> str:
        return string_value(self.comment)

    @property
    def constraining(self) -> str:
        """The class behind `constrainedby`; "" for none."""
        return dotted_name(self.constraint, 1)[0]

    def text(self, tokens: Tokens) -> str:
        """Tokens of it as they are written."""
        return written(self.source.text, tokens)


def _is_condition(tokens: Tokens, at: int) -> bool:
    return tokens[at].text == "if" and _ends_operand(tokens[at - 1])


def read_extends(statement: Tokens, prefixes: frozenset[str], start: int, source: Source) -> Declaration:
    """An extends clause, behind that word, or a short class, behind its equals sign."""
    said, annotation, rest = read_comment(statement)
    class_name, at = dotted_name(rest, 0)
    rest, constraint = _cut(rest[at:])
    sizes = bracket(rest, 0, "[")
    return Declaration(
        Kind.EXTENDS,
        prefixes,
        class_name,
        "",
        start,
        source,
        sizes,
        rest[len(sizes) :],
        constraint,
        said,
        annotation,
    )


def read_components(statement: Tokens, prefixes: frozenset[str], start: int, source: Source) -> Iterator[Declaration]:
    """`Real[3] a(x = 1) "A", b = 2` -> a and b."""
    class_name, at = dotted_name(statement, 0)
    sizes = bracket(statement, at, "[")
    declared, constraint = _cut(statement[at + len(sizes) :])
    said_behind, annotation_behind, constraint = read_comment(constraint)
    for part in split(declared, ","):
        said, annotation, rest = read_comment(part)
        if rest and is_name(rest[0].text):
            own = bracket(rest, 1, "[")
            behind = rest[1 + len(own) :]
            yield Declaration(
                Kind.COMPONENT, prefixes, class_name, rest[0].text, start, source, sizes + own, behind, constraint,
                said or said_behind, annotation or annotation_behind,
            )  # fmt: skip


def _cut(tokens: Tokens) -> tuple[Tokens, Tokens]:
    """What stands before `constrainedby`, and from there on."""
    depth = 0
    for place, token in enumerate(tokens):
        depth += depth_change(token)
        if token.text == "constrainedby" and depth == 0:
            return tokens[:place], tokens[place:]
    return tokens, ()


def read_comment(tokens: Tokens) -> tuple[Tokens, Tokens, Tokens]:
    """Strings that describe an element, what its annotation has in its bracket, and all other tokens."""
    comment, rest, annotation = list[Token](), list[Token](), Tokens()
    at = depth = 0
    while at < len(tokens):
        token = tokens[at]
        depth += depth_change(token)
        if token.text == "annotation":
            found = bracket(tokens, at + 1)
            annotation = found[1:-1] if depth == 0 else annotation
            at += len(found)
        elif token.is_string and depth == 0 and rest and _ends_operand(tokens[at - 1]):
            comment = list(leading_strings(tokens[at:]))
            at += 2 * len(comment) - 2
        else:
            rest.append(token)
        at += 1
    return tuple(comment), annotation, tuple(rest)


def leading_strings(tokens: Tokens) -> Tokens:
    """`"a" + "b" ...` -> both strings."""
    count = next((k for k, t in enumerate(tokens) if not (t.is_string if k % 2 == 0 else t.text == "+")), len(tokens))
    return tokens[:count:2]


def _ends_operand(token: Token) -> bool:
    """Whether an expression may end with it: a string behind it begins a description, and an if a condition."""
    return (is_name(token.text) or token.is_string or token.text[0] in ")]}0123456789.") and (
        token.text not in _OPERATORS
    )


def read_imports(statement: Tokens, start: int, source: Source) -> Iterator[Declaration]:
    """`A = B.C`, `B.C`, `B.*` and `B.{C, D}`."""
    words = [token.text for token in statement]
    alias = words[0] if words[1:2] == ["="] else None
    class_name, at = dotted_name(statement, 2 if alias else 0)
    if words[at : at + 2] == [".", "{"]:
        pairs = [(f"{class_name}.{word}", word) for word in words[at + 2 :] if is_name(word)]
    elif "*" in words[at : at + 2]:
        pairs = [(class_name, "*")]
    else:
        pairs = [(class_name, alias or class_name.rsplit(".", 1)[-1])]
    return (Declaration(Kind.IMPORT, frozenset(), name, local, start, source) for name, local in pairs)
