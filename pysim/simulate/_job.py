"""The memory of one run: a record of numbers and addresses for the kernel, and the arrays the addresses point to."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pysim.simulate._base import Solver
from pysim.simulate.kernel.layout import JOB, STATISTICS, structures
from pysim.simulate.kernel.library import address

_FIELDS = {section: JOB[section].names or () for section in JOB.names or ()}

_FRESH = np.zeros((), dtype=structures()["Run"])  # a run that has not begun
_FRESH["segment"], _FRESH["jacobian_at"], _FRESH["inputs_at"] = -1, np.nan, np.nan
_FRESH["leaves"], _FRESH["offset_at"] = np.inf, np.nan


class Job:
    """One run, and then the next. The kernel gets the address of `record`, (1,) of JOB."""

    def __init__(self, solver: Solver) -> None:
        self.solver = solver
        self.record = np.zeros(1, dtype=JOB)
        self._arrays: dict[tuple[str, str], np.ndarray] = {}
        self._given: dict[str, Mapping[str, Any]] = {}
        self.spare: dict[Any, dict[str, Any]] = {}  # sections that runs of the same kind use again

    def restart(self, start: float, end: float) -> None:
        """Forget the run before; times in s. What `put` was given stays."""
        self._arrays["work", "scratch"].fill(0.0)
        self.record["run"] = _FRESH
        self.change("run", {"start": start, "end": end, "t": start})

    def keep(self, section: str, values: Mapping[str, Any]) -> None:
        """As `put`, unless these very values were put there last."""
        if self._given.get(section) is not values:
            self.put(section, values)

    def change(self, section: str, values: Mapping[str, Any]) -> None:
        """Fill the fields of a section that `values` names; the others stay."""
        fields = self.record[section]
        for name, value in values.items():
            if isinstance(value, np.ndarray):
                self._arrays[section, name] = value
                value = address(value)
            fields[name] = value

    def put(self, section: str, values: Mapping[str, Any]) -> None:
        """Fill a section, zero where `values` is silent; an array is kept alive and its address stored."""
        self._given[section] = values
        row = []
        for name in _FIELDS[section]:
            value = values.get(name, 0)
            if isinstance(value, np.ndarray):
                self._arrays[section, name] = value
                value = address(value)
            row.append(value)
        self.record[section] = tuple(row)

    def array(self, section: str, name: str) -> np.ndarray:
        """An array that was put in."""
        return self._arrays[section, name]

    def number(self, section: str, name: str) -> Any:
        """A number, as it stands now."""
        return self.record[section][name][0]

    def statistics(self) -> dict[str, int]:
        """Counts of the run so far."""
        run = self.record["run"][0]
        return {name: int(run[name]) for name in STATISTICS}
