"""Tables that are in memory: pandas, polars, Arrow, xarray, and dicts of arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.load.table import RawTable
from pysim.types import BadInput

_UNITS = ("units", "unit")


def is_frame(source: object) -> bool:
    """Whether it is a table in memory, of any kind."""
    is_column = _package(source) in ("pandas", "polars") and len(getattr(source, "shape", ())) == 1
    return not is_column and (_package(source) in _FRAMES or (isinstance(source, Mapping) and _holds_arrays(source)))


def frame_log(source: Any, name: str) -> RawTable:
    """One log from a table in memory.

    Args:
        name: for messages and as its file.
    Raises:
        BadInput: columns of different lengths, or none.
    """
    columns, units = _FRAMES.get(_package(source), _of_mapping)(source)
    sizes = {heading: cells.size for heading, cells in columns}
    if len(set(sizes.values())) != 1:
        shown = ", ".join(f"{heading} {size}" for heading, size in sizes.items()) or "none"
        raise BadInput(f"{name}: columns of different lengths ({shown}); give each rate a log of its own")
    headings, cells = zip(*columns, strict=True)
    return RawTable(name, f"{name}.txt", headings, cells, units)


Columns = tuple[list[tuple[str, NDArray[Any]]], dict[str, str]]


def _package(source: object) -> str:
    return type(source).__module__.partition(".")[0]


def _holds_arrays(source: Mapping[Any, Any]) -> bool:
    """Whether a mapping is a table, and none of logs by their names."""
    first = next(iter(source.values()), None)
    return not (isinstance(first, str) or hasattr(first, "__fspath__") or is_frame(first)) and first is not None


def _of_mapping(source: Mapping[str, Any]) -> Columns:
    return [(str(name), _plain(np.asarray(values).ravel())) for name, values in source.items()], {}


def _of_pandas(frame: Any) -> Columns:
    """The index is a column ahead of the others, unless it only counts them."""
    columns = [(_heading(name), _of_series(frame.iloc[:, k])) for k, name in enumerate(frame.columns)]
    if type(frame.index).__name__ != "RangeIndex":
        index = frame.index.to_series() if not hasattr(frame.index, "levels") else None
        if index is not None:
            columns.insert(0, (_heading(frame.index.name or "index"), _of_series(index)))
    return columns, {}


def _heading(name: object) -> str:
    """Of a column; two levels of them become one."""
    return " ".join(str(part) for part in name if str(part)) if isinstance(name, tuple) else str(name)


def _of_series(series: Any) -> NDArray[Any]:
    if getattr(series.dtype, "tz", None) is not None:
        series = series.dt.tz_convert("UTC").dt.tz_localize(None)
    kind = getattr(series.dtype, "kind", "O")
    if kind in "fiub" and not isinstance(series.dtype, np.dtype):  # numbers that know of empty cells
        return np.asarray(series.to_numpy(dtype=np.float64, na_value=np.nan))
    return _plain(series.to_numpy())


def _of_polars(frame: Any) -> Columns:
    return [(name, _plain(frame[name].to_numpy())) for name in frame.columns], {}


def _of_arrow(table: Any) -> Columns:
    columns = [(name, arrow_column(table.column(k))) for k, name in enumerate(table.column_names)]
    fields = [(own.name, own.metadata or {}) for own in table.schema]
    return columns, {name: own[key].decode() for name, own in fields for key in (b"unit", b"units") if key in own}


def arrow_column(column: Any) -> NDArray[Any]:
    """The cells of an Arrow column; an empty one is not-a-number, or None among texts."""
    return _plain(column.to_numpy())


def _of_xarray(source: Any) -> Columns:
    """All variables and coordinates over the longest dimension."""
    dataset = source.to_dataset(name=source.name or "value") if hasattr(source, "to_dataset") else source
    along = max(dataset.sizes, key=dataset.sizes.get)
    own = [name for name in (*dataset.coords, *dataset.data_vars) if dataset[name].dims == (along,)]
    units = {str(name): str(dataset[name].attrs[key]) for name in own for key in _UNITS if key in dataset[name].attrs}
    return [(str(name), _plain(dataset[name].values)) for name in own], units


def _plain(cells: NDArray[Any]) -> NDArray[Any]:
    """Numbers, moments and durations as they are, all else as objects."""
    return cells if cells.dtype.kind in "fiubmM" else cells.astype(object)


_FRAMES: Mapping[str, Any] = {"pandas": _of_pandas, "polars": _of_polars, "pyarrow": _of_arrow, "xarray": _of_xarray}
