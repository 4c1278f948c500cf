"""The command line in a process of its own, and the end of it with all that it has started."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pysim.app.began import began

_TASKKILL_LIMIT = 10.0  # s; it answers at once
_NAP = 0.02  # s
_ENCODING = "utf-8:backslashreplace"  # of what a command says, as `last_words` reads it; Windows would take a code page


def run_pysim(words: Sequence[str], folder: Path, output: Any) -> subprocess.Popen[bytes]:
    """`pysim` with these words in a process of its own, in that folder; nothing of the folder is imported."""
    root = str(Path(__file__).resolve().parents[2])
    path = os.pathsep.join([root, *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = {**os.environ, "PYTHONPATH": path, "PYTHONUNBUFFERED": "1", "PYTHONIOENCODING": _ENCODING}
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
        _end_all(process.pid, hard=hard)
    elif process.poll() is None:  # children are found by a parent that still runs
        _end_all(process.pid, hard=hard)
        with contextlib.suppress(OSError):
            process.kill()


@dataclass(frozen=True)
class Started:
    """A process of `run_pysim`, distinguished from a later one that has got its number.

    Args:
        pid: its number.
        began: word of its beginning; "" where it had ended before anybody could ask.
    """

    pid: int
    began: str

    @classmethod
    def of(cls, pid: int) -> Started:
        """The process that has this number now."""
        return cls(pid, began(pid))

    @property
    def lives(self) -> bool:
        """Whether it still runs."""
        return bool(self.began) and began(self.pid) == self.began

    def end(self, patience: float) -> bool:
        """End it with all that it has started, though somebody else has started it; whether it has ended.

        Args:
            patience: s between asking and ending, and once more until it must be gone.
        """
        if not self.lives:
            return True
        _end_all(self.pid, hard=False)
        gone = self._gone(patience)
        if not gone or sys.platform != "win32":
            _end_all(self.pid, hard=True)  # also whatever it has left behind
        return gone or self._gone(patience)

    def _gone(self, patience: float) -> bool:
        begun = time.monotonic()
        while self.lives:
            if time.monotonic() - begun > patience:
                return False
            time.sleep(_NAP)
        return True


def _end_all(pid: int, *, hard: bool) -> None:
    if sys.platform != "win32":
        with contextlib.suppress(OSError):
            os.killpg(pid, signal.SIGKILL if hard else signal.SIGTERM)
    else:
        words = ["taskkill", "/T", "/F", "/PID", str(pid)]
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(words, capture_output=True, timeout=_TASKKILL_LIMIT, check=False)


def last_words(path: Path) -> str:
    """What a command said in the end, for a user."""
    with contextlib.suppress(OSError):
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        said = [line for line in lines if line.startswith("pysim")]
        if said or lines:
            return (said or lines)[-1].partition(": ")[2] or (said or lines)[-1]
    return "the process ended without a word; look at output.txt in the folder of the result"
