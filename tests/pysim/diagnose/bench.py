"""A bench with one command and one sensor, for tests that need measurements of a plant of a few lines."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended, extended, subject
from pysim.identify.greybox import Rest
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, MeasuredRecord, MeasuredSignal, Model, Record, Signal

Array = NDArray[np.float64]

HOLD = 1.0  # s that a plant stands still before its log, and a model is given
REST = Rest(ramp=0.5, hold=HOLD)


@dataclass(frozen=True)
class Bench:
    """What is commanded and what is read, each a variable of the model and its unit.

    Args:
        noise: of the sensor, in its unit; what it is said to be, and what it is where a log asks for it.
    """

    command: tuple[str, str]
    sensor: tuple[str, str]
    noise: float

    def log(
        self,
        times: Array,
        command: Signal,
        read: Array,
        rng: np.random.Generator | None = None,
        *,
        source: str = "a.txt",
        use: str = "fit",
        noise: float | None = None,
    ) -> MeasuredRecord:
        """What was read (n_t,) beside its command, with the sensor's noise where there is a generator for it."""
        if rng is not None:
            read = read + (self.noise if noise is None else noise) * rng.standard_normal(times.size)
        names, units = zip(self.command, self.sensor, strict=True)
        record = Record(times, np.column_stack([command.value(times), read]), names, units)
        return MeasuredRecord(source, "stochastic", use, record)

    def measured(
        self,
        model: Model,
        times: Array,
        command: Signal,
        truth: Mapping[str, float] | None = None,
        rng: np.random.Generator | None = None,
        *,
        fine: float = 1e-8,
        **free: Any,
    ) -> tuple[Ruler, Extended]:
        """One log of a model at its true parameters, and what counts the residuals of the model against it.

        Args:
            fine: tolerance of the plant's run.
            free: as `subject` takes it.
        """
        run = Experiment(times, (self.sensor[0],), {self.command[0]: command}, truth or {}, start=-HOLD)
        read = simulate(model, run, solver=Rodas(rtol=fine, atol=fine))[self.sensor[0]]
        given = subject(model, self.dataset(self.log(times, command, read, rng)), (), None, rest=REST, **free)
        return Ruler(given.targets), extended(given, ())

    def dataset(self, *logs: MeasuredRecord) -> Dataset:
        """Of these logs."""
        (push, unit), (x, own) = self.command, self.sensor
        signals = (
            MeasuredSignal(push, "input", unit, push, push),
            MeasuredSignal(x, "output", own, x, x, noise=self.noise),
        )
        return Dataset("toy", "one command, one sensor", "toy", signals, logs)
