"""Columns of files that name them themselves: what is there, and numbers from what was found."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.limits import ReadLimits
from pysim.types import BadInput

Array = NDArray[np.float64]
_SECOND = np.timedelta64(1, "s")


@dataclass(frozen=True)
class Numbers:
    """A column of a file that knows what its cells are.

    Args:
        values: (n_r,), finite.
        seconds: whether they came as moments or durations and so are in s, whatever the times of other files are in.
    """

    values: Array
    seconds: bool = False


@dataclass(frozen=True)
class Table:
    """The wanted columns of a file that names them.

    Args:
        values: (n_r, n_c), finite.
        seconds: columns that are in s, as of `Numbers`.
    """

    values: Array
    seconds: frozenset[str] = frozenset()


def optional_package(module: str, wanted_by: str, package: str) -> ModuleType:
    """A package that not everybody needs.

    Args:
        module: to import.
        wanted_by: why it is needed, for the message.
        package: what pip calls it.
    Raises:
        BadInput: it is not installed.
    """
    try:
        return import_module(module)
    except ImportError as error:
        raise BadInput(f"{wanted_by}, and the package for it is missing; run: pip install {package}") from error


def refuse_missing(
    path: Path, names: Sequence[str], present: Sequence[str], wanted_by: str, *, shown: Sequence[str] | None = None
) -> None:
    """Every name must stand in the file, once.

    Args:
        shown: names to choose from, where they are not those that are present.
    Raises:
        BadInput: the first one that does not, and what is there.
    """
    for name in names:
        count = list(present).count(name)
        if count != 1:
            found = f"{count} columns named {name!r}" if count else f"no column {name!r}"
            raise BadInput(f"{wanted_by}: {path} has {found}; name one of {', '.join(shown or present)}")


def refuse_many(path: Path, numbers: int, wanted_by: str, limits: ReadLimits) -> None:
    """A file may hold so many numbers in the columns that are wanted of it.

    Raises:
        BadInput: it announces more.
    """
    if numbers > limits.file_numbers:
        raise BadInput(
            f"{wanted_by}: {path} holds {numbers} numbers in the columns that are named, and {limits.file_numbers} at "
            "most are read from one file; name fewer columns, or split it into several logs"
        )


def as_numbers(path: Path, name: str, cells: NDArray[Any], *, row: int = 1, missing: bool = False) -> Numbers:
    """Finite numbers (n_r,) from the cells of a column; moments become seconds since the first one.

    Args:
        row: of the first cell in the file, for messages.
        missing: whether a cell may be empty; it is not-a-number then.
    Raises:
        BadInput: a cell that is empty, text or not finite, with its row.
    """
    seconds = cells.dtype.kind in "mM"
    if cells.dtype.kind == "M":
        cells = cells - cells[:1].repeat(cells.size)
    if cells.dtype.kind == "m":
        values = np.where(np.isnat(cells), np.nan, cells / _SECOND)
    elif cells.dtype.kind in "fiub":
        values = cells.astype(np.float64)
    else:
        rows = enumerate(cells.tolist(), row)
        found = [math.nan if missing and cell is None else _number(path, name, k, cell) for k, cell in rows]
        values = np.array(found, dtype=np.float64)
    wrong = np.flatnonzero(np.isinf(values) if missing else ~np.isfinite(values))
    if wrong.size:
        what = "empty or not a number" if math.isnan(values[wrong[0]]) else "not finite"
        raise BadInput(f"{path}, row {wrong[0] + row}: {name} is {what}; correct it or remove the row")
    return Numbers(values, seconds)


def _number(path: Path, name: str, row: int, cell: object) -> float:
    try:
        return float(cell)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise BadInput(f"{path}, row {row}: {cell!r} is no number for {name}; correct it or remove the row") from None
