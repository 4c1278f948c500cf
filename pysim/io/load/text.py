"""Text as loggers and spreadsheets write it: csv, txt, lvm and others."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.load.layout import Layout, is_empty, is_value, layout_of
from pysim.io.load.table import RawTable
from pysim.io.quotation_marks import unquoted
from pysim.io.text_block import read_block
from pysim.io.text_fields import COMMAS, DIALECTS, Dialect, number
from pysim.io.text_table import behind_labview_header, read_text
from pysim.types import BadInput

_HEAD, _TAIL = 400, 200  # lines that tell how the others are laid out
_UNITS, _BEGIN, _STEP = "Y_Unit_Label", "X0", "Delta_X"  # of LabVIEW's header
_MINUS = "\N{MINUS SIGN}"  # as word processors write it


def read_text_log(path: Path) -> tuple[RawTable, ...]:
    """The log that a text file holds.

    Raises:
        BadInput: no rows of numbers, or a row of another width.
    """
    lines = unquoted(read_text(path, "load").replace(_MINUS, "-"), " ").split("\n")
    begin = behind_labview_header(lines)
    there = [k for k in range(begin, len(lines)) if lines[k].strip() and not lines[k].lstrip().startswith("#")]
    usual_rows = there[-_TAIL - 1 : -1] if len(there) > _TAIL else there[len(there) // 2 :]
    how = _dialect([lines[k] for k in usual_rows])
    if how is None:
        raise BadInput(f"{path} holds no rows of numbers; it needs a column of times and those of the signals")
    usual, width = how
    noted = [k for k in range(begin, len(lines)) if lines[k].lstrip().startswith("#")][:_HEAD]
    head = [_head_row(lines[k], usual, width) for k in there[:_HEAD]]
    tail = [row for k in there[-_TAIL:] if len(row := _fields(lines[k], usual, width)) == width]
    found = layout_of(head, tail)
    if found is None:
        raise BadInput(f"{path} holds no rows of numbers; it needs a column of times and those of the signals")
    found = _with_comment(found, [lines[k].lstrip().lstrip("#") for k in noted if k < there[found.first]], usual, width)
    _refuse_decimal_commas(path, there[found.first], head[: found.first], usual, width)
    body, remarks = _body(path, lines, there[found.first :], usual, width)
    cells = _cells(lines, body, usual, found.headings)
    kept = width
    while found.headings[kept - 1] == f"column {kept}" and all(is_empty(cell) for cell in cells[kept - 1]):
        kept -= 1  # behind a separator at the end of every row
    names = found.headings[:kept]
    units = found.units | _labview_units(lines[:begin], names)
    names, cells = _with_labview_clock(lines[:begin], names, cells[:kept])
    place = str(path)
    return (RawTable(place, path.name, names, cells, units, lambda k: f"line {body[k] + 1}", remarks, found.counted),)


def _dialect(sample: Sequence[str]) -> tuple[Dialect, int] | None:
    """What separates the columns, and how many there are: what gives most values in rows of the same width."""
    best: tuple[float, Dialect, int] | None = None
    for how in DIALECTS:
        rows = [how.fields(line.strip(" ")) for line in sample]
        if not rows:
            continue
        width = Counter(map(len, rows)).most_common(1)[0][0]
        own = [row for row in rows if len(row) == width]
        values = sum(is_value(cell) for row in own for cell in row)
        there = sum(not is_empty(cell) for row in own for cell in row)
        ends = all(is_empty(row[-1]) for row in own)
        score = values / max(there, 1) * len(own) / len(rows)
        if width - ends > 1 and values and (best is None or score > best[0]):
            best = score, how, width
    return None if best is None or best[0] < 0.3 else best[1:]


def _bare(line: str, how: Dialect) -> str:
    """A line without blanks around it, which separate nothing but where blanks do."""
    return line.strip() if how.separator is None else line.strip(" ")


def _head_row(line: str, usual: Dialect, width: int) -> list[str]:
    """A line that may be one of headings: commas in names stay, and another separator counts where it gives all."""
    for how in (usual, *DIALECTS):
        bare = _bare(line, how)
        row = how.fields(bare)
        if len(row) == width or (how is usual and len(row) > 1):
            words = [word.strip() for word in bare.split(how.separator)]
            row = [field if is_value(field) else word for field, word in zip(row, words, strict=True)]
            return (row + [""] * (width - len(row)))[:width]
    return [""] * width


def _fields(line: str, usual: Dialect, width: int) -> list[str]:
    """A row; where the usual separator does not give all fields, and another one does, by that."""
    row = usual.fields(_bare(line, usual))
    if len(row) == width:
        return row
    for how in DIALECTS:
        other = how.fields(_bare(line, how))
        if len(other) == width and all(is_value(cell) or is_empty(cell) for cell in other):
            return other
    return row


def _with_comment(found: Layout, comments: list[str], usual: Dialect, width: int) -> Layout:
    """Headings from a comment, where no other line has any."""
    if not found.counted:
        return found
    for comment in reversed(comments):
        for how in (usual, *DIALECTS):
            row = [cell.strip() for cell in how.fields(comment.strip())]
            if len(row) == width and all(row) and not any(map(is_value, row)):
                return Layout(found.first, tuple(row), units=found.units)
    return found


def _refuse_decimal_commas(path: Path, at: int, above: Sequence[Sequence[str]], how: Dialect, width: int) -> None:
    """Commas that separate and are decimal as well."""
    named = [sum(not is_empty(cell) for cell in row) for row in above]
    if how == COMMAS and named and 2 * named[-1] == width:
        raise BadInput(
            f"{path}, line {at + 1}: {width} columns below {named[-1]} headings; if its commas are decimal, separate "
            "the columns by semicolons or tabs"
        )


def _body(
    path: Path, lines: Sequence[str], there: list[int], usual: Dialect, width: int
) -> tuple[list[int], tuple[str, ...]]:
    """Lines that are rows, and remarks on those at the end that are none."""
    body, remarks = list(there), []
    separators = width - 1
    odd = [
        k
        for k in body
        if (usual.separator is None or lines[k].count(usual.separator) != separators)
        and len(_fields(lines[k], usual, width)) != width
    ]
    while body and odd and body[-1] == odd[-1]:
        remarks.append(f"line {body[-1] + 1} at its end is no whole row and was left out")
        body.pop()
        odd.pop()
    if odd:
        count = len(_fields(lines[odd[0]], usual, width))
        raise BadInput(
            f"{path}, line {odd[0] + 1}: {count} columns where {width} belong; complete the row, or remove it"
        )
    return body, tuple(reversed(remarks))


def _cells(
    lines: Sequence[str], body: list[int], usual: Dialect, headings: tuple[str, ...]
) -> tuple[NDArray[Any], ...]:
    """Columns; of numbers where all cells are."""
    own = [lines[k] for k in body]
    block = read_block(own, headings) if own else None
    if block is not None and block.shape == (len(own), len(headings)):
        return tuple(block.T)
    rows = [_fields(line, usual, len(headings)) for line in own]
    columns = zip(*rows, strict=True)
    return tuple(_numbers_or_texts(column) for column in columns)


def _numbers_or_texts(column: Sequence[str]) -> NDArray[Any]:
    if not any("_" in cell for cell in column):
        try:
            return np.array(column, dtype=np.float64)
        except ValueError:
            pass
    return np.array(column, dtype=object)


def _labview_units(header: Sequence[str], headings: tuple[str, ...]) -> dict[str, str]:
    """Units of the channels, which stand behind the column of times."""
    return {name: unit for name, unit in zip(headings[1:], _labview(header, _UNITS), strict=False) if unit}


def _labview(header: Sequence[str], key: str) -> list[str]:
    """What a line of the header says of each channel."""
    line = next((line for line in header if line.startswith(f"{key}\t")), "")
    return [word.strip() for word in line.split("\t")[1:]]


def _with_labview_clock(
    header: Sequence[str], names: tuple[str, ...], cells: tuple[NDArray[Any], ...]
) -> tuple[tuple[str, ...], tuple[NDArray[Any], ...]]:
    """The first column filled from begin and step, where LabVIEW was set to write no times."""
    of_channels = [_labview(header, key) for key in (_BEGIN, _STEP)]
    begin, step = (number(words[0].replace(",", ".")) if words else None for words in of_channels)
    if begin is None or step is None or not all(is_empty(cell) for cell in cells[0].tolist()):
        return names, cells
    return ("X_Value", *names[1:]), (begin + step * np.arange(cells[0].size), *cells[1:])
