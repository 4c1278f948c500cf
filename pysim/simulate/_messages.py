"""What an FMU says through its logger."""

from __future__ import annotations

import ctypes
import itertools
from collections import deque
from typing import Any
from weakref import WeakValueDictionary

import fmpy
from fmpy import fmi2

_KEPT = 20  # messages of one run; a model may log at every step

try:
    from fmpy import logging as _logging
except (ImportError, OSError):  # FMPy brings no such library for this machine: %s and %g stay in the texts
    _logging = None

_mailboxes: WeakValueDictionary[int, Mailbox] = WeakValueDictionary()  # by what an FMU is given as environment
_numbers = itertools.count(1)


def _deliver(environment: int | None, _instance: bytes, status: int, category: bytes, message: bytes) -> None:
    mailbox = _mailboxes.get(environment or 0)
    if mailbox is not None:
        mailbox.put(status, message)


# One for all and for good: the proxy that formats FMI 2 messages keeps a single address for the whole process.
_deliver_2 = fmi2.fmi2CallbackLoggerTYPE(_deliver)


class Mailbox:
    """Keeps the last messages of one instance; `callbacks` goes to FMPy's `instantiate`."""

    def __init__(self, version: int) -> None:
        self._messages: deque[str] = deque(maxlen=_KEPT)
        self.callbacks: dict[str, Any] = self._callbacks_2() if version == 2 else {"logMessage": self._deliver_3}

    def put(self, status: int, message: bytes | None) -> None:
        """Keep a message, unless it says that all is well."""
        if status > fmi2.fmi2OK and message:
            self._messages.append(message.decode("utf-8", "replace").strip())

    def empty(self) -> None:
        """Forget the messages of the run before."""
        self._messages.clear()

    def text(self) -> str:
        """The messages, as the end of a sentence."""
        return "".join(f"; {m}" for m in dict.fromkeys(self._messages))

    def _deliver_3(self, _environment: int | None, status: int, _category: bytes, message: bytes) -> None:
        self.put(status, message)

    def _callbacks_2(self) -> dict[str, Any]:
        number = next(_numbers)
        _mailboxes[number] = self
        table = fmi2.fmi2CallbackFunctions()
        table.logger = _deliver_2
        # The C functions themselves: FMPy's own table would come back into Python for every allocation.
        table.allocateMemory = ctypes.cast(fmpy.calloc, fmi2.fmi2CallbackAllocateMemoryTYPE)
        table.freeMemory = ctypes.cast(fmpy.free, fmi2.fmi2CallbackFreeMemoryTYPE)
        table.componentEnvironment = number
        if _logging is not None:
            _logging.addLoggerProxy(ctypes.byref(table))
        return {"callbacks": table}
