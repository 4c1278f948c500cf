"""Model exchange: the FMU gives derivatives, our own solver steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager

from pysim.cosim.member import MemberFailed, Setup
from pysim.simulate import SavedStep, Solver, StepFailed, Wires, open_stepwise
from pysim.types import Model


class Exchange:
    """The calls of `Member`, for an FMU whose solver we are."""

    event = False

    def __init__(self, model: Model, solver: Solver, ports: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
        self._model, self._solver, self._ports, self._opened = model, solver, ports, ExitStack()

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None:
        """See Member."""
        inputs, outputs = self._ports
        wires = Wires(inputs, outputs, setup.inputs, setup.rates, setup.outputs)
        self._stepper = self._opened.enter_context(open_stepwise(self._model, wires, solver=self._solver))
        self._go_on = self._stepper.step
        with _failures():
            self._stepper.start(setup.time, setup.stop, overrides)

    def begin(self) -> None:
        """See Member."""
        with _failures():
            self._stepper.update()  # initial equations may depend on the inputs, which have their values by now
            self._stepper.begin()

    def update(self) -> None:
        """See Member."""
        with _failures():
            self._stepper.update()

    def step(self, time: float, end: float) -> float:
        """See Member."""
        try:
            self._go_on(end)
        except StepFailed as error:
            raise MemberFailed(str(error), error.outcome) from error
        return end

    def save(self, into: SavedStep | None = None) -> SavedStep:
        """See Member."""
        with _failures():
            return self._stepper.save(into)

    def restore(self, state: SavedStep) -> None:
        """See Member."""
        with _failures():
            self._stepper.restore(state)

    def close(self) -> None:
        """See Member."""
        self._opened.close()


@contextmanager
def _failures() -> Iterator[None]:
    try:
        yield
    except StepFailed as error:
        raise MemberFailed(str(error), error.outcome) from error
