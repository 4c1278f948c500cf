"""Structures of the kernel filled from Python: numbers, and addresses of arrays that are kept alive beside them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pysim.simulate.kernel.layout import structures
from pysim.simulate.kernel.library import address


class Structure:
    """One structure of the kernel, `record` (1,), and what it points to."""

    def __init__(self, name: str, values: Mapping[str, Any]) -> None:
        self.record = np.zeros(1, dtype=structures()[name])
        self.arrays: dict[str, np.ndarray] = {}
        self.change(values)

    def change(self, values: Mapping[str, Any]) -> None:
        """Fill the fields that `values` names; an array or a structure is kept alive and its address stored."""
        for name, value in values.items():
            self.record[name] = self.place(name, value)

    def place(self, name: str, value: Any) -> Any:
        """What goes into a field: a number as it is, the address of anything else."""
        if isinstance(value, Structure):
            value = value.record
        if not isinstance(value, np.ndarray):
            return value
        self.arrays[name] = value
        return address(value)

    @property
    def address(self) -> int:
        """Where the structure lies."""
        return address(self.record)
