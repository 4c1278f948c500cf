"""libcosim, by its Python package: the same FMUs and wires, or a package that we exported."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave
from numpy.typing import NDArray

from pysim.types import Model

Array = NDArray[np.float64]


class Peer:
    """An execution of libcosim with an observer of all outputs."""

    def __init__(self, execution: Any, places: Mapping[str, int], models: Mapping[str, Model]) -> None:
        self._execution, self._observer = execution, CosimObserver.create_last_value()
        execution.add_observer(self._observer)
        self._read = [
            (places[name], [v.reference for v in model.variables if v.causality == "output"])
            for name, model in models.items()
        ]

    def rows(self, steps: int) -> Array:
        """All outputs after each step (steps, n_y)."""
        found = []
        for _ in range(steps):
            self._step(1)
            found.append([value for place, numbers in self._read for value in self._last(place, numbers)])
        return np.array(found)

    def cpu_seconds(self, steps: int) -> float:
        """Of all threads, for that many steps in one go."""
        begun = time.process_time()
        self._step(steps)
        return time.process_time() - begun

    def _last(self, place: int, numbers: list[int]) -> Sequence[float]:
        values: Sequence[float] = self._observer.last_real_values(place, numbers)
        return values

    def _step(self, count: int) -> None:
        if not self._execution.step(count):
            raise RuntimeError(f"libcosim could not make {count} steps")


def wired(
    models: Mapping[str, Model],
    starts: Mapping[str, Mapping[str, float]],
    wires: Sequence[tuple[str, str]],
    step: float,
) -> Peer:
    """FMUs added and connected one by one; `starts` and `wires` name them as our system does."""
    log_output_level(CosimLogLevel.FATAL)
    execution = CosimExecution.from_step_size(step_size=round(1e9 * step))
    places = {}
    for name, model in models.items():
        places[name] = execution.add_local_slave(CosimLocalSlave(fmu_path=str(model.path), instance_name=name))
        for variable, value in starts.get(name, {}).items():
            execution.real_initial_value(places[name], model[variable].reference, value)
    for wire in wires:
        ends = [(places[name], models[name][port].reference) for name, _, port in (end.partition(".") for end in wire)]
        execution.connect_real_variables(*ends[0], *ends[1])
    return Peer(execution, places, models)


def from_package(path: Path, models: Mapping[str, Model], step: float) -> Peer:
    """An .ssp archive as libcosim reads it."""
    log_output_level(CosimLogLevel.FATAL)
    execution = CosimExecution.from_ssp_file(str(path), step_size=round(1e9 * step))
    return Peer(execution, {name: execution.slave_index_from_instance_name(name) for name in models}, models)
