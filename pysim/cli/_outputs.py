"""Where a command leaves its results: looked at before the work starts, so that hours of it are not in vain."""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

JSON = (".json",)
PARAMETERS = "parameters.toml"  # in a folder of results: the fitted values


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
    if path.exists() and not path.is_file():  # a device, such as /dev/null
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
        if folder is None and target == one.resolve():
            raise BadInput(f"{option} {path}: this is what is read, and would be lost; choose another name")


def _probe(folder: Path, what: str, cure: str) -> None:
    from pysim.types import BadInput

    probe = folder / f".pysim-probe-{os.getpid()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise BadInput(f"{what}: cannot write there ({error.strerror or error}); {cure}") from error


def quoted(words: Sequence[str]) -> str:
    """Words as this system's shell takes them."""
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


def repeating(args: argparse.Namespace) -> str:
    """The line that runs the command again: the words that were typed."""
    return command_line(args.words)


def command_line(words: Sequence[str], folder: Path = Path(), *, program: str = "pysim") -> str:
    """The line that runs a program of ours with these words in a folder, quoted for a shell.

    Where this process runs in the environment that run.py made, its programs are on nobody's path and run.py is the way
    in.

    Args:
        program: that run.py knows by this name, `pysim` or `fmu-build`.
    """
    windows = sys.platform == "win32"
    root = Path(__file__).resolve().parents[2]
    if Path(sys.prefix).resolve() != root / ".venv" or not (root / "run.py").is_file():
        return quoted([program, *words])
    start = "run.py" if folder.resolve() == root else str(root / "run.py")
    return quoted(["py" if windows else "python3", start, program, *words])
