"""Reads the declarations of Modelica text: classes, what they extend and import, and their components.

Equations, algorithms and annotations are passed over, so it costs milliseconds per library. It does not check syntax:
text that rumoca would refuse gives what could be read of it.
"""

from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache
from pathlib import Path

from fmu_build.front.tokens import Token, tokenise

CLASS_KINDS = frozenset(
    ("model", "block", "class", "package", "connector", "record", "function", "type", "operator", "optimization")
)
_VARIABILITIES = ("flow", "stream", "discrete", "parameter", "constant", "input", "output")
_CLASS_PREFIXES = ("partial", "encapsulated", "expandable", "pure", "impure")
PREFIXES = frozenset(("redeclare", "final", "each", "inner", "outer", "replaceable", *_VARIABILITIES, *_CLASS_PREFIXES))
_SECTIONS = frozenset(("public", "protected"))
_END: Token = ("", -1)


class Kind(Enum):
    EXTENDS = "extends"  # also what a short class `model M = A(...)` is made of
    COMPONENT = "component"
    CLASS = "class"
    IMPORT = "import"


@dataclass(frozen=True)
class Declaration:
    """One element of a class.

    `modification` is everything behind the names of class and component but annotations, `constraint` what follows
    `constrainedby`. An import has the imported class as `class_name`, and as `declared` what it is called here, or
    `*` for all classes in it.
    """

    kind: Kind
    prefixes: frozenset[str]
    class_name: str
    declared: tuple[str, ...]
    modification: tuple[Token, ...]
    constraint: tuple[Token, ...]
    offset: int


@dataclass
class ClassText:
    """A class as written; `is_extension` for `model extends M ... end M`.

    `tokens` go from behind its name to the end of the class, without `end M`.
    """

    name: str
    kind: str
    prefixes: frozenset[str]
    offset: int
    is_extension: bool = False
    tokens: tuple[Token, ...] = ()
    declarations: list[Declaration] = field(default_factory=list)
    classes: dict[str, "ClassText"] = field(default_factory=dict)

    @property
    def words(self) -> tuple[str, ...]:
        return tuple(word for word, _ in self.tokens)

    @property
    def own_tokens(self) -> tuple[Token, ...]:
        """Without those of the classes declared inside."""
        inner = [(one.tokens[0][1], one.tokens[-1][1]) for one in self.classes.values() if one.tokens]
        return tuple(t for t in self.tokens if not any(begin <= t[1] <= end for begin, end in inner))


@dataclass(frozen=True)
class SourceFile:
    file: Path
    text: str
    classes: dict[str, ClassText]

    def line(self, offset: int) -> int:
        return self.text.count("\n", 0, offset) + 1


def read_declarations(file: Path, text: str) -> SourceFile:
    return SourceFile(file, text, _classes(text))


@lru_cache(maxsize=1024)
def _classes(text: str) -> dict[str, ClassText]:
    whole = ClassText("", "package", frozenset(), 0)
    _Reader(tokenise(text)).body(whole)
    return whole.classes


def is_name(token: str) -> bool:
    return token[:1].isidentifier() or token[:1] == "'"


def dotted_name(tokens: tuple[Token, ...], at: int) -> tuple[str, int]:
    """The class name at a place, with its leading dot if there is one, and the place behind it."""
    begin = at
    at += at < len(tokens) and tokens[at][0] == "."
    while at < len(tokens) and is_name(tokens[at][0]):
        at += 1
        if at + 1 >= len(tokens) or tokens[at][0] != "." or not is_name(tokens[at + 1][0]):
            break
        at += 1
    return "".join(token for token, _ in tokens[begin:at]), at


def behind_brackets(tokens: tuple[Token, ...], at: int) -> int:
    """The place behind the bracket that opens at a place; the place itself where none opens."""
    depth = 0
    for stop in range(at, len(tokens)):
        depth += (tokens[stop][0] in "([{") - (tokens[stop][0] in ")]}")
        if depth == 0:
            return stop + 1 if stop > at else at
    return len(tokens)


def behind_indices(tokens: tuple[Token, ...], at: int) -> int:
    return behind_brackets(tokens, at) if at < len(tokens) and tokens[at][0] == "[" else at


def bracket(tokens: tuple[Token, ...], at: int) -> tuple[Token, ...]:
    """The modification in round brackets that begins at a place, with them; empty where there is none."""
    is_there = at < len(tokens) and tokens[at][0] == "("
    return tokens[at : behind_brackets(tokens, at)] if is_there else ()


def modifiers(modification: tuple[Token, ...]) -> dict[str, str]:
    """`(each a = 1, final b(min = 0) = 2)` -> {a: "a = 1", b: "b ( min = 0 ) = 2"}."""
    found: dict[str, str] = {}
    depth, words = 0, list[str]()
    for token, _ in modification:
        depth -= token in ")]}"
        if depth == 0 or (depth == 1 and token == ","):
            if words:
                found[words[0]] = " ".join(words)
            words = []
        elif words or token not in PREFIXES:
            words.append(token)
        depth += token in "([{"
    return found


