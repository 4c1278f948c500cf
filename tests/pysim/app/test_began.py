"""When a process began, on every system: the same for as long as it runs, and nothing once it has ended."""

import ctypes
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from pysim.app import began as module
from pysim.app.began import began

WAYS = [
    began,
    pytest.param(module._by_ps, marks=pytest.mark.skipif(shutil.which("ps") is None, reason="there is no ps here")),
]


@pytest.mark.parametrize("way", WAYS)
def test_it_stays_the_same_and_is_gone_with_the_process(way: Callable[[int], str]) -> None:
    own = way(os.getpid())
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        first = way(process.pid)
        assert first
        assert (way(process.pid), way(os.getpid())) == (first, own)
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        assert way(process.pid) == ""  # it has ended, though nobody has asked how
    assert way(process.pid) == ""


def test_two_processes_have_two_beginnings() -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        assert began(process.pid) != began(os.getpid())
        process.kill()


@pytest.mark.parametrize(
    ("number", "waited", "told"),
    [
        (7, 0x102, str((5 << 32) + 6)),
        (7, 0, ""),  # it has ended, and somebody still asks about it
        (8, 0x102, ""),  # there is none
    ],
)
def test_windows_is_asked_for_the_time_of_creation(
    number: int, waited: int, told: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    closed: list[int] = []

    def times(handle: int, *places: Any) -> int:
        places[0]._obj.dwHighDateTime, places[0]._obj.dwLowDateTime = 5, 6
        return 1

    kernel = SimpleNamespace(
        OpenProcess=lambda access, inherit, pid: 70 if (access, inherit, pid) == (0x101000, False, 7) else None,
        WaitForSingleObject=lambda handle, patience: waited if (handle, patience) == (70, 0) else -1,
        GetProcessTimes=times,
        CloseHandle=lambda handle: closed.append(handle),
    )
    monkeypatch.setattr(module.sys, "platform", "win32")
    monkeypatch.setattr(ctypes, "WinDLL", {"kernel32": kernel}.__getitem__, raising=False)
    assert began(number) == told
    assert closed == ([70] if number == 7 else [])
