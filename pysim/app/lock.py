"""One server at a time on a project: two would write into the same results and clear away each other's uploads."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from pysim.types import BadInput

LOCK = "server.lock"
_ROOM = 1000  # bytes for the words in the file
_LOCKED = 2**20  # place of the byte that is locked; Windows lets nobody read it, so it lies far behind the words


@contextmanager
def held(folder: Path) -> Iterator[Callable[[str], None]]:
    """Have a project to oneself.

    The system locks the file, and lifts the lock when this process ends, however it ends. So no lock is ever left
    behind, and what stands in the file counts only while it is locked.

    Args:
        folder: of the project.
    Returns:
        to learn the address of the page, which whoever comes second learns.
    Raises:
        BadInput: another server has it, or a disk that locks no files.
    """
    path = folder / LOCK
    try:
        file = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0))
    except OSError as error:
        raise BadInput(f"{path}: cannot write there ({error.strerror}); choose another folder") from error
    try:
        if not _locked(file, path):
            raise BadInput(f"{folder}: {_other(path)}")
        _write(file, "")
        yield lambda address: _write(file, json.dumps({"pid": os.getpid(), "address": address}))
    finally:
        os.close(file)


def _locked(file: int, path: Path) -> bool:
    """Lock it; False where another has it locked."""
    try:
        if sys.platform == "win32":
            import msvcrt

            os.lseek(file, _LOCKED, os.SEEK_SET)
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError as error:
        raise BadInput(f"{path}: this disk locks no files ({error.strerror}); put the project on another") from error
    return True


def _write(file: int, words: str) -> None:
    """In place, over all that stood there: the file is never shortened while it is locked."""
    os.lseek(file, 0, os.SEEK_SET)
    os.write(file, words.encode().ljust(_ROOM))


def _other(path: Path) -> str:
    """Who has it."""
    with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
        found = json.loads(path.read_bytes())
        return f"a workbench on it runs at {found['address']} (process {found['pid']}); use that one, or end it first"
    return "another workbench is being started on it; try again in a moment"
