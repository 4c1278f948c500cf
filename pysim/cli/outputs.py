"""Where a command leaves its results: looked at before the work starts, so that hours of it are not in vain.

The folder of `--output` is new, empty, an unfinished run, or an earlier answer of ours, which the next one replaces.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from pysim.present.report import CHECKPOINT, MARKER, NEW, listed, mark

LOG = "log"  # in the folder: what a stopped fit goes on from
_GO_ON = (LOG, CHECKPOINT)
_OF_THE_SYSTEM = {".DS_Store", "Thumbs.db", "desktop.ini"}  # whoever looks into a folder leaves one; they stay
# What a stopped run goes on from; it lies there before any answer does. A kill may leave half of it under another name.
_UNFINISHED = re.compile(
    rf"({re.escape(MARKER)}|checkpoint\.jsonl|log/[^/]+/(iterations\.jsonl|state\.npz))(\.[0-9a-f]{{8}}\.part)?"
)


def prepare_folder(folder: Path, option: str = "--output", *, read: Sequence[Path] = ()) -> Path:
    """Make the folder now.

    Args:
        read: data sets, and single files, that the command reads.
    Raises:
        BadInput: it cannot be written to, or lies in a data set; names the option.
    """
    refuse_inside(folder, option, read)
    _probe(folder, f"{option} {folder}", "choose another folder")
    return folder


def prepare_file(path: Path, option: str, suffixes: Sequence[str] = (), *, read: Sequence[Path] = ()) -> Path:
    """Make the file's folder now.

    Args:
        read: as of `prepare_folder`.
    Raises:
        BadInput: the file cannot be written, lies in a data set or is what is read, or has none of the suffixes where
            some are given; names the option.
    """
    from pysim.types import BadInput

    if path.is_dir():
        raise BadInput(f"{option} {path}: this is a folder; name a file in it")
    if _is_device(path):
        return path
    refuse_inside(path, option, read)
    if suffixes and path.suffix.lower() not in suffixes:
        raise BadInput(f"{option} {path}: the suffix chooses the form; write one of {', '.join(suffixes)}")
    _probe(path.parent, f"{option} {path}", "choose another file")
    return path


def refuse_inside(path: Path, option: str, read: Sequence[Path]) -> None:
    """Nothing is written into what was measured.

    Args:
        read: data sets (a folder, or its dataset.toml) and single files.
    Raises:
        BadInput: the path lies in a data set, or is one of the files.
    """
    from pysim.types import BadInput

    target = path.resolve()
    for one in read:
        folder = one if one.is_dir() else one.parent if one.suffix == ".toml" else None
        if folder is not None and target.is_relative_to(folder.resolve()):
            raise BadInput(f"{option} {path}: inside the data set, which is never written to; choose a place outside")
        if folder is None:
            refuse_same(path, option, [one])


def refuse_same(path: Path, option: str, read: Sequence[Path]) -> None:
    """Nothing is written over a file that is read.

    Raises:
        BadInput: the path is one of the files.
    """
    from pysim.types import BadInput

    if path.resolve() in [one.resolve() for one in read]:
        raise BadInput(f"{option} {path}: this is what is read, and would be lost; choose another name")


def refuse_twice(path: Path, option: str, taken: dict[Path, str]) -> None:
    """Each result has a file of its own; `taken` are those of other options, and then this one too.

    Raises:
        BadInput: the file is another option's.
    """
    from pysim.types import BadInput

    other = taken.setdefault(path.resolve(), option)
    if other != option and not _is_device(path):
        raise BadInput(f"{option} {path}: {other} is written there, and one would be lost; choose another name")


def _is_device(path: Path) -> bool:
    """Such as /dev/null."""
    return path.exists() and not path.is_file()


def _probe(folder: Path, what: str, cure: str) -> None:
    from pysim.types import BadInput

    probe = folder / f".pysim-probe-{os.getpid()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise BadInput(f"{what}: cannot write there ({error.strerror or error}); {cure}") from error


def prepare_answer(
    folder: Path,
    *,
    data: Sequence[Path],
    read: Iterable[Path],
    beside: Iterable[Path | None],
    goes_on: Sequence[str] = (),
) -> None:
    """See that an answer can be written into the folder, and make it where it is missing.

    Args:
        data: data sets, which are never written into.
        read: files and Modelica libraries that the run takes.
        beside: other results of the same run, which may lie in the folder.
        goes_on: names in the folder from which a stopped run of this command goes on.
    Raises:
        BadInput: the folder holds a file that is not ours or that is read, lies in a data set, or cannot be written.
    """
    from pysim.types import BadInput

    for path in read:
        if path.exists() and path.resolve().is_relative_to(folder.resolve()):
            raise BadInput(
                f"--output {folder}: {path} is read, and the new answer would replace it; choose another folder"
            )
    ours = listed(folder) | _inside(folder, beside)
    other = next((name for name in _files(folder) if name not in ours and not _is_unfinished(name, goes_on)), None)
    if other is not None and _is_unfinished(other, _GO_ON):
        raise BadInput(
            f"--output {folder}: {other} is of another command that was stopped; choose a new folder, or repeat that "
            "command, which goes on from it"
        )
    if other is not None:
        raise BadInput(
            f"--output {folder}: {other} is there, which is no part of an earlier answer; choose a new folder, or move "
            "that file"
        )
    prepare_folder(folder, read=data)


@contextmanager
def answer_folder(folder: Path, *, beside: Iterable[Path | None] = ()) -> Iterator[Path]:
    """Give a folder to write a whole answer to; its files replace the earlier answer once all of them are there.

    Args:
        beside: other results of the same run, files and folders; those that lie in the folder stay there.
    """
    new = folder / NEW
    shutil.rmtree(new, ignore_errors=True)  # of a run that was killed
    new.mkdir(parents=True)
    try:
        yield new
        _replace(folder, new, _inside(folder, beside))
    finally:
        shutil.rmtree(new, ignore_errors=True)


def _replace(folder: Path, new: Path, beside: set[str]) -> None:
    """Move the files of the new answer in; every state in between is known to be ours."""
    coming, earlier, there = {path.name for path in new.iterdir()}, listed(folder), set(_files(folder))
    kept = beside | {name for name in there if any(name.startswith(f"{one}/") for one in beside)}
    mark(folder, earlier | coming | kept)
    for name in sorted((earlier & there) - coming - kept):
        _remove(folder, folder / name)
    for name in sorted(coming):
        (new / name).replace(folder / name)
    mark(folder, coming | kept)


def _remove(folder: Path, path: Path) -> None:
    """A file of ours, and the folders within the answer that it leaves empty."""
    path.unlink()
    for parent in path.relative_to(folder).parents:
        with suppress(OSError):  # something else is in it
            if parent.name:
                (folder / parent).rmdir()


def _files(folder: Path) -> Iterator[str]:
    """All files, but for the marker, what a killed run was writing, and what the system leaves."""
    for path in folder.rglob("*") if folder.is_dir() else ():
        name = path.relative_to(folder).as_posix()
        known = name == MARKER or path.name in _OF_THE_SYSTEM or name.partition("/")[0] == NEW
        if not known and (path.is_symlink() or not path.is_dir()):
            yield name


def _inside(folder: Path, paths: Iterable[Path | None]) -> set[str]:
    """Names in the folder, of those that lie there."""
    home, whole = folder.resolve(), [path.resolve() for path in paths if path is not None]
    return {path.relative_to(home).as_posix() for path in whole if path.is_relative_to(home)}


def _is_unfinished(name: str, goes_on: Sequence[str]) -> bool:
    """Whether a stopped run left it, from which a run of these names goes on."""
    first = name.partition("/")[0]
    return _UNFINISHED.fullmatch(name) is not None and first.startswith((MARKER, *goes_on))
