"""What a user may name as logs: files, folders, patterns, lists, and tables in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from glob import glob
from pathlib import Path, PurePath
from types import MappingProxyType
from typing import Any

from pysim.io.load.frame import frame_log, is_frame
from pysim.io.load.matlab import read_matlab
from pysim.io.load.parquet import read_parquet_log
from pysim.io.load.sheet import read_sheets
from pysim.io.load.table import RawTable
from pysim.io.load.tdms import read_tdms_log
from pysim.io.load.text import read_text_log
from pysim.types import BadInput

_TEXTS = (".txt", ".csv", ".dat", ".log", ".asc", ".lvm", ".tsv")
READERS: Mapping[str, Callable[[Path], tuple[RawTable, ...]]] = MappingProxyType(
    {
        **dict.fromkeys(_TEXTS, read_text_log),
        **dict.fromkeys((".xlsx", ".xls", ".xlsm", ".xlsb", ".ods"), read_sheets),
        ".mat": read_matlab,
        ".parquet": read_parquet_log,
        ".tdms": read_tdms_log,
    }
)


def tables_of(source: Any) -> tuple[RawTable, ...]:
    """Every log of a source, with a file name of its own.

    Args:
        source: a path, a pattern, a folder, a table in memory, a list of any, or a dict of these by name.
    Raises:
        BadInput: nothing is there, or what is there cannot be read.
    """
    tables = list(_tables(source, "log"))
    if not tables:
        raise BadInput(f"{source!r} holds no logs; give a path, a table, or several in a list")
    names = [table.name for table in tables]
    return tuple(
        replace(t, name=t.name if names.count(t.name) == 1 else f"{k + 1}-{t.name}") for k, t in enumerate(tables)
    )


def _tables(source: Any, name: str) -> Iterator[RawTable]:
    if is_frame(source):
        yield frame_log(source, name)
    elif isinstance(source, Mapping):
        for own, one in source.items():
            for table in _tables(one, str(own)):
                yield replace(table, name=f"{own}{Path(table.name).suffix}")
    elif isinstance(source, str | Path):
        yield from _read(_paths(str(source)))
    elif isinstance(source, Sequence):
        own = [one for one in source if isinstance(one, str | Path)]
        if len(own) == len(source):
            yield from _read([path for one in own for path in _paths(str(one))])
            return
        for number, one in enumerate(source, 1):
            yield from _tables(one, f"{name}{number}")
    else:
        raise BadInput(
            f"a log cannot be read from a {type(source).__name__}; give a path, a DataFrame, an xarray.Dataset or a "
            "dict of arrays"
        )


def _paths(place: str) -> list[Path]:
    """The files that a path or pattern means."""
    path = Path(place).expanduser()
    if path.is_dir():
        found = sorted(one for one in path.rglob("*") if one.is_file() and one.suffix.lower() in READERS)
        if not found:
            raise BadInput(f"{place} holds no logs; they end in {', '.join(READERS)}")
        return found
    if path.exists():
        return [path]
    found = sorted(Path(one) for one in glob(str(path), recursive=True))
    if not found:
        beside = path.parent.glob(f"[!.]*{path.suffix}") if path.parent.is_dir() else []
        near = sorted(one.name for one in beside)[:5]
        cure = f"there is {', '.join(near)}" if near else "correct the path"
        raise BadInput(f"there is no file {place}; {cure}")
    return [one for one in found if one.is_file()]


def _read(paths: list[Path]) -> Iterator[RawTable]:
    """Files, called as seen from the folder that all of them share."""
    for path, above in zip(paths, seen_from_shared([path.resolve().parent for path in paths]), strict=True):
        for table in READERS.get(path.suffix.lower(), read_text_log)(path):
            yield table if above == "." else replace(table, name=f"{above}/{table.name}")


def seen_from_shared(folders: Sequence[PurePath]) -> list[str]:
    """Folders as seen from the lowest one that holds all of them; "." where none does, as on two drives of Windows."""
    above = [folders[0], *folders[0].parents] if folders else []
    shared = next((one for one in above if all(folder.is_relative_to(one) for folder in folders)), None)
    return [folder.relative_to(shared).as_posix() if shared else "." for folder in folders]
