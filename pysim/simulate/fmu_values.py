"""Variables of one FMU instance that are set together, or read together, straight from and into an array."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, Variable

Array = NDArray[np.float64]

# Type of variable -> the end of its function's name, and how it lies in memory; FMI 2 and FMI 3.
_TYPES: dict[int, dict[str, tuple[str, Any]]] = {
    2: {
        "Real": ("Real", np.float64),
        "Integer": ("Integer", np.int32),
        "Enumeration": ("Integer", np.int32),
        "Boolean": ("Boolean", np.int32),
    },
    3: {
        "Float64": ("Float64", np.float64),
        "Float32": ("Float32", np.float32),
        "Int8": ("Int8", np.int8),
        "UInt8": ("UInt8", np.uint8),
        "Int16": ("Int16", np.int16),
        "UInt16": ("UInt16", np.uint16),
        "Int32": ("Int32", np.int32),
        "UInt32": ("UInt32", np.uint32),
        "Int64": ("Int64", np.int64),
        "UInt64": ("UInt64", np.uint64),
        "Enumeration": ("Int64", np.int64),
        "Boolean": ("Boolean", np.bool_),
    },
}

_P, _N, _STATUS = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int
_CALL = {2: ctypes.CFUNCTYPE(_STATUS, _P, _P, _N, _P), 3: ctypes.CFUNCTYPE(_STATUS, _P, _P, _N, _P, _N)}


def is_number(version: int, kind: str) -> bool:
    """Whether variables of that type can be set and read as numbers."""
    return kind in _TYPES[version]


def pointer(array: NDArray[Any]) -> int:
    """Address of an array's first item; the array has to outlive it."""
    address: int = array.__array_interface__["data"][0]
    return address


class _Group:
    """Variables of one type: one call, into memory of that type."""

    def __init__(self, version: int, item: Any, members: Sequence[tuple[int, Variable]]) -> None:
        self.places = np.array([place for place, _ in members], dtype=np.intp)
        self.references = np.array([variable.reference for _, variable in members], dtype=np.uint32)
        self.buffer = np.zeros(len(members), dtype=item)
        self.whole = not issubclass(item, np.floating)
        self.arguments = arguments(version, self.references, self.buffer)


def arguments(version: int, references: NDArray[np.uint32], values: NDArray[Any]) -> tuple[int, ...]:
    """What a getter or setter is given after the instance."""
    plain = (pointer(references), references.size, pointer(values))
    return plain if version == 2 else (*plain, references.size)


class FmuValues:
    """Some variables of an instance, bound to an array.

    Args:
        version: of FMI, 2 | 3.
        variables: scalar numbers (n,).
        array: (n,) contiguous; `write` sets the variables to it, `read` fills it.
        address: of a function of the shared library, by its name.
    Raises:
        BadInput: a variable that is no scalar number.
    """

    def __init__(
        self, version: int, variables: Sequence[Variable], array: Array, address: Callable[[str], int]
    ) -> None:
        self._array = array
        kinds: dict[tuple[str, Any], list[tuple[int, Variable]]] = {}
        for place, variable in enumerate(variables):
            if not is_number(version, variable.type):
                raise BadInput(f"{variable.name} is {variable.type}, no single number; leave it out")
            kinds.setdefault(_TYPES[version][variable.type], []).append((place, variable))
        self._groups = [_Group(version, item, members) for (_, item), members in kinds.items()]
        bind = _CALL[version]
        self._setters = [bind(address(f"fmi{version}Set{ending}")) for ending, _ in kinds]
        self._getters = [bind(address(f"fmi{version}Get{ending}")) for ending, _ in kinds]
        self.is_plain = len(kinds) == 1 and self._groups[0].buffer.dtype == np.float64
        if self.is_plain:  # no memory in between: the array itself
            self._arguments = arguments(version, self._groups[0].references, array)
            self._set, self._get = self._setters[0], self._getters[0]

    def write(self, instance: int) -> int:
        """Set all; the worst status."""
        if self.is_plain:
            return int(self._set(instance, *self._arguments))
        status = 0
        for group, setter in zip(self._groups, self._setters, strict=True):
            values = self._array[group.places]
            group.buffer[:] = np.rint(values) if group.whole else values
            status = max(status, setter(instance, *group.arguments))
        return status

    def read(self, instance: int) -> int:
        """Read all; the worst status."""
        if self.is_plain:
            return int(self._get(instance, *self._arguments))
        status = 0
        for group, getter in zip(self._groups, self._getters, strict=True):
            status = max(status, getter(instance, *group.arguments))
            self._array[group.places] = group.buffer
        return status
