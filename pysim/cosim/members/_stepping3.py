"""FMI 3.0 co-simulation: one instance over one run, with its events where it leaves them to us."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from pysim.cosim.member import MemberFailed, Setup
from pysim.cosim.members._library import READ_AT_ONCE, SteppingInstance
from pysim.simulate import FmuState, FmuStates, is_smooth, rounding
from pysim.types import CoSimulation, Model, Outcome

_WARNING, _DISCARD = 1, 2
_ROUNDS = 1000  # of one event iteration
_NOTHING = bytes(3)  # no event, no end, no early return

_P, _D, _I, _B = ctypes.c_void_p, ctypes.c_double, ctypes.c_int, ctypes.c_bool
_DO_STEP = ctypes.CFUNCTYPE(_I, _P, _D, _D, _B, _P, _P, _P, _P)
_UPDATE = ctypes.CFUNCTYPE(_I, _P, _P, _P, _P, _P, _P, _P)
_MODE = ctypes.CFUNCTYPE(_I, _P)


class _Answers:
    """What fmi3DoStep and fmi3UpdateDiscreteStates tell, where they write it: a byte for each bool."""

    def __init__(self) -> None:
        self.step, self.update = bytearray(3), bytearray(5)
        self.time = ctypes.c_double(0.0)
        of_step, of_update = (
            ctypes.addressof((ctypes.c_char * len(flags)).from_buffer(flags)) for flags in (self.step, self.update)
        )
        time = ctypes.addressof(self.time)
        self.of_step = (*(of_step + i for i in range(3)), time)
        self.of_update = (*(of_update + i for i in range(5)), time)


@dataclass(frozen=True)
class SavedStepping:
    """What the FMU keeps, and what is kept of it here."""

    fmu: FmuState
    next_event: float
    event: bool
    discrete: bytes


class Stepping3:
    """The calls of `Member`, for an FMU that steps by itself.

    Args:
        events: whether its events are handled here, where it offers that.
    """

    def __init__(
        self,
        name: str,
        model: Model,
        stepping: CoSimulation,
        ports: tuple[tuple[str, ...], tuple[str, ...]],
        events: bool,
    ) -> None:
        self._instance = SteppingInstance(name, model, stepping)
        self._model, self._stepping, self._ports = model, stepping, ports
        self._event_mode = events and stepping.event_mode
        self._early = events and (stepping.event_mode or stepping.early_return)
        self._states: FmuStates | None = None
        self.event, self._next_event = False, math.inf

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None:
        """See Member."""
        instance, model = self._instance, self._model
        options = {"eventModeUsed": self._event_mode, "earlyReturnAllowed": self._early}
        self._component = component = instance.instantiate(**options)
        instance.set_values(overrides)
        with instance.refusal():
            instance.fmu.enterInitializationMode(startTime=setup.time, stopTime=setup.stop)
        self._write = instance.exchange("Set", self._ports[0], setup.inputs)
        self._read = instance.exchange("Get", self._ports[1], setup.outputs)
        self._do_step = partial(_DO_STEP(instance.address("fmi3DoStep")), component)
        self._enter_event_mode, self._enter_step_mode = (
            _MODE(instance.address(f"fmi3Enter{mode}Mode")) for mode in ("Event", "Step")
        )
        self._update_discrete = _UPDATE(instance.address("fmi3UpdateDiscreteStates"))
        self._answers, self._keeps = _Answers(), not self._stepping.state_handling
        discrete = [i for i, name in enumerate(self._ports[0]) if not is_smooth(model, name)]
        self._values, self._discrete = setup.inputs, np.array(discrete, dtype=np.intp)
        if self._stepping.state_handling:
            self._states = FmuStates(3, component, instance.address)
        self.event, self._next_event = False, math.inf
        self._exchange()

    def begin(self) -> None:
        """See Member."""
        self._instance.check(self._write(), "an input could not be set")
        with self._instance.refusal():
            self._instance.fmu.exitInitializationMode()
        self._instance.is_running = True
        self._held = self._discrete_values()
        if self._event_mode:
            self._settle()
        else:
            self._instance.check(self._read(), "an output could not be read")

    def update(self) -> None:
        """See Member. In step mode the standard lets nobody read after he has written; in event mode it does."""
        if self._instance.is_running and self._event_mode:
            self._handle_event()
        else:
            self._exchange()

    def _in_event_mode(self) -> bool:
        """Whether what is due now belongs into event mode: an event, or inputs that may change there only."""
        return self._event_mode and (self.event or (self._discrete.size > 0 and self._discrete_values() != self._held))

    def _discrete_values(self) -> bytes:
        return self._values[self._discrete].tobytes() if self._discrete.size else b""

    def _exchange(self) -> None:
        self._instance.check(self._write(), "an input could not be set")
        self._instance.check(self._read(), READ_AT_ONCE)

    def _handle_event(self) -> None:
        self._instance.check(self._enter_event_mode(self._component), "event mode could not be entered")
        self._instance.check(self._write(), "an input could not be set")
        self._held = self._discrete_values()
        self._settle()

    def _settle(self) -> None:
        """Event iteration, and then step mode."""
        component, flags = self._component, self._answers.update
        for _ in range(_ROUNDS):
            status = self._update_discrete(component, *self._answers.of_update)
            self._instance.check(status, "an event could not be handled")
            if flags[1]:
                raise MemberFailed(f"it ended the run{self._instance.mailbox.text()}", Outcome.TERMINATED)
            if not flags[0]:
                break
        else:
            raise MemberFailed(f"its event iteration does not end after {_ROUNDS} rounds")
        self._next_event = self._answers.time.value if flags[4] else math.inf
        self.event = False
        self._instance.check(self._read(), "an output could not be read")
        self._instance.check(self._enter_step_mode(component), "step mode could not be entered")

    def step(self, time: float, end: float) -> float:
        """See Member."""
        if self._discrete.size and self._in_event_mode():
            self._handle_event()
        if self._next_event <= time:
            self.event = True  # due at once
            return time
        near = rounding(time, end)
        goal = self._next_event if self._next_event < end - near else end
        status = self._write()
        if status > _WARNING:
            self._instance.check(status, "an input could not be set")
        status = self._do_step(time, goal - time, self._keeps, *self._answers.of_step)
        if status > _WARNING:
            self._explain(status)
        reached, needed = goal, False
        if self._answers.step != _NOTHING:
            needed, ended, early = (flag != 0 for flag in self._answers.step)
            if ended:
                raise MemberFailed(f"it ended the run{self._instance.mailbox.text()}", Outcome.TERMINATED)
            reached = self._answers.time.value if early else goal
        if reached > end - near:
            reached = end
        self.event = needed or (self._event_mode and self._next_event <= reached + near)
        status = self._read()
        if status > _WARNING:
            self._instance.check(status, "an output could not be read")
        return reached

    def _explain(self, status: int) -> None:
        """A step that was not done."""
        what = "it discarded the step; smaller steps may do" if status == _DISCARD else "its step failed"
        self._instance.check(status, what)

    def save(self, into: SavedStepping | None = None) -> SavedStepping:
        """See Member."""
        assert self._states is not None
        status, state = self._states.save(into.fmu if into else None)
        self._instance.check(status, "its state could not be saved")
        return SavedStepping(state, self._next_event, self.event, self._held)

    def restore(self, state: SavedStepping) -> None:
        """See Member."""
        assert self._states is not None
        self._instance.check(self._states.restore(state.fmu), "its state could not be restored")
        self._next_event, self.event, self._held = state.next_event, state.event, state.discrete

    def close(self) -> None:
        """See Member."""
        if self._states is not None and self._instance.status < 4:
            self._states.free()
        self._states = None
        self._instance.close()
