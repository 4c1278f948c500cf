"""All columns of a Parquet file that may hold a log."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pysim.io.limits import LIMITS
from pysim.io.load.foreign_units import EXTRA
from pysim.io.load.frame import arrow_column
from pysim.io.load.table import RawTable
from pysim.io.named_columns import optional_package
from pysim.io.parquet_table import refuse_large
from pysim.types import BadInput


def read_parquet_log(path: Path) -> tuple[RawTable, ...]:
    """Its columns of numbers, moments and texts; nested ones are left out.

    Raises:
        BadInput: the package is missing, no Parquet file, or more in it than is read.
    """
    need = f"{path} is a Parquet file"
    arrow, parquet = (optional_package(module, need, f'"{EXTRA}"') for module in ("pyarrow", "pyarrow.parquet"))
    try:
        with parquet.ParquetFile(path) as file:
            fields = [own for own in file.schema_arrow if not arrow.types.is_nested(own.type)]
            names = tuple(own.name for own in fields)
            refuse_large(path, file.metadata, names, "load", LIMITS)
            table = file.read(columns=list(names), use_threads=False)
    except (OSError, arrow.ArrowException) as error:
        raise BadInput(f"cannot read {path} as Parquet ({error}); correct the name or export it again") from error
    units = {own.name: unit for own in fields if (unit := _unit(own.metadata))}
    cells = tuple(arrow_column(table.column(k)) for k in range(len(names)))
    return (RawTable(str(path), path.name, names, cells, units),)


def _unit(metadata: Any) -> str:
    """Of a field that carries one."""
    own = metadata or {}
    return next((own[key].decode() for key in (b"unit", b"units") if key in own), "")
