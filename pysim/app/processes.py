"""The worker seen from outside: whether it still runs, and the end of it with all that it has started."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import psutil

_TASKKILL_LIMIT = 10.0  # s; it answers at once
_NAP = 0.02  # s
_SAME = 2.0  # s: the system's clock may be set between two looks; a number is not given out again that soon


@dataclass(frozen=True)
class Started:
    """A worker, distinguished from a later one that has got its number.

    Args:
        pid: its number.
        began: s since 1970; 0 where it had ended before anybody could ask.
    """

    pid: int
    began: float

    @classmethod
    def of(cls, pid: int) -> Started:
        """The process that has this number now."""
        return cls(pid, _began(pid))

    @property
    def lives(self) -> bool:
        """Whether it still runs."""
        return self.began > 0 and abs(_began(self.pid) - self.began) < _SAME

    def end(self, patience: float) -> bool:
        """End it with all that it has started, though somebody else has started it; whether it has ended.

        Args:
            patience: s between asking and ending, and once more until it must be gone.
        """
        if not self.lives:
            return True
        end_all(self.pid, hard=False)
        gone = self._gone(patience)
        if not gone or sys.platform != "win32":
            end_all(self.pid, hard=True)  # also whatever it has left behind
        return gone or self._gone(patience)

    def _gone(self, patience: float) -> bool:
        begun = time.monotonic()
        while self.lives:
            if time.monotonic() - begun > patience:
                return False
            time.sleep(_NAP)
        return True


def _began(pid: int) -> float:
    """When the process that has this number now began; 0 where none runs, or one that waits for its parent to ask."""
    try:
        process = psutil.Process(pid)
        return 0.0 if process.status() == psutil.STATUS_ZOMBIE else float(process.create_time())
    except psutil.Error:
        return 0.0


def end_all(pid: int, *, hard: bool) -> None:
    """End the processes of a group, or ask them to; on Windows, which knows no asking, a process and its children."""
    if sys.platform != "win32":
        with contextlib.suppress(OSError):
            os.killpg(pid, signal.SIGKILL if hard else signal.SIGTERM)
    else:
        words = ["taskkill", "/T", "/F", "/PID", str(pid)]
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(words, capture_output=True, timeout=_TASKKILL_LIMIT, check=False)


def last_words(path: Path) -> str:
    """What a process said before it broke down, for a user."""
    with contextlib.suppress(OSError):
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        if lines:
            return f"the process broke down: {lines[-1]}"
    return "the process ended without a word; look at output.txt in the folder of the result"
