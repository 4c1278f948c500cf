"""Modelica text as tokens: words, strings, numbers and signs with their places."""

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

_TOKEN = re.compile(
    r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/|[A-Za-z_]\w*|\'(?:\\.|[^\'\\])*\'|\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|\S',
    re.DOTALL,
)


def printable(message: str) -> str:
    """Signs that command a terminal or break a line, which a quoted file may hold, by their codes."""
    return "".join(sign if sign.isprintable() or sign == "\n" else ascii(sign)[1:-1] for sign in message)


class TextError(Exception):
    """Modelica text that cannot be used; `str()` is "file:line: message" as far as the place is known."""

    def __init__(self, message: str, file: Path | None = None, line: int | None = None) -> None:
        super().__init__(message)
        self.message, self.file, self.line = message, file, line

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line) if part is not None)
        return printable(f"{place}: {self.message}" if place else self.message)


class Token(NamedTuple):
    """A word, string, number or sign, and the offset at which it starts."""

    text: str
    start: int

    @property
    def end(self) -> int:
        return self.start + len(self.text)

    @property
    def is_string(self) -> bool:
        return self.text.startswith('"')


Tokens = tuple[Token, ...]


@lru_cache(maxsize=1024)
def tokenise(text: str) -> Tokens:
    """All tokens of a text, comments left out."""
    found = _TOKEN.finditer(text)
    return tuple([Token(match[0], match.start()) for match in found if match[0][:2] not in ("//", "/*")])


def is_name(word: str) -> bool:
    """Whether a token is an identifier, a quoted one too, or a keyword."""
    return word[:1].isidentifier() or word[:1] == "'"


def depth_change(token: Token) -> int:
    """1 for a bracket that opens, -1 for one that closes."""
    return (token.text in "([{") - (token.text in ")]}")


def behind_brackets(tokens: Tokens, at: int) -> int:
    """The place behind the bracket that opens at a place; the place itself where none opens."""
    depth = 0
    for stop in range(at, len(tokens)):
        depth += depth_change(tokens[stop])
        if depth == 0:
            return stop + 1 if stop > at else at
    return len(tokens)


def bracket(tokens: Tokens, at: int, sign: str = "(") -> Tokens:
    """The bracket that opens at a place with this sign, with what is in it; empty where there is none."""
    is_there = at < len(tokens) and tokens[at].text == sign
    return tokens[at : behind_brackets(tokens, at)] if is_there else ()


def split(tokens: Tokens, sign: str) -> Iterator[Tokens]:
    """The stretches between signs that are in no bracket; none for no tokens."""
    start = at = 0
    while at < len(tokens):
        if tokens[at].text == sign:
            yield tokens[start:at]
            start = at + 1
        at = max(at + 1, behind_brackets(tokens, at))
    if start < len(tokens):
        yield tokens[start:]


def dotted_name(tokens: Tokens, at: int) -> tuple[str, int]:
    """The name at a place, with its leading dot if there is one, and the place behind it."""
    begin = at
    at += at < len(tokens) and tokens[at].text == "."
    while at < len(tokens) and is_name(tokens[at].text):
        at += 1
        if at + 1 >= len(tokens) or tokens[at].text != "." or not is_name(tokens[at + 1].text):
            break
        at += 1
    return "".join(token.text for token in tokens[begin:at]), at


def split_name(name: str) -> list[str]:
    """`A.'b.c'.D` -> A, 'b.c', D."""
    parts: list[str] = []
    for piece in name.split("."):
        if parts and parts[-1].startswith("'") and (len(parts[-1]) == 1 or not parts[-1].endswith("'")):
            parts[-1] += f".{piece}"
        else:
            parts.append(piece)
    return parts


def written(text: str, tokens: Sequence[Token]) -> str:
    """The text from the first to the last of the tokens; "" for none."""
    return text[tokens[0].start : tokens[-1].end] if tokens else ""


def string_value(tokens: Sequence[Token]) -> str:
    """What the strings among the tokens say, joined, without quotes and escapes."""
    escapes = {"n": "\n", "t": "\t"}
    quoted = "".join(token.text[1:-1] for token in tokens if token.is_string)
    return re.sub(r"\\(.)", lambda match: escapes.get(match[1], match[1]), quoted, flags=re.DOTALL)
