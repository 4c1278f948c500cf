"""Variables of a .mat file: of any version to 7.2, and of 7.3, which is HDF5."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.load.foreign_units import EXTRA
from pysim.io.load.table import RawTable
from pysim.io.named_columns import optional_package
from pysim.types import BadInput

_HDF5 = b"\x89HDF\r\n\x1a\n"
_DEEP = 6  # structs within structs
_OBJECT = (
    "holds objects such as a timetable, which MATLAB alone reads; there: "
    "t = seconds(T.Time); x = T.x; save('log.mat', 't', 'x')"
)
Found = Iterator[tuple[str, NDArray[Any]]]


def read_matlab(path: Path) -> tuple[RawTable, ...]:
    """Vectors of the same length as the columns of a log; where there are several lengths, a log for each.

    Fields of structs are called as in MATLAB, log.x, or x where no other variable has that name. Columns of a matrix
    are m(:,1) and so on. Simulink's "structure with time" gives the labels of its signals.

    Raises:
        BadInput: the file cannot be read, a package is missing, or nothing in it is a vector of numbers.
    """
    try:
        with path.open("rb") as file:
            head = file.read(1024)
    except OSError as error:
        raise BadInput(f"cannot read {path} ({error.strerror or error}); correct the name") from error
    found = list(_of_hdf5(path) if _HDF5 in head else _of_old(path))
    by_length: dict[int, list[tuple[str, NDArray[Any]]]] = {}
    for name, values in found:
        by_length.setdefault(values.size, []).append((name, values))
    long = {size: own for size, own in by_length.items() if size > 1 and len(own) > 1}
    if not long:
        named = ", ".join(f"{name} ({values.size})" for name, values in found) or "no vectors"
        raise BadInput(f"{path} holds {named}, and a log needs a time and a signal of the same length; save both")
    return tuple(_table(path, own, len(long)) for own in long.values())


def _table(path: Path, own: Sequence[tuple[str, NDArray[Any]]], count: int) -> RawTable:
    """Vectors of one length, by their last name where that is enough."""
    full, cells = zip(*own, strict=True)
    last = [name.rpartition(".")[2] for name in full]
    names = tuple(short if last.count(short) == 1 else name for name, short in zip(full, last, strict=True))
    root = full[0].partition(".")[0]
    place = f"{path}, {root}" if count > 1 else str(path)
    return RawTable(place, f"{path.stem}-{root}.mat" if count > 1 else path.name, names, cells)


def _of_old(path: Path) -> Found:
    """To version 7.2."""
    scipy = optional_package("scipy.io", f"{path} is a MATLAB file", "scipy")
    try:
        content = scipy.loadmat(path, simplify_cells=True)
    except Exception as error:  # a damaged file gives any of a dozen types
        raise BadInput(f"cannot read {path} as a MATLAB file ({error}); save it again") from error
    if "__function_workspace__" in content:
        raise BadInput(f"{path} {_OBJECT}")
    for name, value in content.items():
        if not name.startswith("__"):
            yield from _vectors(str(path), name, value)


def _vectors(place: str, name: str, value: Any, depth: int = 0) -> Found:
    """Vectors of numbers within a value."""
    if isinstance(value, Mapping) and depth < _DEEP:
        if "values" in value and isinstance(value.get("label"), str):  # of Simulink's structure with time
            yield from _vectors(place, f"{name.rpartition('.')[0]}.{value['label']}", value["values"], depth)
            return
        for key, own in value.items():
            yield from _vectors(place, f"{name}.{key}", own, depth + 1)
    elif isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype.kind == "O"):
        for k, own in enumerate(value, 1):
            yield from _vectors(place, f"{name}({k})", own, depth + 1)
    elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub":
        yield from _columns(name, value)


def _columns(name: str, value: NDArray[Any]) -> Found:
    """A vector, or the columns of a matrix."""
    value = np.squeeze(value)
    if value.ndim == 1 and value.size > 1:
        yield name, value.astype(np.float64)
    elif value.ndim == 2:
        tall = value if value.shape[0] >= value.shape[1] else value.T
        for k in range(tall.shape[1]):
            yield f"{name}(:,{k + 1})", tall[:, k].astype(np.float64)


def _of_hdf5(path: Path) -> Found:
    """Version 7.3."""
    h5py = optional_package("h5py", f"{path} is a MATLAB file of version 7.3", f'"{EXTRA}"')
    try:
        with h5py.File(path, "r") as file:
            if "#subsystem#" in file and any("MATLAB_object_decode" in own.attrs for own in file.values()):
                raise BadInput(f"{path} {_OBJECT}")
            yield from _of_group(h5py, file, file, "", 0)
    except (OSError, RuntimeError, KeyError) as error:
        raise BadInput(f"cannot read {path} as a MATLAB file ({error}); save it again") from error


def _of_group(h5py: Any, file: Any, group: Any, ahead: str, depth: int) -> Found:
    for name, own in group.items():
        if name.startswith("#") or depth > _DEEP:
            continue
        if isinstance(own, h5py.Group):
            label = _text(own["label"]) if {"values", "label"} <= set(own) else ""
            if label:
                yield from _of_data(h5py, file, f"{ahead.rpartition('.')[0]}.{label}", own["values"], depth)
            else:
                yield from _of_group(h5py, file, own, f"{ahead}{name}.", depth + 1)
        else:
            yield from _of_data(h5py, file, f"{ahead}{name}", own, depth)


def _of_data(h5py: Any, file: Any, name: str, data: Any, depth: int) -> Found:
    if data.dtype.kind in "fiub" and data.attrs.get("MATLAB_class", b"double") != b"char":
        yield from _columns(name, np.asarray(data).T)
    elif data.dtype.kind == "O":  # references: cells, and arrays of structs
        for k, reference in enumerate(np.asarray(data).ravel(), 1):
            own = file[reference]
            if isinstance(own, h5py.Group):
                yield from _of_group(h5py, file, own, f"{name}({k}).", depth + 1)
            else:
                yield from _of_data(h5py, file, f"{name}({k})", own, depth + 1)


def _text(data: Any) -> str:
    """A row of characters."""
    return "".join(map(chr, np.asarray(data).ravel())) if data.dtype.kind == "u" else ""
