"""Columns of a Parquet file, by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.limits import LIMITS, ReadLimits
from pysim.io.memory import memory_bound
from pysim.io.named_columns import Table, as_numbers, optional_package, refuse_many, refuse_missing
from pysim.types import BadInput

Choose = Callable[[ModuleType, Any], tuple[tuple[str, ...], list[str]]]
_TIMES = 4  # of what is announced: batches, their texts and the numbers made of them are there at the same time


def read_parquet(
    path: Path,
    names: tuple[str, ...],
    wanted_by: str,
    limits: ReadLimits = LIMITS,
    missing: frozenset[str] = frozenset(),
) -> Table:
    """The named columns, unpacked some rows at a time.

    Args:
        wanted_by: what named the file, for messages.
        missing: columns whose cells may be empty.
        limits: what the file's own directory may announce, before anything is unpacked.
    Raises:
        BadInput: the package is missing, no Parquet file, a column that is not there or holds no numbers, or a file
            that unpacks to more than the limits.
    """

    def choose(arrow: ModuleType, schema: Any) -> tuple[tuple[str, ...], list[str]]:
        refuse_missing(path, names, schema.names, wanted_by)
        return names, [name for name in names if _is_text(arrow, path, name, schema.field(name).type)]

    with opened(path, choose, wanted_by, limits) as (file, _):
        return _read(path, file, names, missing, limits)


@contextmanager
def opened(
    path: Path, choose: Choose, wanted_by: str, limits: ReadLimits = LIMITS, package: str = "pyarrow"
) -> Iterator[tuple[Any, tuple[str, ...]]]:
    """The file, with the memory bound that its directory calls for, and the columns to read of it.

    Args:
        choose: of the package and the schema: these columns, and those of them whose cells are texts.
        wanted_by, limits: as of `read_parquet`.
        package: what pip calls the package.
    Raises:
        BadInput: as of `read_parquet`; what fails while the file is open is named too.
    """
    need = f"{wanted_by}: {path} is a Parquet file"
    arrow, parquet = (optional_package(module, need, package) for module in ("pyarrow", "pyarrow.parquet"))
    try:
        with parquet.ParquetFile(path) as file:
            names, texts = choose(arrow, file.schema_arrow)
            announced = _refuse_large(path, file.metadata, names, wanted_by, limits)
        # the cells of a column of texts are kept once each, so that a repeated one does not multiply
        with (
            memory_bound(limits.memory + _TIMES * announced),
            _plain_memory(arrow),
            parquet.ParquetFile(path, read_dictionary=texts) as file,
        ):
            yield file, names
    except MemoryError as error:
        raise BadInput(
            f"{wanted_by}: {path} takes more memory than the sizes in its own directory call for; export it again, or "
            "do not use it"
        ) from error
    except (OSError, arrow.ArrowException) as error:
        raise BadInput(f"{wanted_by}: cannot read {path} as Parquet ({error}); correct the name or the file") from error


def _is_text(arrow: ModuleType, path: Path, name: str, kind: Any) -> bool:
    """Whether a column's numbers are written as text."""
    types = arrow.types
    if types.is_dictionary(kind):
        kind = kind.value_type
    if types.is_string(kind) or types.is_large_string(kind):
        return True
    plain = (types.is_integer, types.is_floating, types.is_boolean, types.is_decimal, types.is_temporal, types.is_null)
    if not any(one(kind) for one in plain):
        raise BadInput(f"{path}: {name} holds {kind} and no numbers; write one number a row")
    return False


@contextmanager
def _plain_memory(arrow: ModuleType) -> Iterator[None]:
    """The system's own allocation, for others set address space aside long before it is used."""
    before = arrow.default_memory_pool()
    arrow.set_memory_pool(arrow.system_memory_pool())
    try:
        yield
    finally:
        arrow.set_memory_pool(before)


def _refuse_large(path: Path, about: Any, names: tuple[str, ...], wanted_by: str, limits: ReadLimits) -> int:
    """What the directory announces must be within the limits.

    Returns:
        bytes of the columns as they are stored, and as the numbers that they become.
    """
    refuse_many(path, about.num_rows * len(names), wanted_by, limits)
    size = 0
    for group in map(about.row_group, range(about.num_row_groups)):
        columns = map(group.column, range(group.num_columns))
        size += sum(column.total_uncompressed_size for column in columns if column.path_in_schema in names)
    if size > limits.file_bytes:
        raise BadInput(
            f"{wanted_by}: {path} unpacks to {size / 1e6:.0f} MB in the columns {', '.join(names)}, and "
            f"{limits.file_bytes / 1e6:.0f} MB at most are unpacked; split it into several logs"
        )
    return size + 8 * int(about.num_rows) * len(names)


def _read(path: Path, file: Any, names: tuple[str, ...], missing: frozenset[str], limits: ReadLimits) -> Table:
    values = np.empty((file.metadata.num_rows, len(names)))
    begun: dict[str, Any] = {}  # the first moment of a column of moments
    seconds: set[str] = set()
    row = 0
    for batch in file.iter_batches(batch_size=limits.batch_rows, columns=list(names), use_threads=False):
        if row + batch.num_rows > values.shape[0]:
            raise BadInput(f"{path} holds more rows than it announces ({values.shape[0]}); export it again")
        for j, name in enumerate(names):
            cells = cells_of(batch.column(name))
            if cells.dtype.kind == "M":
                cells = cells - begun.setdefault(name, cells[:1]).repeat(cells.size)
            found = as_numbers(path, name, cells, row=row + 1, missing=name in missing)
            values[row : row + batch.num_rows, j] = found.values
            seconds |= {name} if found.seconds else set()
        row += batch.num_rows
    return Table(values[:row], frozenset(seconds))


def cells_of(column: Any) -> NDArray[Any]:
    """Of some rows; of texts those that are the same are one object."""
    if not hasattr(column, "dictionary"):
        return np.asarray(column.to_numpy(zero_copy_only=False))
    own = np.array([*column.dictionary.to_pylist(), None], dtype=object)  # None: an empty cell
    return np.asarray(own[column.indices.fill_null(-1).to_numpy(zero_copy_only=False)])
