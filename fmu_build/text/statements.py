"""Reads the statements of equation and algorithm sections: which stands in which, and under what condition."""

from collections.abc import Iterator
from dataclasses import dataclass

from fmu_build.text.tokens import Token, Tokens, depth_change

_CONDITIONED = {"if": "then", "when": "then", "for": "loop", "while": "loop"}  # word that ends the condition
_ALTERNATIVES = ("elseif", "elsewhen")
_SECTIONS = ("initial", "equation", "algorithm", "public", "protected")


@dataclass(frozen=True)
class Statement:
    """`if`, `when`, `for` and `while` have as many conditions as branches, or one less with an `else`.

    Any other statement has none. `tokens` are all of it, with its semicolon.
    """

    tokens: Tokens
    conditions: tuple[Tokens, ...] = ()
    branches: tuple[tuple["Statement", ...], ...] = ()

    @property
    def word(self) -> str:
        return self.tokens[0].text

    @property
    def start(self) -> int:
        return self.tokens[0].start

    @property
    def end(self) -> int:
        return self.tokens[-1].end

    def inside(self) -> Iterator["Statement"]:
        """All statements in its branches, in written order, and in theirs."""
        for branch in self.branches:
            for statement in branch:
                yield statement
                yield from statement.inside()


def statements(tokens: Tokens, *, initial: bool = True) -> Iterator[Statement]:
    """Those of all sections. Text that is no Modelica gives what could be read of it.

    Args:
        tokens: of a class, without those of the classes in it.
        initial: whether those of initial sections too.
    """
    reader = _Reader(tokens)
    while reader.at < len(tokens):
        is_section = reader.peek() in ("equation", "algorithm")
        is_initial = is_section and reader.at > 0 and reader.peek(-1) == "initial"
        reader.at += 1
        found = tuple(reader.block()) if is_section else ()
        yield from found if initial or not is_initial else ()


class _Reader:
    def __init__(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.at = 0

    def peek(self, ahead: int = 0) -> str:
        at = self.at + ahead
        return self._tokens[at].text if at < len(self._tokens) else "end"

    def block(self) -> Iterator[Statement]:
        """Up to an `end`, another branch or another section, which are not passed."""
        while self.peek() not in ("end", "else", *_ALTERNATIVES, *_SECTIONS):
            yield self._conditioned() if self.peek() in _CONDITIONED else self._simple()

    def _simple(self) -> Statement:
        begin = self.at
        self._pass(";")
        return Statement(self._tokens[begin : self.at])

    def _conditioned(self) -> Statement:
        begin, word = self.at, self.peek()
        conditions: list[Tokens] = []
        branches: list[tuple[Statement, ...]] = []
        while not branches or self.peek() in ("else", *_ALTERNATIVES):
            is_else = self.peek() == "else"
            self.at += 1
            if not is_else:
                conditions.append(self._pass(_CONDITIONED[word]))
            branches.append(tuple(self.block()))
        self._pass(";")
        return Statement(self._tokens[begin : self.at], tuple(conditions), tuple(branches))

    def _pass(self, last: str) -> Tokens:
        """The tokens before `last` outside of brackets and of `if` expressions, which is passed too."""
        begin, depth, ifs = self.at, 0, 0
        while self.at < len(self._tokens):
            token: Token = self._tokens[self.at]
            self.at += 1
            if token.text == last and depth <= 0 and not ifs:
                return self._tokens[begin : self.at - 1]
            depth += depth_change(token)
            if last == "then":
                ifs += (token.text == "if") - (token.text == "then")
        return self._tokens[begin:]
