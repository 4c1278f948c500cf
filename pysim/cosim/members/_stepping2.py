"""FMI 2.0 co-simulation: one instance over one run."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from functools import partial
from typing import Any

from pysim.cosim.member import MemberFailed, Setup
from pysim.cosim.members._library import READ_AT_ONCE, SteppingInstance
from pysim.simulate import FmuState, FmuStates
from pysim.types import CoSimulation, Model, Outcome

_WARNING, _DISCARD = 1, 2
_TERMINATED, _LAST_TIME = 3, 2  # of fmi2StatusKind

_P, _D, _I = ctypes.c_void_p, ctypes.c_double, ctypes.c_int
_DO_STEP = ctypes.CFUNCTYPE(_I, _P, _D, _D, _I)
_STATUS = ctypes.CFUNCTYPE(_I, _P, _I, _P)


class Stepping2:
    """The calls of `Member`, for an FMU that steps by itself."""

    event = False

    def __init__(
        self, name: str, model: Model, stepping: CoSimulation, ports: tuple[tuple[str, ...], tuple[str, ...]]
    ) -> None:
        self._instance = SteppingInstance(name, model, stepping)
        self._model, self._stepping, self._ports = model, stepping, ports
        self._states: FmuStates | None = None

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None:
        """See Member."""
        instance = self._instance
        self._component = component = instance.instantiate()
        instance.set_values(overrides)
        with instance.refusal():
            instance.fmu.setupExperiment(startTime=setup.time, stopTime=setup.stop)
            instance.fmu.enterInitializationMode()
        self._write = instance.exchange("Set", self._ports[0], setup.inputs)
        self._read = instance.exchange("Get", self._ports[1], setup.outputs)
        self._do_step = partial(_DO_STEP(instance.address("fmi2DoStep")), component)
        self._keeps = int(not self._stepping.state_handling)  # 1: it is never asked to go back
        if self._stepping.state_handling:
            self._states = FmuStates(2, component, instance.address)
        self.update()

    def begin(self) -> None:
        """See Member."""
        self._instance.check(self._write(), "an input could not be set")
        with self._instance.refusal():
            self._instance.fmu.exitInitializationMode()
        self._instance.is_running = True
        self._instance.check(self._read(), "an output could not be read")

    def update(self) -> None:
        """See Member."""
        self._instance.check(self._write(), "an input could not be set")
        self._instance.check(self._read(), READ_AT_ONCE)

    def step(self, time: float, end: float) -> float:
        """See Member."""
        status = self._write()
        if status <= _WARNING:
            status = self._do_step(time, end - time, self._keeps)
            if status <= _WARNING:
                status = self._read()
                if status <= _WARNING:
                    return end
                self._instance.check(status, "an output could not be read")
            self._explain(status)
        self._instance.check(status, "an input could not be set")
        return end

    def _explain(self, status: int) -> None:
        """A step that was not done."""
        instance = self._instance
        if status == _DISCARD:
            ended, reached = ctypes.c_int(0), ctypes.c_double(float("nan"))
            self._ask("fmi2GetBooleanStatus", _TERMINATED, ended)
            if ended.value:
                raise MemberFailed(f"it ended the run{instance.mailbox.text()}", Outcome.TERMINATED)
            self._ask("fmi2GetRealStatus", _LAST_TIME, reached)
            said = f"it discarded the step, and came to {reached.value:.9g} s{instance.mailbox.text()}"
            raise MemberFailed(f"{said}; smaller steps may do")
        if status > 4:
            raise MemberFailed("its step runs on in the background, which only asynchronous masters can wait for")
        instance.check(status, "its step failed")

    def _ask(self, function: str, kind: int, answer: Any) -> None:
        _STATUS(self._instance.address(function))(self._component, kind, ctypes.addressof(answer))

    def save(self, into: FmuState | None = None) -> FmuState:
        """See Member."""
        assert self._states is not None
        status, state = self._states.save(into)
        self._instance.check(status, "its state could not be saved")
        return state

    def restore(self, state: FmuState) -> None:
        """See Member."""
        assert self._states is not None
        self._instance.check(self._states.restore(state), "its state could not be restored")

    def close(self) -> None:
        """See Member."""
        if self._states is not None and self._instance.status < 4:
            self._states.free()
        self._states = None
        self._instance.close()
