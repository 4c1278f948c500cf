"""Where files are kept that can be made again: finished FMUs, machine code of the kernel, unpacked archives.

Such files are loaded as code, so a folder counts only if no other user could have written into it.
"""

import os
import stat
import tempfile
from pathlib import Path

from platformdirs import user_cache_path

_VARIABLE = "HTB_CACHE"
ANOTHER = f"name a folder of your own in the environment variable {_VARIABLE}"


class UnusableFolder(Exception):
    """A folder that cannot be written, or into which other users may write; `str()` says which, and the cure."""


def private_folder(purpose: str) -> Path:
    """The folder for one purpose, made for this user alone (mode 0700) where it is missing.

    It lies below $HTB_CACHE, else in the place that this system has for such files.

    Raises:
        UnusableFolder: it cannot be written, belongs to another user, or others may write into it.
    """
    given = os.environ.get(_VARIABLE)
    root = Path(given).absolute() if given else user_cache_path("hydraulic-test-bench", appauthor=False, opinion=False)
    folder = root / purpose
    try:
        root.parent.mkdir(parents=True, exist_ok=True)
        for made in (root, folder):
            made.mkdir(mode=0o700, exist_ok=True)
            _check_private(made)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError as error:
        raise UnusableFolder(f"cannot write into {folder}: {error.strerror or error}; {ANOTHER}") from error


def _check_private(folder: Path) -> None:
    """On Windows nothing is checked: there the rights of the user's profile protect its folders."""
    if os.name == "nt":
        return
    known = folder.stat()
    if known.st_uid != os.geteuid():
        raise UnusableFolder(f"{folder} belongs to another user, so nothing is loaded from it; {ANOTHER}")
    if known.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        raise UnusableFolder(
            f"other users may write into {folder}, so nothing is loaded from it; delete it, or type "
            f"`chmod -R go-w {folder}` if you trust what is in it"
        )
