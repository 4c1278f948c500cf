"""Numbers of things in words."""

from __future__ import annotations


def counted(number: int, word: str) -> str:
    """That many of a thing whose plural ends in s: 1 record, 2 records."""
    return f"{number} {word}{'' if number == 1 else 's'}"
