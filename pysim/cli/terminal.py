"""What the streams of this process can show."""

from __future__ import annotations

import os
import sys
from typing import TextIO

_PROCESSED, _DRAWS = 0x1, 0x4  # ENABLE_PROCESSED_OUTPUT, ENABLE_VIRTUAL_TERMINAL_PROCESSING of Windows


def draws_over(stream: TextIO) -> bool:
    """Whether it is a terminal that moves its cursor where escape sequences say so; on Windows it is asked to."""
    if not stream.isatty():
        return False
    return sys.platform != "win32" or _windows_draws(stream)


def print_everything() -> None:
    """Let standard output replace what its encoding has no letters for: a pipe on Windows knows Latin letters only."""
    if sys.stdout is None:  # closed; nothing else may be opened in its place, as all that is printed would go there
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w", closefd=False)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)  # whatever stands in for it may have none
        if reconfigure is not None and stream.errors == "strict":
            reconfigure(errors="replace")


def _windows_draws(stream: TextIO) -> bool:
    import ctypes
    import msvcrt  # of Windows alone

    handle = ctypes.c_void_p(msvcrt.get_osfhandle(stream.fileno()))  # type: ignore[attr-defined]
    kernel, mode = ctypes.windll.kernel32, ctypes.c_uint32()  # type: ignore[attr-defined]
    return bool(
        kernel.GetConsoleMode(handle, ctypes.byref(mode))
        and kernel.SetConsoleMode(handle, mode.value | _PROCESSED | _DRAWS)
    )
