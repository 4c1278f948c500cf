"""Model exchange: the FMU gives derivatives, our own solver steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager

from pysim.cosim.member import MemberFailed, Setup
from pysim.simulate import SavedStep, Solver, StepFailed, Wires, is_smooth, open_stepwise
from pysim.types import Model


class Exchange:
    """The calls of `Member`, for an FMU whose solver we are."""

    def __init__(self, model: Model, solver: Solver, ports: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
        self.event = False
        self._model, self._solver, self._ports, self._opened = model, solver, ports, ExitStack()

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None:
        """See Member."""
        inputs, outputs = self._ports
        wires = Wires(inputs, outputs, setup.inputs, setup.rates, setup.outputs)
        self._stepper = self._opened.enter_context(open_stepwise(self._model, wires, solver=self._solver))
        self._go_on, self._inputs, self._seen = self._stepper.step, setup.inputs, b""
        self._is_rough = not all(is_smooth(self._model, name) for name in inputs)
        with _failures():
            self._stepper.start(setup.time, setup.stop, overrides)

    def begin(self) -> None:
        """See Member."""
        with _failures():
            self._seen = b""
            self._stepper.update()  # initial equations may depend on the inputs, which have their values by now
            self._stepper.begin()
        self._note()

    def update(self) -> None:
        """See Member."""
        # Inputs that are no continuous numbers may be set at events only; where nothing changed there is nothing to do.
        if self._is_rough and not self.event and self._seen == self._inputs.tobytes():
            return
        with _failures():
            self._stepper.update()
        self._note()

    def _note(self) -> None:
        """What the outputs belong to now, and whether an event is due."""
        self.event = self._stepper.event
        if self._is_rough:
            self._seen = self._inputs.tobytes()

    def step(self, time: float, end: float) -> float:
        """See Member."""
        try:
            self._go_on(end)
        except StepFailed as error:
            raise MemberFailed(str(error), error.outcome) from error
        self._note()
        return end

    def save(self, into: SavedStep | None = None) -> SavedStep:
        """See Member."""
        with _failures():
            return self._stepper.save(into)

    def restore(self, state: SavedStep) -> None:
        """See Member."""
        with _failures():
            self._stepper.restore(state)
        self._seen, self.event = state.held, state.event

    def close(self) -> None:
        """See Member."""
        self._opened.close()


@contextmanager
def _failures() -> Iterator[None]:
    try:
        yield
    except StepFailed as error:
        raise MemberFailed(str(error), error.outcome) from error
