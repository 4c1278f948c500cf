"""Mappings and arrays that stay as they were given."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, Mapping, ValuesView
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")
V = TypeVar("V")


def frozen_array(numbers: Any) -> NDArray[np.float64]:
    """Numbers as an array that cannot be written to: one that is so already as it is, of anything else a copy."""
    is_whole = isinstance(numbers, np.ndarray) and numbers.dtype == np.float64 and numbers.base is None
    if is_whole and numbers.flags.c_contiguous and not numbers.flags.writeable:
        return numbers
    array = np.array(numbers, dtype=np.float64, order="C")
    array.setflags(write=False)
    return array


def changed(frozen: T, **fields: object) -> T:
    """A frozen object with other fields, which nobody checks: a fifth of the time of copy.copy."""
    other = object.__new__(type(frozen))
    other.__dict__.update(frozen.__dict__, **fields)
    return other


class FrozenMapping(Mapping[str, V]):
    """A read-only copy. Unlike the standard library's MappingProxyType it can be pickled, so types that hold one
    can go to another process. Views are those of the dictionary inside: the abstract ones take ten times the time."""

    __slots__ = ("_content",)

    def __init__(self, content: Mapping[str, V], more: Mapping[str, V] | None = None) -> None:
        self._content = {**content, **(more or {})}

    def __getitem__(self, name: str) -> V:
        return self._content[name]

    def keys(self) -> KeysView[str]:
        return self._content.keys()

    def values(self) -> ValuesView[V]:
        return self._content.values()

    def items(self) -> ItemsView[str, V]:
        return self._content.items()

    def __contains__(self, name: object) -> bool:
        return name in self._content

    def __iter__(self) -> Iterator[str]:
        return iter(self._content)

    def __len__(self) -> int:
        return len(self._content)

    def __repr__(self) -> str:
        return repr(self._content)
