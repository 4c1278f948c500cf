"""Modelica text as tokens with their places."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

_TOKEN = re.compile(
    r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/|[A-Za-z_]\w*|\'(?:\\.|[^\'\\])*\'|\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|\S',
    re.DOTALL,
)


@dataclass(frozen=True)
class Token:
    """A word, string, number or sign of the source, from `start` to `end`."""

    text: str
    start: int
    end: int

    @property
    def is_string(self) -> bool:
        """Whether it is a quoted text."""
        return self.text.startswith('"')


def tokenise(source: str) -> tuple[Token, ...]:
    """All tokens, comments left out."""
    found = (Token(match.group(), match.start(), match.end()) for match in _TOKEN.finditer(source))
    return tuple(token for token in found if not token.text.startswith(("//", "/*")))


def written(source: str, tokens: Sequence[Token]) -> str:
    """The source from the first to the last of the tokens; "" for none."""
    return source[tokens[0].start : tokens[-1].end] if tokens else ""


def closing(tokens: Sequence[Token], at: int) -> int:
    """Index of the bracket that closes the one at `at`; the last token where none does."""
    depth = 0
    for k in range(at, len(tokens)):
        depth += (tokens[k].text in "([{") - (tokens[k].text in ")]}")
        if depth == 0:
            return k
    return len(tokens) - 1


def split(tokens: Sequence[Token], sign: str) -> Iterator[Sequence[Token]]:
    """The stretches between signs that are in no bracket."""
    start = k = 0
    while k < len(tokens):
        if tokens[k].text in "([{":
            k = closing(tokens, k)
        elif tokens[k].text == sign:
            yield tokens[start:k]
            start = k + 1
        k += 1
    yield tokens[start:]


def string(token: Token) -> str:
    """What a quoted text says, on one line."""
    return " ".join(re.sub(r"\\(.)", r"\1", token.text[1:-1]).split())
