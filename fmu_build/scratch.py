"""Folders to work in: gone when the work is done, and swept later where a kill prevented that."""

import errno
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from fmu_build.errors import BuildError

_PREFIX = "fmu_build-"
_FULL = (errno.ENOSPC, errno.EDQUOT) if hasattr(errno, "EDQUOT") else (errno.ENOSPC,)
SETTLED = 600.0  # s since its last use from when the folder of a process that is gone is swept
FORGOTTEN = 86400.0  # s from when any is


@contextmanager
def scratch() -> Iterator[Path]:
    """An empty folder of this process; those that killed processes have left are removed first.

    Raises:
        BuildError: it cannot be made, or there is no room left in it.
    """
    _sweep_once()
    try:
        with tempfile.TemporaryDirectory(prefix=f"{_PREFIX}{os.getpid()}-", ignore_cleanup_errors=True) as name:
            try:
                yield Path(name)
            except OSError as error:
                if error.errno not in _FULL:
                    raise
                raise _unusable(error) from error
    except FileNotFoundError as error:  # tempfile found no folder at all that it may write to
        raise _unusable(error) from error


def _unusable(error: OSError) -> BuildError:
    where = tempfile.gettempdir() if tempfile.tempdir else "any temporary folder"
    return BuildError(
        f"cannot work in {where}: {error.strerror or error}; make room there, or name another folder in TMPDIR."
    )


@cache
def _sweep_once() -> None:
    with suppress(OSError):
        sweep(Path(tempfile.gettempdir()))


def sweep(folder: Path) -> None:
    """Remove what ended processes of this user have left in a temporary folder."""
    for left in folder.glob(f"{_PREFIX}*"):
        with suppress(OSError):
            known = left.lstat()
            mine = not hasattr(os, "geteuid") or known.st_uid == os.geteuid()
            age = time.time() - known.st_mtime
            if mine and left.is_dir() and not left.is_symlink() and age > (FORGOTTEN if _is_alive(left) else SETTLED):
                shutil.rmtree(left, ignore_errors=True)


def _is_alive(left: Path) -> bool:
    """Whether the process whose number is in the name may still be there; Windows cannot be asked without harm."""
    number = left.name.removeprefix(_PREFIX).partition("-")[0]
    if not number.isdigit() or os.name == "nt":
        return True
    try:
        os.kill(int(number), 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
