"""Unpack an FMU once, into a folder named after its content, and give it out only as long as it holds that content."""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
import time
import uuid
import zipfile
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from pysim.io.archive_check import DAMAGED, check_archive
from pysim.io.cache import cache_folder
from pysim.types import BadInput

KEPT_FOLDERS = 200
IN_USE = 86400.0  # s since its last use for which a folder stays, however many there are: a run may still read it

_CODE = {".so", ".dll", ".dylib"}  # suffixes of what a system loads
_PIECE = 1 << 20  # bytes compared at a time


def extracted(path: Path) -> Path:
    """The folder with the unpacked FMU. The same content is unpacked once per machine, and goes when long unused.

    What the folder holds is compared with the archive once in each process.

    Raises:
        BadInput: not a zip archive, one that is damaged or encrypted, one that `check_archive` refuses, or a folder
            that no longer holds what was unpacked.
    """
    folder = _folder(path.resolve(), stamp(path))
    try:
        os.utime(folder)  # used just now
    except FileNotFoundError:
        _unpack(path, folder)
        _let_go(folder.parent)
    _verify(path.resolve(), stamp(path), folder)
    return folder


def stamp(path: Path) -> tuple[int, int]:
    """When a file was changed last, in ns, and its size."""
    known = path.stat()
    return known.st_mtime_ns, known.st_size


@lru_cache(maxsize=64)
def _folder(path: Path, _stamp: tuple[int, int]) -> Path:
    return cache_folder("fmu") / hashlib.sha256(path.read_bytes()).hexdigest()[:32]


def _unpack(path: Path, folder: Path) -> None:
    """Unpack beside the target and rename, so that a folder that exists is always complete."""
    partial = Path(tempfile.mkdtemp(prefix="unpack-", dir=folder.parent))
    try:
        members = check_archive(path)
        with zipfile.ZipFile(path) as archive:
            for name, member in members.items():
                target = partial / name
                if member.is_dir():
                    target.mkdir(parents=True, exist_ok=True)
                    continue
                target.parent.mkdir(parents=True, exist_ok=True)
                with archive.open(member) as source, target.open("wb") as file:
                    shutil.copyfileobj(source, file)
        os.replace(partial, folder)
    except DAMAGED as error:
        raise BadInput(f"{path} is not an FMU that can be unpacked: {error}; export it again") from error
    except OSError:
        if not folder.is_dir():  # else another process was faster
            raise
    finally:
        shutil.rmtree(partial, ignore_errors=True)


@lru_cache(maxsize=256)
def _verify(path: Path, _stamp: tuple[int, int], folder: Path) -> None:
    """Refuse a folder whose files are not those of the archive, or that holds further libraries beside them."""
    members = {name: member for name, member in check_archive(path).items() if not member.is_dir()}
    with zipfile.ZipFile(path) as archive:
        changed = [name for name, member in members.items() if not _is_same(archive, member, folder / name)]
    found = (file.relative_to(folder).as_posix() for file in folder.rglob("*") if _CODE & set(file.suffixes))
    changed += [name for name in found if name not in members]
    if changed:
        raise BadInput(f"{folder} is not what {path} unpacks to ({changed[0]} was changed); delete that folder")


def _is_same(archive: zipfile.ZipFile, member: zipfile.ZipInfo, file: Path) -> bool:
    try:
        with archive.open(member) as source, file.open("rb") as copy:
            while piece := source.read(_PIECE):
                if copy.read(len(piece)) != piece:
                    return False
            return not copy.read(1)
    except OSError:
        return False


def _let_go(cache: Path) -> None:
    """Remove the folders unused for longest, but none that a run may still read."""
    lately, used = time.time() - IN_USE, {}
    for folder in cache.iterdir():
        with suppress(OSError):  # another process was faster
            if folder.is_dir():
                used[folder] = folder.stat().st_mtime
    for folder in sorted(used, key=used.__getitem__, reverse=True)[KEPT_FOLDERS:]:
        if used[folder] < lately:
            _remove(folder)


def _remove(folder: Path) -> None:
    """Rename and delete, so that a folder that exists is always complete. Windows refuses while a library is loaded."""
    gone = folder.with_name(f"unpack-{uuid.uuid4().hex}")
    with suppress(OSError):
        os.replace(folder, gone)
        shutil.rmtree(gone, ignore_errors=True)
