"""The columns of a log that nobody has described yet, as far as it names them itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.columns import names_its_columns
from pysim.io.load import READERS, RawTable
from pysim.io.load.table import number_of
from pysim.io.text_fields import LEFT_OUT
from pysim.types import BadInput


def column_names(path: Path) -> tuple[str, ...]:
    """Names of the columns of a log: its own where a header line has as many, else "time", "column 2" and so on.

    A column that holds no numbers, such as the date, is called LEFT_OUT, as a description has to.

    Args:
        path: text, .parquet or .tdms.
    Raises:
        BadInput: the file cannot be read, or holds no rows of at least two numbers.
    """
    return described_columns(path)[1]


def described_columns(path: Path) -> tuple[RawTable, tuple[str, ...]]:
    """The log as it is, and what a description calls its columns, see `column_names`.

    Raises:
        BadInput: as of `column_names`.
    """
    (table, *_) = READERS.get(path.suffix.lower(), READERS[".txt"])(path)
    if names_its_columns(path):
        return table, table.headings
    numeric = [_holds_numbers(cells) for cells in table.cells]
    if sum(numeric) < 2:
        raise BadInput(f"{path.name} holds no rows of numbers; it needs a column of times and those of the signals")
    names = table.headings
    if table.counted or len(set(names)) < len(names):
        names = tuple("time" if k == numeric.index(True) else f"column {k + 1}" for k in range(len(names)))
    return table, tuple(name if holds else LEFT_OUT for name, holds in zip(names, numeric, strict=True))


def _holds_numbers(cells: NDArray[np.generic]) -> bool:
    """Whether more than half of a column's cells are numbers; a word among them is refused where it is read."""
    if cells.dtype.kind in "fiub":
        return bool(np.isfinite(cells).any())
    found = [number_of(cell) for cell in cells.tolist()]
    return 2 * sum(value is not None and np.isfinite(value) for value in found) > len(found)
