"""The columns of a log that nobody has described yet, as far as it names them itself."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.columns import names_its_columns
from pysim.io.named_columns import optional_package
from pysim.io.quotation_marks import unquoted
from pysim.io.tdms_table import channel_names
from pysim.io.text_fields import DIALECTS, LEFT_OUT, Dialect, dialect, number
from pysim.io.text_table import read_text
from pysim.types import BadInput

_WORDS = 0.5  # share of a column's rows: more numbers than that, and the others are a header
_LINES = 400  # within which the first row of numbers must stand


def column_names(path: Path) -> tuple[str, ...]:
    """Names of the columns of a log: its own where a header line has as many, else "time", "column 2" and so on.

    A column that holds no numbers, such as the date, is called LEFT_OUT, as a description has to.

    Args:
        path: text, .parquet or .tdms.
    Raises:
        BadInput: the file cannot be read, or holds no rows of at least two numbers.
    """
    if names_its_columns(path):
        return _named(path)
    lines = unquoted(read_text(path, path.name), " ").split("\n")[:_LINES]
    rows = [line for line in lines if line.strip() and not line.lstrip().startswith("#")]
    found = [one for one in (_of_numbers(rows), _beside_words(rows)) if one is not None]
    if not found:
        raise BadInput(f"{path.name} holds no rows of numbers; it needs a column of times and those of the signals")
    return min(found, key=lambda one: one[0])[1]


def _of_numbers(rows: list[str]) -> tuple[int, tuple[str, ...]] | None:
    """The first row that holds numbers in all columns, and their names; empty ones at the end may have a name too."""
    for k, (heading, line) in enumerate(pairwise(["", *rows])):
        how = dialect(_trimmed(line))
        row, above = how.fields(_trimmed(line)), _split(_trimmed(heading), how)
        if len(row) > 1 and all(number(field) is not None for field in row):
            whole = how.fields(line)[: len(above)]
            if whole == [*row, *[""] * (len(above) - len(row))]:
                row = whole
            return k, _names(above, [field != "" for field in row])
    return None


def _beside_words(rows: list[str]) -> tuple[int, tuple[str, ...]] | None:
    """The first of the rows that have as many fields, numbers in two columns at least, and words in others."""
    found = []
    for how in DIALECTS if rows else ():
        numeric = _numeric(rows, how)
        steady = np.logical_and.accumulate(numeric[::-1])[::-1].sum(axis=1) > 1  # down to the last row
        if not steady.any():
            continue
        first = int(np.argmax(steady))
        share = numeric[first:].mean(axis=0)
        if np.all((share == 1) | (share < _WORDS)):
            names = _names(_split(rows[first - 1], how) if first else [], (share == 1).tolist())
            found.append((int(np.sum(share == 1)), first, names))
    return max(found)[1:] if found else None


def _numeric(rows: list[str], how: Dialect) -> NDArray[np.bool_]:
    """(n_r, n_c) whether a field is a number; none is in rows of another width than the last."""
    fields = [how.fields(row) for row in rows]
    width = len(fields[-1])
    here = [[len(row) == width and number(field) is not None for field in row[:width]] for row in fields]
    return np.array([row + [False] * (width - len(row)) for row in here], dtype=bool).reshape(-1, width)


def _names(above: list[str], numeric: list[bool]) -> tuple[str, ...]:
    """Of columns, from the heading above them where it has a name of its own for each.

    Args:
        numeric: (n_c) whether they hold numbers.
    """
    named = len(above) == len(numeric) == len(set(above)) and all(above)
    counted = [f"column {k + 1}" for k in range(len(numeric))]
    counted[numeric.index(True)] = "time"
    return tuple(name if holds else LEFT_OUT for name, holds in zip(above if named else counted, numeric, strict=True))


def _named(path: Path) -> tuple[str, ...]:
    """Of a file that knows its columns."""
    if path.suffix.lower() == ".parquet":
        parquet = optional_package("pyarrow.parquet", f"{path.name} is a Parquet file", "pyarrow")
        try:
            return tuple(parquet.read_schema(path).names)
        except (OSError, ValueError) as error:
            raise BadInput(f"cannot read {path.name} as Parquet ({error}); export it again") from error
    return channel_names(path)


def _split(heading: str, how: Dialect) -> list[str]:
    """A blank or a comma in a name is none of the numbers' business."""
    return [field.strip() for field in heading.split(how.separator)]


def _trimmed(line: str) -> str:
    return line.strip().rstrip("\t;,")
