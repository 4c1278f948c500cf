"""Modelica classes as far as a catalogue needs them: bases, declarations and annotations, read from the text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pysim.effects._tokens import Token, closing, split, string, tokenise, written

_CLASS_PREFIXES = {"encapsulated", "partial", "final", "expandable", "pure", "impure", "operator"}
_CLASS_KINDS = {"model", "block", "package", "class", "record", "function", "connector", "type"}
_PREFIXES = {"final", "inner", "outer", "replaceable", "redeclare", "each"} | {
    "flow",
    "stream",
    "discrete",
    "parameter",
    "constant",
    "input",
    "output",
}


@dataclass(frozen=True)
class Declaration:
    """One component: prefixes, type, name, modifiers (name -> text), value, description, annotation (text), and the
    class behind `constrainedby`."""

    prefixes: frozenset[str]
    type_name: str
    name: str
    modifiers: dict[str, str]
    value: str
    description: str
    annotation: str
    constraint: str = ""


@dataclass(frozen=True)
class Base:
    """An extends clause: the class and what stands in the brackets behind it."""

    class_name: str
    modifications: str


@dataclass
class ClassText:
    """One class. `plain` tells that beside extends clauses and annotations nothing stands in it; `equations` are those
    of the class itself, as written, without initial ones."""

    full_name: str
    kind: str
    file: Path
    description: str = ""
    bases: list[Base] = field(default_factory=list)
    declarations: list[Declaration] = field(default_factory=list)
    annotation: str = ""
    modifiers: dict[str, str] = field(default_factory=dict)  # of a short class, type X = Real(...)
    plain: bool = True
    equations: list[str] = field(default_factory=list)


def read_classes(source: str, file: Path, within: str) -> Iterator[ClassText]:
    """Every class of a source, those inside others too.

    Args:
        within: full name of the package around it; the source's own `within` clause goes before.
    """
    tokens, k = tokenise(source), 0
    if tokens and tokens[0].text == "within":
        k = next(i for i, token in enumerate(tokens) if token.text == ";")
        within, k = written(source, tokens[1:k]), k + 1
    while k < len(tokens):
        if _begins_class(tokens, k):
            found: list[ClassText] = []
            k = _class(source, tokens, k, within, file, found)
            yield from found
        else:
            k += 1


def arguments(text: str) -> dict[str, str]:
    """Name -> text of what stands in a bracket, `a=1, b(c=2)=3`; a nested bracket's content is the name's text."""
    tokens = tokenise(text)
    found = {}
    for part in split(tokens, ","):
        part = [token for token in part if token.text not in ("final", "each")]
        if len(part) < 2:
            continue
        if part[1].text == "=":
            found[part[0].text] = written(text, part[2:])
        elif part[1].text == "(":
            found[part[0].text] = written(text, part[2 : closing(part, 1)])
    return found


def _begins_class(tokens: Sequence[Token], k: int) -> bool:
    """Whether a class is declared here, not a component with such a prefix."""
    while k < len(tokens) and tokens[k].text in _CLASS_PREFIXES | {"replaceable", "redeclare"}:
        k += 1
    return k < len(tokens) and tokens[k].text in _CLASS_KINDS


def _class(source: str, tokens: Sequence[Token], k: int, within: str, file: Path, found: list[ClassText]) -> int:
    """Read the class at k into `found`, its inner classes behind it; the index after it."""
    while tokens[k].text not in _CLASS_KINDS:
        k += 1
    kind, name = tokens[k].text, tokens[k + 1].text
    here = ClassText(f"{within}.{name}" if within else name, kind, file)
    found.append(here)
    k += 2
    if tokens[k].text == "=":
        return _short_class(source, tokens, k + 1, here)
    if tokens[k].is_string:
        here.description, k = string(tokens[k]), k + 1
    law = False
    while k < len(tokens) and not (tokens[k].text == "end" and tokens[k + 1].text == name):
        if _begins_class(tokens, k):
            here.plain = False
            k = _class(source, tokens, k, here.full_name, file, found)
            continue
        if tokens[k].text in ("public", "protected", "equation", "algorithm", "initial"):
            here.plain &= tokens[k].text in ("public", "protected")
            law = tokens[k].text in ("equation", "algorithm") and tokens[k - 1].text != "initial"
            k += 1
            continue
        end = _end_of_statement(tokens, k)
        if law and tokens[k].text != "annotation":
            here.equations.append(written(source, tokens[k : end + 1]))
        _statement(source, tokens[k:end], here)
        k = end + 1
    return _end_of_statement(tokens, k) + 1


def _end_of_statement(tokens: Sequence[Token], k: int) -> int:
    while k < len(tokens) and tokens[k].text != ";":
        k = closing(tokens, k) + 1 if tokens[k].text in "([{" else k + 1
    return k


def _short_class(source: str, tokens: Sequence[Token], k: int, here: ClassText) -> int:
    """`type X = Base(modifiers) "text" annotation(...);`"""
    end = _end_of_statement(tokens, k)
    name, bracket, rest = _head(source, tokens[k:end])
    here.bases.append(Base(name, bracket))
    here.modifiers = arguments(bracket)
    here.description = next((string(token) for token in rest if token.is_string), "")
    return end + 1


def _head(source: str, tokens: Sequence[Token]) -> tuple[str, str, Sequence[Token]]:
    """A name with dots, the content of the bracket behind it, and the tokens after that."""
    k = 0
    while k < len(tokens) and tokens[k].text not in "([" and (k == 0 or "." in (tokens[k].text, tokens[k - 1].text)):
        k += 1
    name = "".join(token.text for token in tokens[:k])
    if k < len(tokens) and tokens[k].text == "[":
        k = closing(tokens, k) + 1
    if k < len(tokens) and tokens[k].text == "(":
        end = closing(tokens, k)
        return name, written(source, tokens[k + 1 : end]), tokens[end + 1 :]
    return name, "", tokens[k:]


def _statement(source: str, tokens: Sequence[Token], here: ClassText) -> None:
    """An extends clause, an annotation, a declaration, or something that does not matter here."""
    if not tokens:
        return
    if tokens[0].text == "extends":
        name, bracket, _ = _head(source, tokens[1:])
        here.bases.append(Base(name, bracket))
    elif tokens[0].text == "annotation":
        here.annotation = written(source, tokens[2:-1])
    else:
        here.plain = False
        declaration = _declaration(source, tokens)
        if declaration is not None:
            here.declarations.append(declaration)


def _declaration(source: str, tokens: Sequence[Token]) -> Declaration | None:
    """The first component of a declaration; None for an equation or an import."""
    k = 0
    while k < len(tokens) and tokens[k].text in _PREFIXES:
        k += 1
    prefixes = frozenset(token.text for token in tokens[:k])
    type_name, _, rest = _head(source, tokens[k:])
    if not rest or not rest[0].text[0].isidentifier() or type_name in ("import", "connect", ""):
        return None
    name, bracket, rest = _head(source, rest)
    annotation, description, constraint = "", "", ""
    for i, token in enumerate(rest):
        if token.text == "constrainedby":
            constraint, _, _ = _head(source, rest[i + 1 :])
        if token.is_string and not description:
            description = string(token)
        if token.text == "annotation":
            annotation = written(source, rest[i + 2 : closing(rest, i + 1)])
            break
    value: list[Token] = []
    if rest and rest[0].text == "=":
        for token in rest[1:]:
            if token.is_string or token.text in ("annotation", "constrainedby"):
                break
            value.append(token)
    text = written(source, value)
    return Declaration(prefixes, type_name, name, arguments(bracket), text, description, annotation, constraint)
