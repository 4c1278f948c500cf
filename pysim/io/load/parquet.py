"""All columns of a Parquet file that may hold a log."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.limits import LIMITS, ReadLimits
from pysim.io.load.foreign_units import EXTRA
from pysim.io.load.frame import arrow_column
from pysim.io.load.table import RawTable
from pysim.io.parquet_table import cells_of, opened


def read_parquet_log(path: Path, limits: ReadLimits = LIMITS) -> tuple[RawTable, ...]:
    """Its columns of numbers, moments and texts; nested ones are left out.

    Raises:
        BadInput: the package is missing, no Parquet file, or more in it than is read.
    """
    with opened(path, _flat, "load", limits, f'"{EXTRA}"') as (file, names):
        table = file.read(columns=list(names), use_threads=False)
        cells = tuple(map(_cells, table.columns))
    units = {own.name: unit for own in table.schema if (unit := _unit(own.metadata))}
    return (RawTable(str(path), path.name, tuple(table.column_names), cells, units),)


def _flat(arrow: ModuleType, schema: Any) -> tuple[tuple[str, ...], list[str]]:
    """Columns that are not nested, and those of texts."""
    flat = [own for own in schema if not arrow.types.is_nested(own.type)]
    texts = [own.name for own in flat if arrow.types.is_string(own.type) or arrow.types.is_large_string(own.type)]
    return tuple(own.name for own in flat), texts


def _cells(column: Any) -> NDArray[Any]:
    """Of all chunks; of texts those that are the same are one object."""
    chunks = [cells_of(chunk) if hasattr(chunk, "dictionary") else None for chunk in column.chunks]
    if not chunks or any(chunk is None for chunk in chunks):
        return arrow_column(column)
    return np.concatenate([chunk for chunk in chunks if chunk is not None])


def _unit(metadata: Any) -> str:
    """Of a field that carries one."""
    own = metadata or {}
    return next((own[key].decode() for key in (b"unit", b"units") if key in own), "")
