"""Which files of `--output` are ours: listed as they are written, and taken away before the next answer is."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import count
from pathlib import Path

LIST = "written.sha256"  # in the folder, a line per file; `sha256sum --check` reads it
_YOURS = "0" * 64  # in place of the digest of a file that stayed once: whatever it holds, it is the user's


def remember(folder: Path, files: Iterable[Path]) -> None:
    """Add files of the folder to its list, as they are now."""
    _add(folder, {path.name: _digest(folder / path.name) for path in files})


@contextmanager
def in_place_of_earlier(folder: Path, *, read: Sequence[Path] = ()) -> Iterator[None]:
    """Take away what is listed, for an answer that is written meanwhile.

    What was changed since, or is read now, is the user's and stays. Where an answer takes the name of what is the
    user's, that is left beside it under another and told.

    Args:
        read: files and Modelica libraries that this run takes.
    """
    copies = {path: _copied(path) for path in _remove_earlier(folder, read)}
    try:
        yield
    finally:
        for path, copy in copies.items():
            if path.is_file() and _digest(path) == _digest(copy):
                copy.unlink()
            else:
                print(f"Kept: your {path}, now {copy.name}; the new answer took its name")


def _remove_earlier(folder: Path, read: Sequence[Path]) -> list[Path]:
    """Take away what is listed; what was changed since, which is returned, and what is read stay there and listed."""
    kept = [path.resolve() for path in read]
    here = {folder / name: digest for name, digest in _listed(folder / LIST).items() if (folder / name).is_file()}
    changed = [path for path, digest in here.items() if _digest(path) != digest]
    stays = [path for path in here if path in changed or _is_read(path.resolve(), kept)]
    for path in here.keys() - stays:
        path.unlink()
    (folder / LIST).unlink(missing_ok=True)
    if stays:
        _add(folder, {path.name: _YOURS for path in stays})
    return changed


def _copied(path: Path) -> Path:
    """A copy under a free name, of a suffix that no library of Modelica classes has."""
    names = (path.with_name(f"{path.name}.yours-{k}") for k in count(1))
    copy = next(name for name in names if not name.exists())
    shutil.copy2(path, copy)
    return copy


def _is_read(path: Path, read: Sequence[Path]) -> bool:
    return any(path == one or (path.suffix == ".mo" and path.is_relative_to(one)) for one in read)


def _add(folder: Path, digests: Mapping[str, str]) -> None:
    with (folder / LIST).open("a", encoding="utf-8", newline="\n") as file:
        file.writelines(f"{digest}  {name}\n" for name, digest in digests.items())


def _listed(path: Path) -> dict[str, str]:
    """Name -> digest, of files right in the folder; a line that a kill has cut says nothing."""
    text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
    lines = (line.partition("  ") for line in text.splitlines())
    return {name: digest for digest, _, name in lines if name and Path(name).name == name}


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
