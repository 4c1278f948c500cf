"""Where derived files are kept: machine code of the native loops, extracted archives."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

_NAME = "hydraulic-test-bench"


def _user_cache() -> Path:
    """The place the operating system sets aside for files that can be made again."""
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")


def cache_folder(purpose: str) -> Path:
    """A writable folder for one purpose; below the system's temporary folder where the home is not writable."""
    for root in (_user_cache(), Path(tempfile.gettempdir())):
        folder = root / _NAME / purpose
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                return folder
        except OSError:
            continue
    return Path(tempfile.mkdtemp(prefix=f"{_NAME}-{purpose}-"))
