"""Columns of numbers from a plain text file, as test benches write them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]


def read_text(path: Path, wanted_by: str) -> str:
    """A whole file as text, UTF-8 or Latin-1, with or without a byte order mark.

    Args:
        wanted_by: what named the file, for the message.
    Raises:
        BadInput: the file cannot be read.
    """
    try:
        raw = path.read_bytes()
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise BadInput(f"{wanted_by}: cannot read {path} ({reason}); correct the name or put the file there") from error
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def read_table(path: Path, columns: tuple[str, ...], wanted_by: str) -> tuple[Array, NDArray[np.intp]]:
    """Read rows of numbers below optional header lines.

    Columns are separated by tabs, semicolons, commas or blanks; a decimal comma is read where the separator is not a
    comma. Lines that start with # and empty lines are skipped. Lines above the first row of numbers are the header.

    Args:
        columns: (n_c) names, in the order of the file.
        wanted_by: what named the file, for messages.
    Returns:
        values (n_r, n_c) and the line number of each row (n_r,).
    Raises:
        BadInput: no rows, a row of another width, text where a number belongs, or a number that is not finite.
    """
    rows: list[list[float]] = []
    lines: list[int] = []
    for line, text in enumerate(read_text(path, wanted_by).splitlines(), start=1):
        if not text.strip() or text.lstrip().startswith("#"):
            continue
        fields = _split(text.strip())
        if not rows and _is_header(fields, len(columns)):
            continue
        rows.append(_row(fields, columns, f"{path}, line {line}"))
        lines.append(line)
    if not rows:
        raise BadInput(f"{path} holds no numbers; it needs rows of {', '.join(columns)}")
    return np.array(rows), np.array(lines, dtype=np.intp)


def _split(text: str) -> list[str]:
    """Fields of one line, decimal commas turned into points. A comma at the edge of a word separates."""
    for separator in ("\t", ";"):
        if separator in text:
            return [field.strip().replace(",", ".") for field in text.split(separator)]
    words = text.split()
    if "," in text and (len(words) == 1 or any(word.startswith(",") or word.endswith(",") for word in words)):
        return [field.strip() for field in text.split(",")]
    return [word.replace(",", ".") for word in words]


def _is_header(fields: list[str], width: int) -> bool:
    """Whether a line above the first row names columns or tells a story, and is not a row with a misprint."""
    numbers = [_number(field) is not None for field in fields]
    return not any(numbers) or (not numbers[0] and len(fields) != width)


def _number(field: str) -> float | None:
    """The number a field holds; Python would also read 1_000."""
    try:
        return None if "_" in field else float(field)
    except ValueError:
        return None


def _row(fields: list[str], columns: tuple[str, ...], where: str) -> list[float]:
    """One row of finite numbers, a value per column."""
    if len(fields) != len(columns):
        raise BadInput(
            f"{where}: {len(fields)} columns where {len(columns)} belong ({', '.join(columns)}); "
            "complete the row, or name the file's columns in dataset.toml"
        )
    row = []
    for name, field in zip(columns, fields, strict=True):
        value = _number(field)
        if value is None:
            raise BadInput(f"{where}: {field!r} is no number for {name}; correct it or remove the row")
        if not math.isfinite(value):
            raise BadInput(f"{where}: {name} is {field}, which is not finite; correct it or remove the row")
        row.append(value)
    return row
