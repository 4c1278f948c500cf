"""Which files of `--output` are ours: listed as they are written, and taken away before the next answer is."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from pathlib import Path

LIST = "written.sha256"  # in the folder, a line per file; `sha256sum --check` reads it


def remember(folder: Path, files: Iterable[Path]) -> None:
    """Add files of the folder to its list, as they are now."""
    lines = [f"{_digest(folder / path.name)}  {path.name}\n" for path in files]
    with (folder / LIST).open("a", encoding="utf-8", newline="\n") as file:
        file.writelines(lines)


def remove_earlier(folder: Path, *, read: Sequence[Path] = ()) -> None:
    """Take away what is listed, and the list; what was changed since, or is read now, is the user's and stays.

    Args:
        read: files and Modelica libraries that this run takes.
    """
    kept = [path.resolve() for path in read]
    for name, digest in _listed(folder / LIST).items():
        path = folder / name
        if path.is_file() and not _is_read(path.resolve(), kept) and _digest(path) == digest:
            path.unlink()
    (folder / LIST).unlink(missing_ok=True)


def _is_read(path: Path, read: Sequence[Path]) -> bool:
    return any(path == one or (path.suffix == ".mo" and path.is_relative_to(one)) for one in read)


def _listed(path: Path) -> dict[str, str]:
    """Name -> digest, of files right in the folder; a line that a kill has cut says nothing."""
    text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
    lines = (line.partition("  ") for line in text.splitlines())
    return {name: digest for digest, _, name in lines if name and Path(name).name == name}


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
