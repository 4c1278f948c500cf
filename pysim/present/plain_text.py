"""Text for a terminal: columns of numbers, and sentences in lines."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence

WIDTH = 100  # letters of a line


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """A line per row, each column as wide as its widest text, which stand at its right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True)) for row in rows]


def wrapped(text: str, first: str = "", others: str = "", width: int = WIDTH) -> list[str]:
    """A sentence or two in lines.

    Args:
        first, others: what stands ahead of the first line and of the others.
    """
    return textwrap.wrap(text, width, initial_indent=first, subsequent_indent=others, break_on_hyphens=False)


def with_interval(value: float, ends: tuple[float, float], least: int = 5) -> list[str]:
    """A value and the ends of its interval, with as many digits as show two digits of the interval's width.

    Args:
        least: digits that they have in any case.
    """
    width, size = abs(ends[1] - ends[0]), max(map(abs, ends))
    more = math.floor(math.log10(size)) - math.floor(math.log10(width)) + 2 if 0 < width < math.inf else least
    digits = min(max(least, more), 12)  # more are noise of the arithmetic
    return [f"{number:.{digits}g}" for number in (value, *ends)]
