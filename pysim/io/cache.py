"""Where derived files are kept: machine code of the kernel, unpacked archives.

Such files are loaded as code, so a folder counts only if no other user could have written into it.
"""

from __future__ import annotations

import os
import stat
import tempfile
from pathlib import Path

from platformdirs import user_cache_path

from pysim.types import BadInput

FOLDER_VARIABLE = "HTB_CACHE"
_NAME = "hydraulic-test-bench"
_ANOTHER = f"name a folder of your own in the environment variable {FOLDER_VARIABLE}"


def cache_folder(purpose: str) -> Path:
    """The folder for one purpose, made for this user alone (mode 0700) where it is missing.

    It lies below $HTB_CACHE, else in the place that this system has for such files.

    Raises:
        BadInput: the folder cannot be written, belongs to another user, or others may write into it.
    """
    given = os.environ.get(FOLDER_VARIABLE)
    root = Path(given).absolute() if given else user_cache_path(_NAME, appauthor=False, opinion=False)
    folder = root / purpose
    try:
        root.parent.mkdir(parents=True, exist_ok=True)
        for made in (root, folder):
            made.mkdir(mode=0o700, exist_ok=True)
            check_private(made)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError as error:
        raise BadInput(f"cannot write into {folder}: {error.strerror or error}; {_ANOTHER}") from error


def check_private(folder: Path) -> None:
    """Refuse a folder into which another user could have put files.

    On Windows nothing is checked: there the rights of the user's profile protect its folders.

    Raises:
        BadInput: it belongs to another user, or its group or everybody may write into it.
    """
    if os.name == "nt":
        return
    known = folder.stat()
    if known.st_uid != os.geteuid():
        raise BadInput(f"{folder} belongs to another user, so nothing is loaded from it; {_ANOTHER}")
    if known.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        raise BadInput(
            f"other users may write into {folder}, so nothing is loaded from it; delete it, or type "
            f"`chmod -R go-w {folder}` if you trust what is in it"
        )
