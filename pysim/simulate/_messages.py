"""What an FMU says through its logger."""

from __future__ import annotations

import ctypes
from collections import deque
from typing import Any

import fmpy
import numpy as np
from fmpy import fmi2

from pysim.simulate._structure import Structure
from pysim.simulate.kernel.layout import LINE_LENGTH, LINES
from pysim.simulate.kernel.library import kernel


class Mailbox:
    """Keeps the last messages of one instance; `callbacks` goes to FMPy's `instantiate`."""

    def __init__(self, version: int) -> None:
        self._messages: deque[str] = deque(maxlen=LINES)
        self._lines = np.zeros((LINES, LINE_LENGTH), dtype=np.uint8)
        self.log = Structure("Log", {"lines": self._lines})
        self.callbacks: dict[str, Any] = self._callbacks_2() if version == 2 else {"logMessage": self._deliver_3}

    def put(self, status: int, message: bytes | None) -> None:
        """Keep a message, unless it says that all is well."""
        if status > fmi2.fmi2OK and message:
            self._messages.append(message.decode("utf-8", "replace").strip())

    def empty(self) -> None:
        """Forget the messages of the run before."""
        self._messages.clear()
        self.log.change({"count": 0})

    def text(self) -> str:
        """The messages, as the end of a sentence."""
        count = int(self.log.record["count"][0])
        lines = np.roll(self._lines, -(count % LINES), axis=0) if count > LINES else self._lines[:count]
        return joined([*line_texts(lines), *self._messages])

    def _deliver_3(self, _environment: int | None, status: int, _category: bytes, message: bytes) -> None:
        self.put(status, message)

    def _callbacks_2(self) -> dict[str, Any]:
        table = fmi2.fmi2CallbackFunctions()
        table.logger = ctypes.cast(kernel().log_2, fmi2.fmi2CallbackLoggerTYPE)
        # The C functions themselves: FMPy's own table would come back into Python for every allocation.
        table.allocateMemory = ctypes.cast(fmpy.calloc, fmi2.fmi2CallbackAllocateMemoryTYPE)
        table.freeMemory = ctypes.cast(fmpy.free, fmi2.fmi2CallbackFreeMemoryTYPE)
        table.componentEnvironment = self.log.address
        return {"callbacks": table}


def line_texts(lines: np.ndarray) -> list[str]:
    """Lines of the kernel's log (n, LINE_LENGTH), each up to its zero, as texts; empty ones are left out."""
    texts = (bytes(line).partition(b"\0")[0].decode("utf-8", "replace").strip() for line in lines)
    return [text for text in texts if text]


def joined(messages: list[str]) -> str:
    """Messages as the end of a sentence, none of them twice."""
    return "".join(f"; {message}" for message in dict.fromkeys(messages))
