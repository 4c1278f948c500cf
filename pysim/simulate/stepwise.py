"""A model-exchange FMU stepped from one communication point to the next, by the solver of `simulate`."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Solver
from pysim.simulate._check import check_arguments
from pysim.simulate._found import OUTCOMES, explain
from pysim.simulate._library import CallFailed, Instance, open_library
from pysim.simulate._step_job import SavedJob, StepJob
from pysim.simulate.fmu_states import FmuState, FmuStates
from pysim.simulate.fmu_values import FmuValues, pointer
from pysim.simulate.kernel.layout import DONE, FATAL, RUNNING, WARNING
from pysim.simulate.kernel.library import kernel
from pysim.simulate.rounding import rounding
from pysim.types import Model, Outcome

Array = NDArray[np.float64]

_BUDGET = 20_000  # steps of the solver until an interrupt from the keyboard is noticed

_ENTER = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)
_SET_TIME = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_double)
_SET_STATES = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t)


class StepFailed(RuntimeError):
    """A step, or a call around it, that the model could not do; in the model's own words."""

    def __init__(self, message: str, outcome: Outcome = Outcome.MODEL_ERROR) -> None:
        super().__init__(message)
        self.outcome = outcome


@dataclass(frozen=True)
class Wires:
    """What goes into a model and comes out of it at communication points; the arrays are shared with the caller.

    Args:
        inputs, outputs: names of scalar numbers.
        values: (n_in,) of the inputs, read at each call.
        rates: (n_in,) of the inputs, per s, over the step to come; zero for those that are no continuous reals.
        results: (n_out,) of the outputs, written at each call.
    """

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    values: Array
    rates: Array
    results: Array


@dataclass(frozen=True)
class SavedStep:
    """What `Stepwise.save` kept."""

    job: SavedJob
    held: bytes
    sloped: bool
    event: bool
    fmu: FmuState | None


@contextmanager
def open_stepwise(model: Model, wires: Wires, *, solver: Solver) -> Iterator[Stepwise]:
    """An instance of a model-exchange FMU, for the length of the block.

    Args:
        solver: method and tolerances.
    Raises:
        BadInput: unknown names, variables that are no numbers, no binary for this machine.
    """
    check_arguments("stepwise", model, solver)
    with open_library(model) as library, library.instance() as instance:
        stepper = Stepwise(instance, wires, solver)
        try:
            yield stepper
        finally:
            stepper.release()


