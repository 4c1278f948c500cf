"""Modelica text as tokens, for the few things that rumoca does not pass on."""

import re
from functools import lru_cache

Token = tuple[str, int]  # text and offset

TOKEN = re.compile(
    r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/|[A-Za-z_]\w*|\'(?:\\.|[^\'\\])*\'|\d[\d.]*(?:[eE][+-]?\d+)?|\S', re.DOTALL
)


@lru_cache(maxsize=1024)
def tokenise(text: str) -> tuple[Token, ...]:
    """Tokens with their offsets, comments left out."""
    found = ((match.group(), match.start()) for match in TOKEN.finditer(text))
    return tuple(token for token in found if not token[0].startswith(("//", "/*")))
