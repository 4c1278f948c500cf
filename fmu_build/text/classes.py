"""Reads the classes of Modelica text, each with its declarations and its statements.

Equations and annotations are kept as tokens, so it costs milliseconds per library. It does not check syntax: text that
a compiler would refuse gives what could be read of it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from fmu_build.text.declarations import (
    CLASS_KINDS,
    PREFIXES,
    Declaration,
    Kind,
    Source,
    leading_strings,
    read_comment,
    read_components,
    read_extends,
    read_imports,
)
from fmu_build.text.statements import Statement, statements
from fmu_build.text.tokens import (
    TextError,
    Token,
    Tokens,
    behind_brackets,
    bracket,
    depth_change,
    dotted_name,
    string_value,
    tokenise,
    written,
)

_SECTIONS = ("public", "protected")
_LAWS = ("equation", "algorithm")
_BEFORE_STATEMENTS = (";", *_SECTIONS, *_LAWS)
_END = Token("", -1)


@dataclass(frozen=True, eq=False)
class ClassText:
    """A class as written.

    Args:
        kind: of `operator record` it is record.
        start: offset of its first prefix.
        tokens: from behind its name to the end of the class, without `end M`.
        is_extension: for `model extends M ... end M`.
        classes: those declared in it, by name.
    """

    full_name: str
    name: str
    kind: str
    prefixes: frozenset[str]
    start: int
    source: Source = field(repr=False)
    is_extension: bool = False
    tokens: Tokens = field(default=(), repr=False)
    declarations: tuple[Declaration, ...] = ()
    classes: Mapping[str, "ClassText"] = field(default_factory=dict)

    @cached_property
    def words(self) -> tuple[str, ...]:
        return tuple(token.text for token in self.tokens)

    @cached_property
    def own_tokens(self) -> Tokens:
        """Without those of the classes declared inside."""
        inner = [(one.tokens[0].start, one.tokens[-1].start) for one in self.classes.values() if one.tokens]
        return tuple(t for t in self.tokens if not any(begin <= t.start <= end for begin, end in inner))

    @property
    def is_short(self) -> bool:
        """Whether it is written as `model M = A(...)`."""
        return self.words[:1] == ("=",)

    @property
    def description(self) -> str:
        return string_value(read_comment(self.tokens[1:])[0] if self.is_short else leading_strings(self.tokens))

    @property
    def annotation(self) -> Tokens:
        """What stands in the bracket of its own annotation, which is the last in it; empty where there is none."""
        for at in range(len(self.tokens) - 1, -1, -1):
            if self.words[at] == "annotation":
                found = bracket(self.tokens, at + 1)
                begins = at <= 2 * len(leading_strings(self.tokens)) or self.words[at - 1] in _BEFORE_STATEMENTS
                is_last = self.words[at + 1 + len(found) :] in ((";",), ())
                return found[1:-1] if is_last and (begins or self.is_short) else ()
        return ()

    @cached_property
    def equations(self) -> tuple[Statement, ...]:
        """Those of its own sections, without initial ones."""
        found = statements(self.own_tokens, initial=False) if not self.is_short else ()
        return tuple(statement for statement in found if statement.word != "annotation")

    @property
    def is_plain(self) -> bool:
        """Whether it says nothing beside what it extends."""
        has_law = any(token.text in ("initial", "external", *_LAWS) for token in self.own_tokens)
        return not has_law and all(declaration.kind is Kind.EXTENDS for declaration in self.declarations)

    def of_kind(self, kind: Kind) -> Iterator[Declaration]:
        return (declaration for declaration in self.declarations if declaration.kind is kind)

    def text(self, tokens: Tokens) -> str:
        """Tokens of it as they are written."""
        return written(self.source.text, tokens)

    def place(self, offset: int) -> tuple[Path, int]:
        """File and line of an offset."""
        return self.source.file, self.source.line(offset)

    def error(self, message: str, offset: int) -> TextError:
        return TextError(message, *self.place(offset))


def read_classes(source: Source, outer: str = "") -> dict[str, ClassText]:
    """The classes of a text by name, each with those inside.

    Args:
        outer: full name of the package around them.
    Raises:
        TextError: the text's `within` clause names another package.
    """
    tokens = tokenise(source.text)
    if tokens and tokens[0].text == "within":
        said = dotted_name(tokens, 1)[0]
        if said != outer:
            cure = f"write within {outer};" if outer else "name the folder of that package, or take the clause out"
            message = f"the file says within {said or 'no package'}, but is not in a folder of that package; {cure}"
            raise TextError(message, source.file, source.line(tokens[0].start))
    reader = _Reader(tokens, source)
    reader.body("", outer)
    return reader.classes


class _Reader:
    """Reads the elements of one class after another; those of the class at hand are in `declarations` and `classes`."""

    def __init__(self, tokens: Tokens, source: Source) -> None:
        self._tokens, self._source, self._at = tokens, source, 0
        self.declarations: list[Declaration] = []
        self.classes: dict[str, ClassText] = {}

    def body(self, name: str, full_name: str) -> int:
        """Read elements up to and with the `end name` of a class; where that is."""
        while self._at < len(self._tokens):
            token = self._peek()
            if token == "end":
                self._at += 2
                return self._at - 2
            if token in _LAWS:
                self._pass_equations(name)
            elif token in _SECTIONS or token in ("initial", ";") or token[0] == '"':
                self._at += 1
            elif token in ("within", "annotation", "external"):
                self._statement()
            else:
                self._element(full_name)
        return len(self._tokens)

    def _peek(self, ahead: int = 0) -> str:
        at = self._at + ahead
        return (self._tokens[at] if at < len(self._tokens) else _END).text

    def _pass_equations(self, name: str) -> None:
        """To the end of the class or its next section; `end if` and the like do not end it."""
        while self._at < len(self._tokens):
            if self._peek() in _SECTIONS or (self._peek() == "end" and self._peek(1) == name):
                return
            self._at += 1

    def _statement(self) -> Tokens:
        """The tokens up to the next semicolon outside of brackets, which is passed."""
        begin, end = self._at, _statement_end(self._tokens, self._at)
        self._at = end + 1
        return self._tokens[begin:end]

    def _element(self, outer: str) -> None:
        start = self._tokens[self._at].start
        prefixes = set()
        while self._peek() in PREFIXES:
            prefixes.add(self._peek())
            self._at += 1
        if self._peek() in CLASS_KINDS:
            self._class(outer, frozenset(prefixes), start)
        elif self._peek() == "import":
            self.declarations += read_imports(self._statement()[1:], start, self._source)
        elif self._peek() == "extends":
            statement = self._statement()[1:]
            self.declarations.append(read_extends(statement, frozenset(prefixes), start, self._source))
        else:
            self.declarations += read_components(self._statement(), frozenset(prefixes), start, self._source)

    def _class(self, outer: str, prefixes: frozenset[str], start: int) -> None:
        while self._peek(1) in CLASS_KINDS:  # `operator function` has two
            self._at += 1
        kind = self._peek()
        is_extension = self._peek(1) == "extends"
        self._at += 1 + is_extension
        name = self._peek()
        full_name = f"{outer}.{name}" if outer else name
        self._at += 1
        begin = self._at
        inside = _Reader(self._tokens, self._source)
        if self._peek() == "=":
            self._at += 1
            statement = self._statement()
            while statement and statement[0].text in PREFIXES:
                statement = statement[1:]
            if statement and statement[0].text not in ("enumeration", "der"):
                inside.declarations.append(read_extends(statement, frozenset(), start, self._source))
            end = self._at - 1
        else:
            inside._at = behind_brackets(self._tokens, self._at)
            end = inside.body(name, full_name)
            self._at = inside._at
            self._statement()
        found, classes = tuple(inside.declarations), inside.classes
        tokens = self._tokens[begin:end]
        new = ClassText(full_name, name, kind, prefixes, start, self._source, is_extension, tokens, found, classes)
        self.classes.setdefault(name, new)
        self.declarations.append(Declaration(Kind.CLASS, prefixes, name, name, start, self._source))


def _statement_end(tokens: Tokens, at: int) -> int:
    """Where the next semicolon outside of brackets is."""
    depth = 0
    for stop in range(at, len(tokens)):
        depth += depth_change(tokens[stop])
        if tokens[stop].text == ";" and depth <= 0:
            return stop
    return len(tokens)
