"""Rows of numbers in one go, where a file keeps to one dialect: NumPy's reader in place of a loop over lines."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.io.text_fields import LEFT_OUT, Dialect, row_fields

Array = NDArray[np.float64]

_NUMBER = b"0123456789+-.eE\n"
_EDGES = (", ", " ,", ",\n", "\n,")  # a comma that separates where others are decimal


def read_block(lines: list[str], columns: tuple[str, ...], missing: frozenset[str] = frozenset()) -> Array | None:
    """Numbers (n_r, n_c) of lines that all follow the dialect of the first, or None where one does not.

    Only what means the same to a reader that goes line by line is taken: no comments, no words but in columns that are
    left out, no infinity, no mixture of separators. Empty lines are skipped.

    Args:
        lines: without their ends; the first one is a row.
        columns: (n_c) names; those called LEFT_OUT may be 0 whatever they hold.
        missing: columns that may hold not-a-number.
    """
    _, how = row_fields(lines[0], columns)
    values = _of_numbers(lines, len(columns), how, missing=bool(missing))
    if values is None and LEFT_OUT in columns and how.separator is not None:
        values = _of_wanted(lines, columns, how, how.separator)
    if values is None or np.isinf(values).any():
        return None
    whole = [name not in missing for name in columns]
    return values if np.isfinite(values[:, whole]).all() else None


def _of_numbers(lines: list[str], width: int, how: Dialect, *, missing: bool) -> Array | None:
    """Where nothing else stands in any column."""
    separator, text = how.separator, "\n".join(lines)
    decimal = how.decimal and "," in text
    allowed = _NUMBER + (b"na" if missing else b"") + b" " + (separator or "").encode() + (b"," if decimal else b"")
    if not text.isascii() or text.encode().translate(None, allowed):
        return None
    if decimal and separator is None and (width == 1 or any(edge in f"\n{text}\n" for edge in _EDGES)):
        return None
    try:
        rows = text.replace(",", ".").split("\n") if decimal else lines
        values = np.loadtxt(rows, delimiter=separator, comments=None, ndmin=2)
    except ValueError:
        return None
    return values if values.shape[1] == width else None


def _of_wanted(lines: list[str], columns: tuple[str, ...], how: Dialect, separator: str) -> Array | None:
    """Where every line has as many separators as it should, and numbers in the columns that are wanted."""
    if any(line.count(separator) != len(columns) - 1 for line in lines):
        return None
    wanted = [k for k, name in enumerate(columns) if name != LEFT_OUT]
    values = np.zeros((len(lines), len(columns)))
    try:
        rows = "\n".join(lines).replace(",", ".").split("\n") if how.decimal else lines
        values[:, wanted] = np.loadtxt(rows, delimiter=separator, comments=None, ndmin=2, usecols=wanted)
    except ValueError:
        return None
    return values
