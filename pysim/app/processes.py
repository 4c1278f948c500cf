"""The command line in a process of its own, and the end of it with all that it has started."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

_TASKKILL_LIMIT = 10.0  # s; it answers at once


def run_pysim(words: Sequence[str], folder: Path, output: Any) -> subprocess.Popen[bytes]:
    """`pysim` with these words in a process of its own, in that folder; nothing of the folder is imported."""
    root = str(Path(__file__).resolve().parents[2])
    path = os.pathsep.join([root, *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = {**os.environ, "PYTHONPATH": path, "PYTHONUNBUFFERED": "1"}
    command = [sys.executable, "-P", "-m", "pysim", *words]
    own: dict[str, Any] = {"creationflags": 0x200} if sys.platform == "win32" else {}  # CREATE_NEW_PROCESS_GROUP
    return subprocess.Popen(
        command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
        start_new_session=True, **own,
    )  # fmt: skip


def end(process: subprocess.Popen[bytes], *, hard: bool) -> None:
    """End a process with all that it has started.

    Args:
        process: of `run_pysim`; where it has ended already, what it left is ended, but on Windows nobody can tell that.
        hard: False only asks; Windows knows no asking and ends them at once.
    """
    if sys.platform != "win32":
        with contextlib.suppress(OSError):
            os.killpg(process.pid, signal.SIGKILL if hard else signal.SIGTERM)
    elif process.poll() is None:  # children are found by a parent that still runs
        words = ["taskkill", "/T", "/F", "/PID", str(process.pid)]
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(words, capture_output=True, timeout=_TASKKILL_LIMIT, check=False)
        with contextlib.suppress(OSError):
            process.kill()


def last_words(path: Path) -> str:
    """What a command said in the end, for a user."""
    with contextlib.suppress(OSError):
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        said = [line for line in lines if line.startswith("pysim")]
        if said or lines:
            return (said or lines)[-1].partition(": ")[2] or (said or lines)[-1]
    return "the process ended without a word; look at output.txt in the folder of the result"
