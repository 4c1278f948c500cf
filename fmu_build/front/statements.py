"""Reads the statements of equation and algorithm sections: which stands in which, and under what condition."""

from collections.abc import Iterator
from dataclasses import dataclass

from fmu_build.front.tokens import Token

_CONDITIONED = {"if": "then", "when": "then", "for": "loop", "while": "loop"}  # word that ends the condition
_ALTERNATIVES = ("elseif", "elsewhen")
_SECTIONS = ("initial", "equation", "algorithm", "public", "protected")


@dataclass(frozen=True)
class Statement:
    """`if`, `when`, `for` and `while` have as many conditions as branches, or one less with an `else`.

    Any other statement is its first `word` only. `start` and `end` are offsets.
    """

    word: str
    start: int
    end: int
    conditions: tuple[tuple[Token, ...], ...] = ()
    branches: tuple[tuple["Statement", ...], ...] = ()

    def inside(self) -> Iterator["Statement"]:
        """All statements in its branches, in written order, and in theirs."""
        for branch in self.branches:
            for statement in branch:
                yield statement
                yield from statement.inside()


def statements(tokens: tuple[Token, ...]) -> Iterator[Statement]:
    """Those of all sections. Text that is no Modelica gives what could be read of it."""
    reader = _Reader(tokens)
    while reader.at < len(tokens):
        is_section = reader.peek() in ("equation", "algorithm")
        reader.at += 1
        if is_section:
            yield from reader.block()


class _Reader:
    def __init__(self, tokens: tuple[Token, ...]) -> None:
        self._tokens = tokens
        self.at = 0

    def peek(self, ahead: int = 0) -> str:
        at = self.at + ahead
        return self._tokens[at][0] if at < len(self._tokens) else "end"

    def block(self) -> Iterator[Statement]:
        """Up to an `end`, another branch or another section, which are not passed."""
        while self.peek() not in ("end", "else", *_ALTERNATIVES, *_SECTIONS):
            yield self._conditioned() if self.peek() in _CONDITIONED else self._simple()

    def _simple(self) -> Statement:
        word, start = self._tokens[self.at]
        self._pass(";")
        return Statement(word, start, self._offset())

    def _conditioned(self) -> Statement:
        word, start = self._tokens[self.at]
        conditions: list[tuple[Token, ...]] = []
        branches: list[tuple[Statement, ...]] = []
        while not branches or self.peek() in ("else", *_ALTERNATIVES):
            is_else = self.peek() == "else"
            self.at += 1
            if not is_else:
                conditions.append(self._pass(_CONDITIONED[word]))
            branches.append(tuple(self.block()))
        end = self._offset()
        self._pass(";")
        return Statement(word, start, end, tuple(conditions), tuple(branches))

    def _pass(self, last: str) -> tuple[Token, ...]:
        """The tokens before `last` outside of brackets and of `if` expressions, which is passed too."""
        begin, depth, ifs = self.at, 0, 0
        while self.at < len(self._tokens):
            token = self.peek()
            self.at += 1
            if token == last and depth <= 0 and not ifs:
                return self._tokens[begin : self.at - 1]
            depth += (token in "([{") - (token in ")]}")
            if last == "then":
                ifs += (token == "if") - (token == "then")
        return self._tokens[begin:]

    def _offset(self) -> int:
        return self._tokens[min(self.at, len(self._tokens) - 1)][1]
