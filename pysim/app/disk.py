"""What is moved and removed within a project goes whole or not at all, though another program may show a file of it."""

from __future__ import annotations

import contextlib
import errno
import shutil
from collections.abc import Sequence
from pathlib import Path
from secrets import token_urlsafe

from pysim.types import BadInput

_CURES = {errno.ENOSPC: "make room on the disk", errno.EXDEV: "keep the whole project on one disk"}
_CURE = "close the program that shows it or a file in it, or allow writing there"


def disk_trouble(error: OSError) -> BadInput:
    """What the disk refuses, for a user: which file, why, and the cure."""
    why = error.strerror or str(error)
    if ";" not in why:  # pysim.io.write_file tells the cure itself
        why = f"{why}; {_CURES.get(error.errno or 0, _CURE)}"
    return BadInput(f"{error.filename}: {why}" if error.filename else why)


def move_all(moves: Sequence[tuple[Path, Path]]) -> None:
    """Move files and folders, one after the other, to places that are free; where one cannot be, all stay.

    Never by a copy: where Windows lets a file be read but not removed, the removal behind a copy stops half way.

    Args:
        moves: from where, to where; on one disk.
    Raises:
        BadInput: what cannot be moved.
    """
    done: list[tuple[Path, Path]] = []
    try:
        for old, new in moves:
            old.rename(new)
            done.append((old, new))
    except OSError as error:
        for old, new in reversed(done):
            with contextlib.suppress(OSError):
                new.rename(old)
        raise disk_trouble(error) from error


def remove(folder: Path, aside: Path) -> None:
    """Remove a folder.

    Args:
        aside: a folder on the same disk where it goes first; what cannot be removed of it then stays there.
    Raises:
        BadInput: it cannot be; nothing of it is removed.
    """
    aside.mkdir(parents=True, exist_ok=True)
    place = aside / token_urlsafe(9)
    move_all([(folder, place)])
    shutil.rmtree(place, ignore_errors=True)
