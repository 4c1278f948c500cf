"""Declarations of a class that say nothing of what they declare."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from fmu_build.text.classes import read_classes
from fmu_build.text.declarations import Source

_SECTIONS = {"equation", "algorithm", "external"}
_NO_DECLARATIONS = {"extends", "import", "annotation", "connector", "type", "function", "model", "block", "package"}


def without_description(file: Path, text: str) -> list[str]:
    """First words of each component declaration without a description; those of short classes have none to give."""
    within = re.match(r"within ([\w.]+);", text)
    found = []
    for written in read_classes(Source(file, text), within[1] if within else "").values():
        if not written.is_short:
            found += [" ".join(words) for words in _statements(written.words) if _is_silent(words)]
    return found


def _statements(words: Sequence[str]) -> Iterator[list[str]]:
    """Statements before the first equation, without what stands in brackets."""
    depth, statement = 0, []
    for word in words:
        if depth == 0 and (word in _SECTIONS or statement[:1] == ["initial"]):
            return
        depth -= word in (")", "]", "}")
        if word == ";" and depth == 0:
            yield statement
            statement = []
        elif depth == 0:
            statement.append(word)
        depth += word in ("(", "[", "{")


def _is_silent(statement: Sequence[str]) -> bool:
    words = list(statement)
    while words and (words[0] in ("public", "protected") or words[0].startswith('"')):
        words = words[1:]
    if not words or words[0] in _NO_DECLARATIONS:
        return False
    own = words[: words.index("annotation")] if "annotation" in words else words
    return not any(word.startswith('"') for word in own)
