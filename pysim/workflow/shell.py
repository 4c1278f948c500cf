"""The line that starts a program of ours, as the user's shell takes it."""

from __future__ import annotations

import shlex
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path


def quoted(words: Sequence[str]) -> str:
    """Words as this system's shell takes them."""
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


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
