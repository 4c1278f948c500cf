"""File names that mean the same file, and only one, on Linux, Windows and macOS."""

from __future__ import annotations

import unicodedata
from pathlib import PurePosixPath

_FORBIDDEN = frozenset('<>:"|?*\\')
_NUMBERED = "123456789¹²³"
_PORTS = (f"{port}{n}" for port in ("com", "lpt") for n in _NUMBERED)
_DEVICES = frozenset({"con", "prn", "aux", "nul", "conin$", "conout$", *_PORTS})


def same_file(source: str) -> str:
    """What two relative paths have in common where they are one file: Windows and macOS know no capitals."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", str(PurePosixPath(source))).casefold())


def unusable_name(source: str) -> str:
    """Why a relative path, with / between its parts, is no file name on every system; empty where it is one."""
    for part in PurePosixPath(source).parts:
        bad = sorted({c for c in part if c in _FORBIDDEN or ord(c) < 32})
        if bad:
            return f"Windows has no file names with {' '.join(c if c.isprintable() else repr(c) for c in bad)}"
        if part[-1] in ". ":
            return f"Windows drops the end of {part!r}"
        if part.partition(".")[0].rstrip().lower() in _DEVICES:
            return f"{part!r} is a device on Windows"
    return ""
