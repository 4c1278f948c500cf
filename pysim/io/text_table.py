"""Columns of numbers from a plain text file, as test benches write them."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.quotation_marks import unquoted
from pysim.io.text_block import read_block
from pysim.io.text_fields import (
    COMMAS,
    LEFT_OUT,
    SEMICOLONS,
    TABS,
    Dialect,
    dialect,
    fits,
    number,
    row_fields,
    without_end_mark,
)
from pysim.types import BadInput

Array = NDArray[np.float64]

_LABVIEW_END, _LABVIEW_LINES = "***End_of_Header***", 200
_SHOWN = 60  # characters of a line in a message
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_LONG = re.compile(r"[^\n]{1000000}")  # no row and no line of a description is as long
_UNIT = re.compile(r"\s*[\[(].*")  # behind the name of a column


def read_text(path: Path, wanted_by: str) -> str:
    """A whole file as text, UTF-8 or Latin-1, with or without a byte order mark; lines end with a newline alone.

    UTF-16, which Windows programs call Unicode, is known by its mark.

    Args:
        wanted_by: what named the file, for the message.
    Raises:
        BadInput: the file cannot be read, or is no text.
    """
    if path.is_fifo() or path.is_char_device():
        raise BadInput(
            f"{path} is a pipe or a device, which may never end; write it into a file first", where=wanted_by
        )
    try:
        raw = path.read_bytes()
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise BadInput(
            f"cannot read {path} ({reason}); correct the name or put the file there", where=wanted_by
        ) from error
    if b"\0" in raw and raw[:2] not in _UTF_16:
        raise BadInput(f"{path} is no text file; export it as text, such as .csv", where=wanted_by)
    try:
        text = raw.decode("utf-16" if raw[:2] in _UTF_16 else "utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    long = _LONG.search(text)
    if long:
        line = text.count("\n", 0, long.start()) + 1
        raise BadInput(f"{path}, line {line} is longer than a million characters; break it into rows", where=wanted_by)
    return text


def read_table(
    path: Path, columns: tuple[str, ...], wanted_by: str, missing: frozenset[str] = frozenset()
) -> tuple[Array, NDArray[np.intp]]:
    """Read rows of numbers below optional header lines.

    Columns are separated by tabs, semicolons, commas or blanks; a decimal comma is read where the separator is not a
    comma, and between quotation marks. These mean nothing else, nor does a separator at the end of every row. Lines
    that start with # and empty lines are skipped. Lines above the first row of numbers are the header, and so is what
    a LabVIEW measurement file (.lvm) says to be.

    Args:
        columns: (n_c) names, in the order of the file; those called LEFT_OUT are not looked at.
        wanted_by: what named the file, for messages.
        missing: columns whose cells may be empty, or not-a-number.
    Returns:
        values (n_r, n_c) and the line number of each row (n_r,).
    Raises:
        BadInput: no rows, a row of another width, text where a number belongs, a number that is not finite, or a
            header that names the columns in another order.
    """
    lines = unquoted(read_text(path, wanted_by)).split("\n")
    while len(lines) > 1 and not lines[-1].strip():
        lines.pop()
    begin = behind_labview_header(lines)
    first = next((i for i in range(begin, len(lines)) if _is_row(lines[i], columns)), None)
    if first is None:
        last = f", and ends with {lines[-1].strip()[:_SHOWN]!r}" if lines[-1].strip() else ""
        raise BadInput(f"{path} holds no numbers; it needs rows of {', '.join(columns)}{last}")
    body = lines[first:]
    numbers = np.arange(first + 1, len(lines) + 1)
    if any("#" in line or not line or line.isspace() for line in body):  # the usual log has no such lines
        numbers = numbers[[not _is_skipped(line) for line in body]]
        body = [lines[at - 1] for at in numbers]
    body = _without_end_marks(body, columns)
    _, usual = row_fields(body[0], columns)
    _refuse_other_order(list(enumerate(lines[:first], 1))[begin:], path, columns, wanted_by, usual)
    values = read_block(body, columns, missing)
    if values is None or len(values) != len(body):
        rows = zip(numbers.tolist(), body, strict=True)
        values = np.array([_row(line, columns, f"{path}, line {at}", usual, missing) for at, line in rows])
    return values, numbers


def _refuse_other_order(
    header: list[tuple[int, str]], path: Path, columns: tuple[str, ...], wanted_by: str, usual: Dialect
) -> None:
    """A column that is headed by the name of another one would be taken for it.

    Args:
        header: line numbers and lines above the first row.
        usual: dialect of the rows.
    """
    wanted = [name.casefold() for name in columns]
    for at, line in header:
        names = line.strip().lstrip("#").strip().rstrip("\t;,")
        for separator in {dialect(names).separator, usual.separator}:
            heads = [_UNIT.sub("", field.strip()) for field in names.split(separator)]
            small = [head.casefold() for head in heads]
            if len(small) == len(wanted) and any(
                head != name != LEFT_OUT and head in wanted and small.count(head) == 1
                for head, name in zip(small, wanted, strict=True)
            ):
                raise BadInput(
                    f"the header has the columns in the order {', '.join(heads)}, and {wanted_by} in the order "
                    f"{', '.join(columns)}; correct the one that is wrong",
                    where=f"{path}, line {at}",
                )


def _without_end_marks(rows: list[str], columns: tuple[str, ...]) -> list[str]:
    """Rows whose first one ends with a separator, without it: nothing stands behind, unless a column is left out there.

    Such a column may be empty; then there are as many separators as columns, less one.
    """
    first = rows[0].rstrip(" ")
    if not first.endswith(("\t", ";", ",")) or (columns[-1] == LEFT_OUT and first.count(first[-1]) < len(columns)):
        return rows
    return [row.rstrip(" ").removesuffix(first[-1]) for row in rows]


def behind_labview_header(lines: list[str]) -> int:
    """Where the rows of a LabVIEW measurement file begin; its header holds numbers too."""
    marked = (i + 1 for i, line in enumerate(lines[:_LABVIEW_LINES]) if line.startswith(_LABVIEW_END))
    return max(marked, default=0)


def _is_skipped(line: str) -> bool:
    """Empty lines and comments."""
    line = line.lstrip()
    return not line or line.startswith("#")


def _is_row(line: str, columns: tuple[str, ...]) -> bool:
    """Whether a line is the first row of numbers: neither skipped nor a header."""
    if _is_skipped(line):
        return False
    if not _is_header(dialect(line.strip()).fields(line.strip()), len(columns)):
        return True
    return LEFT_OUT in columns and _looks_like_row(line, columns)


def _looks_like_row(line: str, columns: tuple[str, ...]) -> bool:
    """Whether numbers stand where they are wanted once another separator is tried, but for a misprint."""
    if any(fits(row_fields(text, columns)[0], columns) for text in (line, without_end_mark(line))):
        return True
    wanted = [k for k, name in enumerate(columns) if name != LEFT_OUT]
    tried = (one.fields(line) for one in (TABS, SEMICOLONS, COMMAS))
    return any(len(f) == len(columns) and any(number(f[k]) is not None for k in wanted) for f in tried)


def _is_header(fields: list[str], width: int) -> bool:
    """Whether a line above the first row names columns or is a remark, and is not a row with a misprint."""
    numbers = [number(field) is not None for field in fields]
    return not any(numbers) or (not numbers[0] and len(fields) != width)


def _row(
    line: str,
    columns: tuple[str, ...],
    where: str,
    usual: Dialect | None = None,
    missing: frozenset[str] = frozenset(),
) -> list[float]:
    """One row of finite numbers, a value per column."""
    fields, how = row_fields(line, columns, usual)
    if len(fields) != len(columns):
        cure = f'complete the row; in a data set, dataset.toml names every column, "{LEFT_OUT}" those to leave out'
        if how == COMMAS and "." not in line and len(columns) < len(fields) <= 2 * len(columns):
            cure = "if its commas are decimal, separate the columns by semicolons or tabs"
        raise BadInput(f"{where}: {len(fields)} columns where {len(columns)} belong ({', '.join(columns)}); {cure}")
    row = []
    for name, field in zip(columns, fields, strict=True):
        value = 0.0 if name == LEFT_OUT else math.nan if name in missing and not field else number(field)
        if value is None:
            cure = "write it as a number of seconds" if ":" in field else "correct it or remove the row"
            raise BadInput(f"{where}: {field!r} is no number for {name}; {cure}")
        if not (math.isfinite(value) or (math.isnan(value) and name in missing)):
            raise BadInput(f"{where}: {name} is {field}, which is not finite; correct it or remove the row")
        row.append(value)
    return row
