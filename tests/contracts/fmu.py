"""One instance of an FMU under test, the same to handle for FMI 2 and 3, model exchange and co-simulation."""

import ctypes
import shutil
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.model_description import ModelDescription, ScalarVariable

_CLASSES = {(2, "me"): FMU2Model, (2, "cs"): FMU2Slave, (3, "me"): FMU3Model, (3, "cs"): FMU3Slave}
_ACCESS = {  # type in the XML -> (FMI 2, FMI 3) part of the function's name
    "Real": "Real",
    "Integer": "Integer",
    "Boolean": "Boolean",
    "Float64": "Float64",
    "Int32": "Int32",
}
_ENUMERATION = {2: "Integer", 3: "Int64"}


@dataclass(frozen=True)
class Fmu:
    """An unpacked FMU."""

    path: Path
    folder: Path
    description: ModelDescription
    fmi: int

    @classmethod
    def unpack(cls, path: Path, folder: Path, fmi: int) -> "Fmu":
        shutil.rmtree(folder, ignore_errors=True)
        extract(str(path), unzipdir=str(folder))
        return cls(path, folder, read_model_description(str(path)), fmi)

    @property
    def variables(self) -> dict[str, ScalarVariable]:
        return {v.name: v for v in self.description.modelVariables}

    @property
    def states(self) -> list[str]:
        return [unknown.variable.derivative.name for unknown in self.description.derivatives]

    @property
    def derivatives(self) -> list[str]:
        return [unknown.variable.name for unknown in self.description.derivatives]

    @property
    def indicator_count(self) -> int:
        return self.description.numberOfEventIndicators if self.fmi == 2 else len(self.description.eventIndicators)

    def of(self, *, causality: str, kinds: Iterable[str] = ("Real", "Float64"), variability: str = "") -> list[str]:
        return [
            v.name
            for v in self.description.modelVariables
            if v.causality == causality and v.type in kinds and variability in ("", v.variability)
        ]

    def open(self, kind: str, **options: Any) -> "Instance":
        return Instance(self, kind, **options)


