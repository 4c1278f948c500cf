"""The memory of a run: numbers and addresses for the kernel, and the arrays that the addresses point to."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pysim.simulate._base import Solver
from pysim.simulate._structure import Structure
from pysim.simulate.kernel.layout import JOB, STATISTICS, structures
from pysim.simulate.kernel.library import address
from pysim.simulate.kernel.memory import work_arrays
from pysim.simulate.kernel.method import ExplicitMethod, method_arrays

_FIELDS = {section: JOB[section].names or () for section in JOB.names or ()}

_FRESH = np.zeros((), dtype=structures()["Run"])  # a run that has not begun
_FRESH["segment"], _FRESH["jacobian_at"], _FRESH["inputs_at"] = -1, np.nan, np.nan
_FRESH["leaves"], _FRESH["offset_at"] = np.inf, np.nan


class Job:
    """One run, and then the next. The kernel gets the address of `record`, (1,) of JOB."""

    def __init__(self, solver: Solver) -> None:
        self.solver = solver
        self.record = np.zeros(1, dtype=JOB)
        self.variations: dict[Any, dict[str, Any]] = {}  # by what is recorded, and the directions
        self._arrays: dict[tuple[str, str], Any] = {}

    def restart(self, start: float, end: float) -> None:
        """Forget the run before; times in s. What `put` was given stays."""
        self._arrays["work", "scratch"].fill(0.0)
        self.record["run"] = _FRESH
        self.change("run", {"start": start, "end": end, "t": start})

    def put_model(self, fmu: Structure, jacobian: Mapping[str, Any], states: int, indicators: int) -> None:
        """All that follows from a model and the solver; `jacobian` as from `jacobian_arrays`."""
        method = self.solver.method()
        self.record["fmu"], self._arrays["fmu", "record"] = fmu.address, fmu
        self.put("method", method_arrays(method))
        self.put("control", self.solver.control()._asdict())
        implicit, terms = not isinstance(method, ExplicitMethod), method.dense.shape[1]
        self.put("work", {**work_arrays(states, indicators, method.b.size, terms, implicit), **jacobian})

    def put_shots(self, n: int, parameters: int, rows: int, outputs: int, columns: int, *, orbit: bool) -> None:
        """Memory for the derivatives of `rows` samples of `outputs` variables, and for a search for an orbit."""
        shooting, m = self.record["shooting"], 1 + parameters
        for shot in ("now", "before")[: 1 + orbit]:
            arrays: dict[str, Any] = {"rows": np.zeros((rows, outputs, columns))}
            if orbit:
                arrays |= {"values": np.zeros((rows, outputs)), "solved": np.zeros((n, m))}
                arrays |= {"start": np.zeros(n), "jumps": np.zeros(n)}
            for name, array in arrays.items():
                shooting[shot][name] = self._place(shot, name, array)
        if orbit:
            square = {name: np.zeros((n, n)) for name in ("matrix", "factors", "inverse")}
            rest = {"guess": np.zeros(n), "scale": np.zeros(n), "right": np.zeros((n, m)), "sum": np.zeros(m)}
            self.change("shooting", {**square, **rest, "pivots": np.zeros(n, dtype=np.int64)})

    def change(self, section: str, values: Mapping[str, Any]) -> None:
        """Fill the fields of a section that `values` names; the others stay."""
        fields = self.record[section]
        for name, value in values.items():
            fields[name] = self._place(section, name, value)

    def put(self, section: str, values: Mapping[str, Any]) -> None:
        """Fill a section, zero where `values` is silent; what is no number is kept alive and its address stored."""
        self.record[section] = tuple(self._place(section, name, values.get(name, 0)) for name in _FIELDS[section])

    def _place(self, section: str, name: str, value: Any) -> Any:
        if isinstance(value, Structure):
            self._arrays[section, name] = value
            return value.address
        if isinstance(value, np.ndarray):
            self._arrays[section, name] = value
            return address(value)
        return value

    def array(self, section: str, name: str) -> np.ndarray:
        """An array that was put in."""
        array: np.ndarray = self._arrays[section, name]
        return array

    def number(self, section: str, name: str) -> Any:
        """A number, as it stands now."""
        return self.record[section][name][0]

    def statistics(self) -> dict[str, int]:
        """Counts of the run so far."""
        run = self.record["run"][0]
        return {name: int(run[name]) for name in STATISTICS}
