"""Columns of a Parquet file, by name."""

from __future__ import annotations

from pathlib import Path

from pysim.io.named_columns import Numbers, as_numbers, optional_package, refuse_missing
from pysim.types import BadInput


def read_parquet(path: Path, names: tuple[str, ...], wanted_by: str) -> list[Numbers]:
    """The named columns, (n_r,) each.

    Args:
        wanted_by: what named the file, for messages.
    Raises:
        BadInput: the package is missing, no Parquet file, or a column that is not there or holds no numbers.
    """
    need = f"{wanted_by}: {path} is a Parquet file"
    arrow, parquet = (optional_package(module, need, "pyarrow") for module in ("pyarrow", "pyarrow.parquet"))
    try:
        with parquet.ParquetFile(path) as file:
            refuse_missing(path, names, file.schema_arrow.names, wanted_by)
            table = file.read(columns=list(names))
    except (OSError, arrow.ArrowInvalid) as error:
        raise BadInput(f"{wanted_by}: cannot read {path} as Parquet ({error}); correct the name or the file") from error
    return [as_numbers(path, name, table.column(name).to_numpy()) for name in names]
