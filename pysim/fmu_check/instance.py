"""One instance of the FMU, the same to handle for FMI 2 and 3, model exchange and co-simulation."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Model, FMU3Slave
from numpy.typing import NDArray

from pysim.fmu_check.subject import MODEL_EXCHANGE, Subject

Array = NDArray[np.float64]
CallFailed = FMICallException
TOLERANCE = 1e-6
_CLASSES = {(2, "me"): FMU2Model, (2, "cs"): FMU2Slave, (3, "me"): FMU3Model, (3, "cs"): FMU3Slave}
_TERMINATED = 3  # fmi2Terminated of fmi2StatusKind
_ROUNDS = 1000  # of event iteration


class Instance:
    """A call that returns neither OK nor Warning raises CallFailed. `raw` is FMPy's object; `messages` what was logged.

    Made by `opened`.
    """

    def __init__(self, subject: Subject, kind: str, name: str = "checked") -> None:
        self.subject, self.kind = subject, kind
        self.messages: list[str] = []
        interface = subject.description.modelExchange if kind == MODEL_EXCHANGE else subject.description.coSimulation
        self.raw: Any = _CLASSES[subject.fmi, kind](
            guid=subject.description.guid,
            unzipDirectory=str(subject.folder),
            modelIdentifier=interface.modelIdentifier,
            instanceName=name,
        )
        self._n = len(subject.states)

    def instantiate(self) -> None:
        """The FMI call; raises where the FMU gives no instance."""
        if self.subject.fmi == 3:
            self.raw.instantiate(logMessage=lambda *words: self.messages.append(_text(words[-1])))
            return
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(lambda *words: self.messages.append(_text(words[-1])))
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self.raw.instantiate(callbacks=self._callbacks)

    def begin(self, references: Sequence[int] = (), values: Sequence[float] | Array = ()) -> None:
        """Set start values, then enter initialization mode."""
        self.set(references, values)
        times = {"tolerance": TOLERANCE, "startTime": self.subject.start}
        if self.subject.fmi == 2:
            self.raw.setupExperiment(**times)
            self.raw.enterInitializationMode()
        else:
            self.raw.enterInitializationMode(**times)

    def finish(self) -> None:
        """From initialization mode to continuous time or to stepping."""
        self.raw.exitInitializationMode()
        if self.kind == MODEL_EXCHANGE:
            self.iterate_events()
            self.raw.enterContinuousTimeMode()

    def start(self, references: Sequence[int] = (), values: Sequence[float] | Array = ()) -> Instance:
        """Both; returns itself."""
        self.begin(references, values)
        self.finish()
        return self

    def step(self, time: float, size: float) -> bool:
        """One communication step; False where the FMU ends the simulation, with or instead of it."""
        if self.subject.fmi == 3:
            _, ends, _, _ = self.raw.doStep(time, size)
            return not ends
        try:
            self.raw.doStep(time, size)
        except CallFailed:
            if not self._is_ended():
                raise
            return False
        return True

    def _is_ended(self) -> bool:
        """FMI 2: whether the step was discarded because the simulation is over."""
        try:
            return bool(self.raw.getBooleanStatus(_TERMINATED))
        except CallFailed:
            return False

    def iterate_events(self) -> None:
        """Update discrete states until none needs another round."""
        for _ in range(_ROUNDS):
            info = self.raw.newDiscreteStates() if self.subject.fmi == 2 else self.raw.updateDiscreteStates()
            if not info[0] or info[1]:
                return

    def get(self, references: Sequence[int]) -> Array:
        """Values (n,) of reals."""
        call = self.raw.getReal if self.subject.fmi == 2 else self.raw.getFloat64
        return np.array(call(list(references)) if len(references) else [], dtype=np.float64)

    def set(self, references: Sequence[int], values: Sequence[float] | Array) -> None:
        """Set reals."""
        if len(references):
            call = self.raw.setReal if self.subject.fmi == 2 else self.raw.setFloat64
            call(list(references), [float(value) for value in values])

    @property
    def x(self) -> Array:
        """States (n_x,)."""
        return self._vector("getContinuousStates", self._n)

    @property
    def dx(self) -> Array:
        """Derivatives (n_x,)."""
        return self._vector("getDerivatives" if self.subject.fmi == 2 else "getContinuousStateDerivatives", self._n)

    def set_states(self, x: Array) -> None:
        """Set the states (n_x,)."""
        if self._n:
            self.raw.setContinuousStates((ctypes.c_double * self._n)(*x), self._n)

    def indicators(self) -> Array:
        """Event indicators (n,)."""
        if self.subject.fmi == 2:
            return self._vector("getEventIndicators", self.subject.description.numberOfEventIndicators)
        return self._vector("getEventIndicators", len(self.subject.description.eventIndicators))

    def _vector(self, name: str, size: int) -> Array:
        buffer = (ctypes.c_double * size)()
        if size:
            getattr(self.raw, name)(buffer, size)
        return np.array(buffer, dtype=np.float64)

    def directional(self, unknowns: Sequence[int], knowns: Sequence[int], seed: Sequence[float]) -> Array:
        """Directional derivative (n_unknowns,)."""
        return np.array(self.raw.getDirectionalDerivative(list(unknowns), list(knowns), list(seed)))

    def save(self) -> Any:
        """The FMU's own copy of its state."""
        return self.raw.getFMUState()

    def restore(self, state: Any) -> None:
        """Go back to it."""
        self.raw.setFMUState(state)


@contextmanager
def opened(subject: Subject, kind: str, name: str = "checked") -> Iterator[Instance]:
    """An instance that is freed in the end."""
    instance = Instance(subject, kind, name)
    instance.instantiate()
    try:
        yield instance
    finally:
        instance.raw.freeInstance()
        subject.alive()


def _text(message: object) -> str:
    return message.decode("utf-8", "replace") if isinstance(message, bytes) else str(message)
