"""Rows of numbers in one go, where a file keeps to one dialect: NumPy's reader in place of a loop over lines."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NUMBER = b"0123456789+-.eE\n"
_EDGES = (", ", " ,", ",\n", "\n,")  # a comma that separates where others are decimal


def dialect(line: str) -> tuple[str | None, bool]:
    """What separates the columns of a line (None: blanks), and whether its commas are decimal.

    A comma at the edge of a word separates, and so does one in a line without blanks.
    """
    for separator in ("\t", ";"):
        if separator in line:
            return separator, True
    words = line.split()
    if "," in line and (len(words) == 1 or any(word.startswith(",") or word.endswith(",") for word in words)):
        return ",", False
    return None, True


def read_block(lines: list[str], width: int) -> Array | None:
    """Numbers (n_r, width) of lines that all follow the dialect of the first, or None where one does not.

    Only what means the same to a reader that goes line by line is taken: no comments, no words, no infinity, no
    mixture of separators. Empty lines are skipped.

    Args:
        lines: without their ends; the first one is a row.
    """
    separator, decimal = dialect(lines[0].strip())
    text = "\n".join(lines)
    decimal = decimal and "," in text
    allowed = _NUMBER + b" " + (separator or "").encode() + (b"," if decimal else b"")
    if not text.isascii() or text.encode().translate(None, allowed):
        return None
    if decimal and separator is None and (width == 1 or any(edge in f"\n{text}\n" for edge in _EDGES)):
        return None
    try:
        rows = text.replace(",", ".").split("\n") if decimal else lines
        values = np.loadtxt(rows, delimiter=separator, comments=None, ndmin=2)
    except ValueError:
        return None
    return values if values.shape[1] == width and np.isfinite(values).all() else None
