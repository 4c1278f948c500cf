"""A log as its file has it: headings and cells, before anything is known of its columns."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]
_WORDS = {"", "nan", "null", "none", "na", "n/a", "#n/a", "-", "--"}  # how an empty cell is written


class Doubt(str):
    """A remark that the user should look at before anything is fitted."""

    __slots__ = ()


@dataclass(frozen=True)
class RawTable:
    """One log.

    Args:
        place: the file, or what else it came from, for messages; with the sheet or group where it has several.
        name: a file name for it, without folders.
        headings: (n_c) of the columns, as they are written there.
        cells: (n_c) arrays (n_r,): numbers, moments (datetime64, UTC), durations, or texts and the like as objects.
        units: of columns whose unit stands beside the heading.
        row: from the number of a row, from 0, to its place in the file: "line 7".
        remarks: what was left out or guessed in reading.
        counted: whether the file has no headings, so that columns are counted.
    """

    place: str
    name: str
    headings: tuple[str, ...]
    cells: tuple[NDArray[Any], ...]
    units: Mapping[str, str] = field(default_factory=dict)
    row: Callable[[int], str] = lambda k: f"row {k + 1}"
    remarks: tuple[str, ...] = ()
    counted: bool = False

    def column(self, heading: str) -> NDArray[Any]:
        """The cells below a heading."""
        return self.cells[self.headings.index(heading)]

    def numbers(self, heading: str) -> Array:
        """Numbers (n_r,) of a column, not-a-number where a cell is empty.

        Raises:
            BadInput: a cell that is neither, or is infinite, with its place.
        """
        cells = self.column(heading)
        if cells.dtype.kind == "m":
            return np.where(np.isnat(cells), np.nan, cells / np.timedelta64(1, "s"))
        if cells.dtype.kind == "M":
            raise BadInput(f"{self.place}: {heading} holds moments and no numbers; name it as time, or leave it out")
        values = cells.astype(np.float64) if cells.dtype.kind in "fiub" else _parsed(self, heading, cells)
        if np.isinf(values).any():
            where = self.row(int(np.argmax(np.isinf(values))))
            raise BadInput(f"{self.place}, {where}: {heading} is infinite; leave the cell empty or correct it")
        return values


def number_of(cell: object) -> float | None:
    """The number a cell holds, not-a-number where it is empty; None where it holds something else."""
    if cell is None or (isinstance(cell, str) and cell.strip().lower() in _WORDS):
        return np.nan
    try:
        return None if isinstance(cell, str) and "_" in cell else float(cell)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return None


def _parsed(table: RawTable, heading: str, cells: NDArray[Any]) -> Array:
    """Numbers from texts and the like."""
    found = [number_of(cell) for cell in cells.tolist()]
    wrong = next((k for k, value in enumerate(found) if value is None), None)
    if wrong is not None:
        shown = str(cells[wrong])[:40]
        raise BadInput(
            f"{table.place}, {table.row(wrong)}: {shown!r} is no number for {heading}; correct it, or empty the cell"
        )
    return np.array(found, dtype=np.float64)