class Stepwise:
    """One run of a model-exchange FMU, step by step. Made by `open_stepwise`.

    The calls of a run: `start`, `update` as often as wanted, `begin`, then `step`, `update`, `save` and `restore`; each
    may raise StepFailed. Inputs that change between two steps are an event, after which the solver begins afresh.

    Attributes:
        event: a time event falls on the time reached. It is left to the next `update` or `step`, for which the inputs
            that belong to this time are written.
    """

    def __init__(self, instance: Instance, wires: Wires, solver: Solver) -> None:
        self.model, self._instance, self._solver, self._wires = instance.model, instance, solver, wires
        model, fmi = self.model, self.model.abilities.fmi
        self._in = FmuValues(fmi, [model[name] for name in wires.inputs], wires.values, instance.address)
        self._out = FmuValues(fmi, [model[name] for name in wires.outputs], wires.results, instance.address)
        self._smooth = np.array([i for i, name in enumerate(wires.inputs) if is_smooth(model, name)], dtype=np.intp)
        self._enter_event_mode = _ENTER(instance.address(f"fmi{fmi}EnterEventMode"))
        has_states = model.abilities.state_handling
        self._states = FmuStates(fmi, instance.component, instance.address) if has_states else None
        self._still = bytes(wires.rates.nbytes)
        self._held, self._sloped, self._begun, self.event = b"", False, False, False
        self._stop, self._job = 0.0, self._new_job(0.0)

    @property
    def time(self) -> float:
        """Where the FMU stands, s."""
        return float(self._job.t[0])

    def start(self, time: float, stop: float, overrides: Mapping[str, float]) -> None:
        """Set start values, enter initialisation, read the inputs, write the outputs; times in s."""
        control = self._solver.control()
        try:
            self._instance.enter_initialisation(overrides, time, stop, control.rtol if control.step == 0.0 else None)
        except CallFailed as error:
            raise StepFailed(str(error)) from error
        self._begun, self._stop, self._job, self.event = False, stop, self._new_job(time), False
        self.update()

    def begin(self) -> None:
        """Leave initialisation, handle the first event, write the outputs."""
        try:
            self._instance.exit_initialisation()
        except CallFailed as error:
            raise StepFailed(str(error)) from error
        self._begun, self._held, self._sloped = True, self._wires.values.tobytes(), False
        self._settle()

    def update(self) -> None:
        """Read the inputs and write the outputs with no time passing; handle an event that is due."""
        if self.event or self._is_changed_at_an_event():
            self._change(False)
            self._settle()
            return
        component = self._instance.component
        self._check(self._in.write(component), "an input could not be set")
        self._check(self._out.read(component), "an output could not be read")

    def _is_changed_at_an_event(self) -> bool:
        """Whether there are other values for inputs that are not continuous: these can be set in event mode only."""
        is_rough = self._smooth.size < len(self._wires.inputs)
        return self._begun and is_rough and self._held != self._wires.values.tobytes()

    def step(self, end: float) -> None:
        """Read the inputs, go on to a time (s) after the one reached, write the outputs."""
        sloped = self._wires.rates.tobytes() != self._still
        if self.event or sloped or self._sloped or self._wires.values.tobytes() != self._held:
            self._change(sloped)
        near = rounding(self.time, end)
        self._job.aim(end, end, end - near)
        code = RUNNING
        while code == RUNNING:
            code = kernel().integrate(self._job.record, _BUDGET)
        if code != DONE:
            self._fail(code)
        self.event = self._job.next_event <= end + near

    def _change(self, sloped: bool) -> None:
        """Other inputs from the time reached on, or an event that is due there: both are handled by what follows."""
        self.event = False
        component = self._instance.component
        self._check(self._enter_event_mode(component), "event mode could not be entered")
        self._check(self._in.write(component), "an input could not be set")
        self._held, self._sloped = self._wires.values.tobytes(), sloped
        if sloped:
            self._job.begin_afresh(self._wires.values[self._smooth], self._wires.rates[self._smooth])
        else:
            self._job.begin_afresh(None, None)

    def _settle(self) -> None:
        """Handle the event at the present time and read the outputs; no step yet."""
        self._job.aim(self._stop if self._stop > self.time else self.time + 1.0, self.time)
        code = kernel().integrate(self._job.record, 0)
        if code not in (RUNNING, DONE):
            self._fail(code)

    def _fail(self, code: int) -> None:
        job, outcome = self._job.job, OUTCOMES[code]
        self._instance.status = int(job.number("run", "status"))
        said = explain(outcome, float(job.number("run", "t")), self._instance.status)
        raise StepFailed(said + self._instance.mailbox.text(), outcome)

    def _new_job(self, time: float) -> StepJob:
        names, wires = self._wires.inputs, self._wires
        references = np.array([self.model[names[i]].reference for i in self._smooth], dtype=np.uint32)
        return StepJob(self._instance, self._solver, references, wires.outputs, wires.results, time)

    def save(self, into: SavedStep | None = None) -> SavedStep:
        """All that the next step depends on beside the wires; `into` is one that is no longer needed."""
        fmu = None
        if self._states is not None:
            status, fmu = self._states.save(into.fmu if into else None)
            self._check(status, "its state could not be saved")
        elif self._job.has_time_events:
            raise StepFailed("its state could not be saved: it has events, and offers no saved states")
        return SavedStep(self._job.save(into.job if into else None), self._held, self._sloped, self.event, fmu)

    def restore(self, saved: SavedStep) -> None:
        """Stand where `saved` was made. The outputs are not written."""
        self._job.restore(saved.job)
        self._held, self._sloped, self.event = saved.held, saved.sloped, saved.event
        if self._states is not None and saved.fmu is not None:
            self._check(self._states.restore(saved.fmu), "its state could not be restored")
        else:
            self._check(self._stand(), "its state could not be restored")

    def _stand(self) -> int:
        """Move an FMU that is nothing but its states to the point reached, with the inputs held there; the status."""
        instance, fmi, x = self._instance, self.model.abilities.fmi, self._job.states()
        component, wanted = instance.component, self._wires.values.copy()
        status = _SET_TIME(instance.address(f"fmi{fmi}SetTime"))(component, self.time)
        if x.size:
            set_states = _SET_STATES(instance.address(f"fmi{fmi}SetContinuousStates"))
            status = max(status, set_states(component, pointer(x), x.size))
        self._wires.values[:] = np.frombuffer(self._held)
        status = max(status, self._in.write(component))
        self._wires.values[:] = wanted
        return int(status)

    def release(self) -> None:
        """Give back what the FMU keeps for saved states."""
        if self._states is not None and self._instance.status < FATAL:
            self._states.free()

    def _check(self, status: int, what: str) -> None:
        if status > WARNING:
            self._instance.status = max(self._instance.status, status)
            raise StepFailed(f"{what}{self._instance.mailbox.text()}")


def is_smooth(model: Model, name: str) -> bool:
    """Whether an input may change while time passes."""
    variable = model[name]
    return variable.type in ("Real", "Float64") and variable.variability == "continuous"


def can_be_saved(model: Model) -> bool:
    """Whether a model-exchange FMU saves states, or remembers nothing but its continuous ones, as far as it says."""
    discrete = any(v.variability == "discrete" and v.causality != "input" for v in model.variables)
    return model.abilities.state_handling or (model.abilities.event_indicators == 0 and not discrete)
