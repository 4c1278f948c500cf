"""Sheets of xlsx, xls and ods."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.load.foreign_units import EXTRA
from pysim.io.load.layout import is_empty, layout_of
from pysim.io.load.table import RawTable
from pysim.io.named_columns import optional_package
from pysim.types import BadInput

_HEAD, _TAIL = 400, 200  # rows that tell how the others are laid out


def read_sheets(path: Path) -> tuple[RawTable, ...]:
    """Every sheet that holds rows of numbers, as a log of its own.

    Raises:
        BadInput: the package is missing, no such file, or no sheet with rows of numbers.
    """
    calamine = optional_package("python_calamine", f"{path} is a spreadsheet", f'"{EXTRA}"')
    try:
        book = calamine.CalamineWorkbook.from_path(path)
        sheets = {name: book.get_sheet_by_name(name).to_python(skip_empty_area=False) for name in book.sheet_names}
    except (OSError, ValueError, calamine.CalamineError) as error:
        raise BadInput(f"cannot read {path} as a spreadsheet ({error}); save it again, or as .csv") from error
    found = [_table(path, name, rows, len(sheets)) for name, rows in sheets.items() if rows]
    tables = tuple(table for table in found if table is not None)
    if not tables:
        raise BadInput(f"{path}: no sheet holds rows of numbers, among {', '.join(sheets)}; save the sheet as values")
    return tables


def _table(path: Path, sheet: str, rows: list[list[Any]], count: int) -> RawTable | None:
    """One sheet, without what is empty around it."""
    width = max(map(len, rows))
    rows = [[*row, *[""] * (width - len(row))] for row in rows]
    there = [k for k, row in enumerate(rows) if not all(map(is_empty, row))]
    if not there:
        return None
    used = [c for c in range(width) if any(not is_empty(rows[k][c]) for k in there)]
    own = [[rows[k][c] for c in used] for k in there]
    found = layout_of(own[:_HEAD], own[-_TAIL:])
    if found is None:
        return None
    body, remarks = own[found.first :], []
    places = there[found.first :]
    while body and all(is_empty(cell) or isinstance(cell, str) for cell in body[-1]):  # notes below the numbers
        remarks.append(f"row {places[-1] + 1} at its end holds no numbers and was left out")
        body, places = body[:-1], places[:-1]
    place = f"{path}, sheet {sheet}" if count > 1 else str(path)
    name = f"{path.stem}-{sheet}{path.suffix}" if count > 1 else path.name
    cells = tuple(_column([row[c] for row in body]) for c in range(len(used)))
    return RawTable(
        place, name, found.headings, cells, found.units, lambda k: f"row {places[k] + 1}", tuple(reversed(remarks))
    )


def _column(cells: list[Any]) -> NDArray[Any]:
    """Numbers where all cells are."""
    if all(isinstance(cell, int | float) and not isinstance(cell, bool) for cell in cells):
        return np.array(cells, dtype=np.float64)
    column = np.empty(len(cells), dtype=object)
    column[:] = cells
    return column
