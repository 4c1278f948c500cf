"""When a process began, as its system tells it: numbers of processes are given out again, beginnings are not."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from ctypes import wintypes
from pathlib import Path

_BOOT = Path("/proc/sys/kernel/random/boot_id")
_PS_LIMIT = 10.0  # s; it answers at once
_HANDLE, _NUMBER, _YES, _TIME = wintypes.HANDLE, wintypes.DWORD, wintypes.BOOL, ctypes.POINTER(wintypes.FILETIME)
_CALLS = (  # of kernel32: name, what it gives, what it takes
    ("OpenProcess", _HANDLE, _NUMBER, _YES, _NUMBER),
    ("WaitForSingleObject", _NUMBER, _HANDLE, _NUMBER),
    ("GetProcessTimes", _YES, _HANDLE, _TIME, _TIME, _TIME, _TIME),
    ("CloseHandle", _YES, _HANDLE),
)
_QUERY, _SYNCHRONIZE, _STILL_RUNS = 0x1000, 0x100000, 0x102  # of OpenProcess and WaitForSingleObject


def began(pid: int) -> str:
    """A word that no other process has that ever had this number; "" where none runs now.

    One that has ended and whose parent has not asked yet how does not run.
    """
    if sys.platform == "win32":
        return _on_windows(pid)
    return _on_linux(pid) if _BOOT.is_file() else _by_ps(pid)


def _on_linux(pid: int) -> str:
    """Ticks since the machine was started, and which start of the machine that was."""
    try:
        words = Path(f"/proc/{pid}/stat").read_bytes().rpartition(b")")[2].split()
        boot = _BOOT.read_text(encoding="ascii").strip()
    except OSError:
        return ""
    return "" if words[0] in (b"Z", b"X") else f"{boot} {int(words[19])}"


def _by_ps(pid: int) -> str:
    """Date and time, on all other Unixes."""
    words = ["ps", "-o", "stat=", "-o", "lstart=", "-p", str(pid)]
    try:
        told = subprocess.run(
            words, env={**os.environ, "LC_ALL": "C", "TZ": "UTC"}, capture_output=True, timeout=_PS_LIMIT, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    state, _, date = told.stdout.decode("ascii", "replace").strip().partition(" ")
    return "" if state.startswith("Z") else " ".join(date.split())


def _on_windows(pid: int) -> str:
    """Tenths of microseconds since 1601."""
    kernel = ctypes.WinDLL("kernel32")  # type: ignore[attr-defined]
    for name, result, *taken in _CALLS:
        function = getattr(kernel, name)
        function.restype, function.argtypes = result, taken
    handle = kernel.OpenProcess(_QUERY | _SYNCHRONIZE, False, pid)
    if not handle:
        return ""
    try:
        times = [wintypes.FILETIME() for _ in range(4)]  # when it began, when it ended, how long it has worked
        runs = kernel.WaitForSingleObject(handle, 0) == _STILL_RUNS
        known = runs and kernel.GetProcessTimes(handle, *(ctypes.byref(one) for one in times))
        return str((times[0].dwHighDateTime << 32) + times[0].dwLowDateTime) if known else ""
    finally:
        kernel.CloseHandle(handle)
