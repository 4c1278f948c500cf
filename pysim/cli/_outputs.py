"""Where a command leaves its results: looked at before the work starts, so that hours of it are not in vain."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path


def prepare_folder(folder: Path, option: str = "--output") -> Path:
    """Make the folder now.

    Raises:
        BadInput: it cannot be written to; names the option.
    """
    _probe(folder, f"{option} {folder}", "choose another folder")
    return folder


def prepare_file(path: Path, option: str, suffixes: Sequence[str] = ()) -> Path:
    """Make the file's folder now.

    Raises:
        BadInput: the file cannot be written, or has none of the suffixes where some are given; names the option.
    """
    from pysim.types import BadInput

    if suffixes and path.suffix.lower() not in suffixes:
        raise BadInput(f"{option} {path}: the suffix chooses the form; write one of {', '.join(suffixes)}")
    if path.is_dir():
        raise BadInput(f"{option} {path}: this is a folder; name a file in it")
    if path.is_file() or not path.exists():  # else a device, such as /dev/null
        _probe(path.parent, f"{option} {path}", "choose another file")
    return path


def _probe(folder: Path, what: str, cure: str) -> None:
    from pysim.types import BadInput

    probe = folder / f".pysim-probe-{os.getpid()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise BadInput(f"{what}: cannot write there ({error.strerror or error}); {cure}") from error


def command_line(words: Sequence[str], folder: Path = Path()) -> str:
    """The line that runs `pysim` with these words again in a folder, quoted for a shell.

    Where this process runs in the environment that run.py made, `pysim` is on nobody's path and run.py is the way in.
    """
    windows = sys.platform == "win32"
    quoted = subprocess.list2cmdline if windows else shlex.join
    root = Path(__file__).resolve().parents[2]
    if Path(sys.prefix).resolve() != root / ".venv" or not (root / "run.py").is_file():
        return quoted(["pysim", *words])
    start = "run.py" if folder.resolve() == root else str(root / "run.py")
    return quoted(["py" if windows else "python3", start, "pysim", *words])
