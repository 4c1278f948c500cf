"""States that an FMU keeps of itself: saved, gone back to, and their memory used again."""

from __future__ import annotations

import ctypes
import weakref
from collections.abc import Callable

_P = ctypes.c_void_p
_CALL = ctypes.CFUNCTYPE(ctypes.c_int, _P, _P)
_NAMES = {
    2: ("fmi2GetFMUstate", "fmi2SetFMUstate", "fmi2FreeFMUstate"),
    3: ("fmi3GetFMUState", "fmi3SetFMUState", "fmi3FreeFMUState"),
}


class FmuState:
    """One saved state. Its memory is the FMU's; nobody has to free it."""

    __slots__ = ("__weakref__", "handle")

    def __init__(self) -> None:
        self.handle = _P()


class FmuStates:
    """The saved states of one instance. Every function returns the FMU's status.

    Args:
        version: of FMI, 2 | 3.
        instance: as the FMU's functions want it.
        address: of a function of the shared library, by its name.
    """

    def __init__(self, version: int, instance: int, address: Callable[[str], int]) -> None:
        self._instance = instance
        self._get, self._set, self._free = (_CALL(address(name)) for name in _NAMES[version])
        self._unused: list[_P] = []  # handles of states that nobody holds any more
        self._handles: list[_P] = []  # all that were ever made

    def save(self, into: FmuState | None = None) -> tuple[int, FmuState]:
        """Keep where the instance stands; `into` is a state that is no longer needed."""
        state = into or self._new()
        return self._get(self._instance, ctypes.addressof(state.handle)), state

    def restore(self, state: FmuState) -> int:
        """Stand where that state was saved; it stays good for another time."""
        return int(self._set(self._instance, state.handle.value))

    def free(self) -> None:
        """Give all memory back, ahead of the instance."""
        for handle in self._handles:
            if handle.value:
                self._free(self._instance, ctypes.addressof(handle))
        self._handles.clear()
        self._unused.clear()

    def _new(self) -> FmuState:
        state = FmuState()
        if self._unused:
            state.handle = self._unused.pop()
        else:
            self._handles.append(state.handle)
        weakref.finalize(state, self._unused.append, state.handle).atexit = False
        return state