class _Reader:
    def __init__(self, tokens: tuple[Token, ...]) -> None:
        self._tokens = tokens
        self._at = 0

    def body(self, owner: ClassText) -> int:
        """Read elements into `owner` up to and with its `end name`; where that is."""
        while self._at < len(self._tokens):
            token = self._peek()
            if token == "end":
                self._at += 2
                return self._at - 2
            if token in ("equation", "algorithm"):
                self._pass_equations(owner.name)
            elif token in _SECTIONS or token in ("initial", ";") or token[0] == '"':
                self._at += 1
            elif token in ("within", "annotation", "external"):
                self._statement()
            else:
                self._element(owner)
        return len(self._tokens)

    def _peek(self, ahead: int = 0) -> str:
        at = self._at + ahead
        return (self._tokens[at] if at < len(self._tokens) else _END)[0]

    def _pass_equations(self, name: str) -> None:
        """To the end of the class or its next section; `end if` and the like do not end it."""
        while self._at < len(self._tokens):
            if self._peek() in _SECTIONS or (self._peek() == "end" and self._peek(1) == name):
                return
            self._at += 1

    def _statement(self) -> tuple[Token, ...]:
        """The tokens up to the next semicolon outside of brackets, which is passed."""
        begin, depth = self._at, 0
        while self._at < len(self._tokens):
            token = self._peek()
            depth += (token in "([{") - (token in ")]}")
            self._at += 1
            if token == ";" and depth <= 0:
                return self._tokens[begin : self._at - 1]
        return self._tokens[begin:]

    def _element(self, owner: ClassText) -> None:
        offset = self._tokens[self._at][1]
        prefixes = set()
        while self._peek() in PREFIXES:
            prefixes.add(self._peek())
            self._at += 1
        if self._peek() in CLASS_KINDS:
            self._class(owner, frozenset(prefixes), offset)
        elif self._peek() == "import":
            owner.declarations.extend(_imports(self._statement()[1:], offset))
        elif self._peek() == "extends":
            owner.declarations.append(_use(Kind.EXTENDS, frozenset(prefixes), self._statement()[1:], offset))
        else:
            owner.declarations.append(_use(Kind.COMPONENT, frozenset(prefixes), self._statement(), offset))

    def _class(self, owner: ClassText, prefixes: frozenset[str], offset: int) -> None:
        kind = self._peek()
        while self._peek() in CLASS_KINDS:  # `operator function` has two
            self._at += 1
        is_extension = self._peek() == "extends"
        self._at += is_extension
        new = ClassText(self._peek(), kind, prefixes, offset, is_extension)
        self._at += 1
        begin = self._at
        if self._peek() == "=":
            self._at += 1
            statement = self._statement()
            while statement and statement[0][0] in PREFIXES:
                statement = statement[1:]
            if statement and statement[0][0] not in ("enumeration", "der"):
                new.declarations.append(_use(Kind.EXTENDS, frozenset(), statement, offset))
            end = self._at - 1
        else:
            self._at = behind_brackets(self._tokens, self._at)
            end = self.body(new)
            self._statement()
        new.tokens = self._tokens[begin:end]
        owner.classes.setdefault(new.name, new)
        owner.declarations.append(Declaration(Kind.CLASS, prefixes, new.name, (new.name,), (), (), offset))


def _use(kind: Kind, prefixes: frozenset[str], statement: tuple[Token, ...], offset: int) -> Declaration:
    """An extends clause or a component declaration, behind its prefixes."""
    class_name, at = dotted_name(statement, 0)
    rest = _without_annotations(statement[at:])
    depth, cut = 0, len(rest)
    for place, (token, _) in enumerate(rest):
        depth += (token in "([{") - (token in ")]}")
        if token == "constrainedby" and depth == 0:
            cut = place
            break
    declared = _declared(rest[:cut]) if kind is Kind.COMPONENT else ()
    return Declaration(kind, prefixes, class_name, declared, rest[:cut], rest[cut:], offset)


def _declared(rest: tuple[Token, ...]) -> tuple[str, ...]:
    """`[3] a(x = 1), b = 2` -> a, b."""
    names = []
    at = behind_brackets(rest, 0) if rest and rest[0][0] == "[" else 0
    is_expected = True
    while at < len(rest):
        if is_expected and is_name(rest[at][0]):
            names.append(rest[at][0])
        is_expected = rest[at][0] == ","
        at = max(at + 1, behind_brackets(rest, at))
    return tuple(names)


def _without_annotations(tokens: tuple[Token, ...]) -> tuple[Token, ...]:
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        if tokens[at][0] == "annotation":
            at = behind_brackets(tokens, at + 1)
        else:
            kept.append(tokens[at])
            at += 1
    return tuple(kept)


def _imports(statement: tuple[Token, ...], offset: int) -> list[Declaration]:
    """`A = B.C`, `B.C`, `B.*` and `B.{C, D}`."""
    words = [token for token, _ in statement]
    alias = words[0] if words[1:2] == ["="] else None
    class_name, at = dotted_name(statement, 2 if alias else 0)
    if words[at : at + 2] == [".", "{"]:
        pairs = [(f"{class_name}.{word}", word) for word in words[at + 2 :] if is_name(word)]
    elif "*" in words[at : at + 2]:
        pairs = [(class_name, "*")]
    else:
        pairs = [(class_name, alias or class_name.rsplit(".", 1)[-1])]
    return [Declaration(Kind.IMPORT, frozenset(), name, (local,), (), (), offset) for name, local in pairs]
