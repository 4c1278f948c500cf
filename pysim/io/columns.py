"""Columns of numbers from a file; its suffix chooses the form."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.limits import LIMITS, ReadLimits
from pysim.io.named_columns import Table
from pysim.io.parquet_table import read_parquet
from pysim.io.tdms_table import read_tdms
from pysim.io.text_fields import LEFT_OUT
from pysim.io.text_table import read_table
from pysim.types import BadInput

Array = NDArray[np.float64]

TIME = "time"
_MANY = 0.05  # of all rows: more of them that stand still are no slip

# Files that name their columns themselves; all others are text.
_BY_NAME: Mapping[str, Callable[[Path, tuple[str, ...], str, ReadLimits, frozenset[str]], Table]] = {
    ".parquet": read_parquet,
    ".tdms": read_tdms,
}


@dataclass(frozen=True)
class Columns:
    """Rows of a file and where each stands.

    Args:
        path: the file.
        names: (n_c) of the columns.
        values: (n_r, n_c), finite, in the units of the file.
        numbers: (n_r,) where each row stands in the file, from 1.
        counted: what is counted, "line" or "row".
        seconds: columns that are in s whatever the file's times are said to be in, since they came as moments.
    """

    path: Path
    names: tuple[str, ...]
    values: Array
    numbers: NDArray[np.intp]
    counted: str = "line"
    seconds: frozenset[str] = frozenset()

    def place(self, row: int) -> str:
        """File and line of a row, for messages."""
        return f"{self.path}, {self.counted} {self.numbers[row]}"

    def in_seconds(self, name: str, second: float) -> Columns:
        """The same with a column of times in s.

        Args:
            second: how many s the unit of the file's times is.
        """
        factors = np.array([second if other == name and name not in self.seconds else 1.0 for other in self.names])
        # a long log is not copied for nothing
        values = self.values if np.all(factors == 1.0) else self.values * factors
        return replace(self, values=values, seconds=self.seconds | {name})

    def __getitem__(self, name: str) -> Array:
        """The column of that name, (n_r,)."""
        return self.values[:, self.names.index(name)]


def names_its_columns(path: Path) -> bool:
    """Whether columns of a file are found by their names; in all others it is their order that counts."""
    return path.suffix.lower() in _BY_NAME


def read_columns(
    path: Path, names: tuple[str, ...], wanted_by: str, *, clock: str = TIME, missing: bool = False
) -> Columns:
    """The named columns of a file.

    Args:
        names: of a text file's columns, in its order, LEFT_OUT for those that are not wanted; of a .parquet or .tdms
            file those that are wanted.
        wanted_by: what named the file, for messages.
        clock: what a .parquet or .tdms file calls its time.
        missing: whether cells may be empty, or not-a-number, but for those of the time.
    Raises:
        BadInput: what is wrong, with file, line (row) and remedy.
    """
    by_name = _BY_NAME.get(path.suffix.lower())
    wanted = tuple(name for name in names if name != LEFT_OUT)
    if by_name is not None:
        own = tuple(clock if name == TIME else name for name in wanted)
        table = by_name(path, own, wanted_by, LIMITS, frozenset(own) - {clock} if missing else frozenset())
        rows = table.values.shape[0]
        if not rows:
            raise BadInput(f"{path} holds no numbers; it needs rows of {', '.join(wanted)}")
        seconds = frozenset(name for name, its in zip(wanted, own, strict=True) if its in table.seconds)
        return Columns(path, wanted, table.values, np.arange(1, rows + 1), "row", seconds)
    values, lines = read_table(path, names, wanted_by, frozenset(names) - {TIME} if missing else frozenset())
    return Columns(path, wanted, values[:, [name != LEFT_OUT for name in names]], lines)


def refuse_standing_time(columns: Columns) -> None:
    """Time must increase from row to row.

    Raises:
        BadInput: it stands still or runs backwards, with the line.
    """
    found = standing(columns[TIME])
    if found is not None:
        raise BadInput(f"{columns.place(found[0])}: {found[1]}")


def standing(time: Array) -> tuple[int, str] | None:
    """The first row at which times (n_r,) in s do not increase, with what is wrong and its cure; None where all do."""
    wrong = np.diff(time) <= 0
    if not np.any(wrong):
        return None
    row = int(np.argmax(wrong)) + 1
    how = "stands still at" if time[row] == time[row - 1] else f"runs backwards from {time[row - 1]:.10g} s to"
    cure = "remove the repeated rows, or give each test a log of its own"
    if np.count_nonzero(wrong) > _MANY * wrong.size:
        cure = "log it with more digits, or correct which column it is"
    return row, f"time {how} {time[row]:.10g} s; {cure}"