class Instance:
    """Use as a context manager. Every call that does not return OK or Warning raises (from fmpy)."""

    def __init__(self, fmu: Fmu, kind: str, **options: Any) -> None:
        self.fmu = fmu
        self.kind = kind
        self.messages: list[str] = []
        interface = fmu.description.modelExchange if kind == "me" else fmu.description.coSimulation
        self.raw = _CLASSES[fmu.fmi, kind](
            guid=fmu.description.guid,
            unzipDirectory=str(fmu.folder),
            modelIdentifier=interface.modelIdentifier,
            instanceName="instance",
        )
        self._instantiate(options)

    def _instantiate(self, options: dict[str, Any]) -> None:
        if self.fmu.fmi == 3:
            self.raw.instantiate(loggingOn=True, logMessage=self._log3, **options)
            return
        from fmpy.fmi2 import (
            defaultCallbacks,
            fmi2CallbackFunctions,
            fmi2CallbackLoggerTYPE,
        )

        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._log2)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self.raw.instantiate(loggingOn=True, callbacks=self._callbacks, **options)

    def _log2(self, environment: Any, name: bytes, status: int, category: bytes, message: bytes) -> None:
        self.messages.append(message.decode())

    def _log3(self, environment: Any, status: int, category: bytes, message: bytes) -> None:
        self.messages.append(message.decode())

    def __enter__(self) -> "Instance":
        return self

    def __exit__(self, *failure: object) -> None:
        self.raw.freeInstance()

    def start(self, values: Mapping[str, float] | None = None, *, start: float = 0.0, **setup: float) -> "Instance":
        """Set values, initialise, and go on to continuous time or to stepping. `setup`: stop, tolerance."""
        self.begin(values, start=start, **setup)
        self.raw.exitInitializationMode()
        if self.kind == "me":
            self.iterate_events()
            self.raw.enterContinuousTimeMode()
        return self

    def begin(self, values: Mapping[str, float] | None = None, *, start: float = 0.0, **setup: float) -> "Instance":
        """Set values and enter initialization mode."""
        times = {"tolerance": setup.get("tolerance"), "startTime": start, "stopTime": setup.get("stop")}
        self.set(values or {})
        if self.fmu.fmi == 2:
            self.raw.setupExperiment(**times)
            self.raw.enterInitializationMode()
        else:
            self.raw.enterInitializationMode(**times)
        return self

    def iterate_events(self) -> Any:
        """Update discrete states until none needs another pass; returns the last event information."""
        while True:
            if self.fmu.fmi == 2:
                info = self.raw.newDiscreteStates()
                again, end = info[0], info[1]
            else:
                info = self.raw.updateDiscreteStates()
                again, end = info[0], info[1]
            if not again or end:
                return info

    def set_in_event_mode(self, values: Mapping[str, float]) -> None:
        """From continuous time to continuous time, with an event in between."""
        self.raw.enterEventMode()
        self.set(values)
        self.iterate_events()
        self.raw.enterContinuousTimeMode()

    def get(self, names: Iterable[str]) -> np.ndarray:
        return np.array([self._access("get", self.fmu.variables[name]) for name in names], dtype=float)

    def set(self, values: Mapping[str, float]) -> None:
        for name, value in values.items():
            self._access("set", self.fmu.variables[name], value)

    def _access(self, verb: str, variable: ScalarVariable, *values: float) -> float:
        kind = _ENUMERATION[self.fmu.fmi] if variable.type == "Enumeration" else _ACCESS[variable.type]
        function = getattr(self.raw, verb + kind)
        if verb == "get":
            return function([variable.valueReference])[0]
        whole = kind not in ("Real", "Float64")
        function([variable.valueReference], [int(v) if whole else float(v) for v in values])
        return values[0]

    @property
    def x(self) -> np.ndarray:
        return self._vector("getContinuousStates", len(self.fmu.states))

    @x.setter
    def x(self, values: Iterable[float]) -> None:
        buffer = (ctypes.c_double * len(self.fmu.states))(*values)
        self.raw.setContinuousStates(buffer, len(buffer))

    @property
    def dx(self) -> np.ndarray:
        name = "getDerivatives" if self.fmu.fmi == 2 else "getContinuousStateDerivatives"
        return self._vector(name, len(self.fmu.states))

    @property
    def indicators(self) -> np.ndarray:
        return self._vector("getEventIndicators", self.fmu.indicator_count)

    def _vector(self, name: str, size: int) -> np.ndarray:
        buffer = (ctypes.c_double * size)()
        getattr(self.raw, name)(buffer, size)
        return np.array(buffer)

    def directional(self, unknowns: Iterable[str], knowns: Iterable[str], seed: Iterable[float]) -> np.ndarray:
        return np.array(self.raw.getDirectionalDerivative(self._rows(unknowns), self._rows(knowns), list(seed)))

    def adjoint(self, unknowns: Iterable[str], knowns: Iterable[str], seed: Iterable[float]) -> np.ndarray:
        rows = self._rows(knowns)
        return np.array(self.raw.getAdjointDerivative(self._rows(unknowns), rows, list(seed), len(rows)))

    def _rows(self, names: Iterable[str]) -> list[int]:
        return [self.fmu.variables[name].valueReference for name in names]

    def step(self, time: float, size: float) -> None:
        self.raw.doStep(time, size)

    def save(self) -> bytes:
        """The serialised state."""
        state = self.raw.getFMUState()
        try:
            return self.raw.serializeFMUState(state)
        finally:
            self.raw.freeFMUState(state)

    def restore(self, data: bytes) -> None:
        state = self.raw.deserializeFMUState(data)
        try:
            self.raw.setFMUState(state)
        finally:
            self.raw.freeFMUState(state)
