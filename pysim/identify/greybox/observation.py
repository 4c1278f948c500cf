"""Observations that a model is compared with: a log, the stepped sines of a test, or a frequency-response table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.nuisance import Nuisance, SensorErrors
from pysim.identify.greybox.reduction import Reduction
from pysim.simulate import Periodic
from pysim.types import Experiment, RecordFit, ResponseFit

Array = NDArray[np.float64]


class Measure(Enum):
    """Unit of the residuals."""

    SIGNAL = "signal"  # the signal's own unit; response tables: divided by their standard deviations
    THESIS = "thesis"  # percent over time (Eq. 2.24), 90/20 dB and degrees over frequency (Eq. 2.25)


@dataclass(frozen=True)
class Run:
    """One run that an observation needs, without the parameters that are fitted.

    Args:
        record: source of the log, which may have parameters of its own.
        experiment: a run over time; with `orbit`, the same test as a transient, recorded at the orbit's points.
        orbit: periodic steady state to find, which is then used instead of `experiment`; None for a run over time.
        initial: (n_x,) prior standard deviation of the initial states around rest: infinite if nothing is known of a
            state, 0 if it is held at rest. Empty if all are held.
        begins_anywhere: whether the initial states are unknown, but for limits that the model declares.
        begins: time in s of the log's first sample; of a steady sine one at its phase, once the model has settled.
        measured: (n_t, n_y) measured rows of a run over time; empty if the comparison is not row by row.
    """

    record: str
    experiment: Experiment
    orbit: Periodic | None = None
    initial: Array = field(default_factory=lambda: np.zeros(0))
    begins_anywhere: bool = False
    begins: float = 0.0
    measured: Array = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def free(self) -> NDArray[np.intp]:
        """Indices of the states whose initial values are free."""
        return np.flatnonzero(self.initial)

    def over_time(self, overrides: Mapping[str, float], offset: Array | None) -> Experiment:
        """The run over time with parameters set; its initial states are at an offset (n_s,) from rest, or at rest."""
        experiment = self.experiment.override(**overrides)
        if offset is None or not self.free.size:
            return experiment
        whole = np.zeros(self.initial.size)
        whole[self.free] = offset
        return experiment.moved(whole, self.begins)


@dataclass(frozen=True)
class Simulated:
    """Result of a run.

    Args:
        values: (n_t, n_y) in the variables' units.
        slopes: (n_t, n_y, n_x) derivatives by the search coordinates.
        by_initial: (n_t, n_y, n_s) derivatives by the free initial states.
        reduction: QR triangles of the residual of a long log; the arrays above are then empty.
    """

    values: Array
    slopes: Array
    by_initial: Array = field(default_factory=lambda: np.zeros((0, 0, 0)))
    reduction: Reduction | None = None


class Observation(Protocol):
    """Measurements in the form in which the model is compared with them. Each kind has its own file."""

    @property
    def dataset(self) -> str:
        """Name of the data set."""
        ...

    @property
    def use(self) -> str:
        """ "fit" | "validate"."""
        ...

    @property
    def domain(self) -> str:
        """ "time" | "frequency"."""
        ...

    @property
    def sources(self) -> tuple[str, ...]:
        """Sources of its records."""
        ...

    @property
    def runs(self) -> tuple[Run, ...]:
        """The runs to simulate."""
        ...

    def with_runs(self, runs: Sequence[Run]) -> Observation:
        """The same measurements with other runs, one for each of the present ones."""
        ...

    def held_out(self) -> Observation:
        """The same measurements with the use "validate"."""
        ...

    def head(self, share: float) -> Observation:
        """The first share of a log with unknown initial states; any other observation unchanged."""
        ...

    @property
    def channels(self) -> tuple[str, ...]:
        """Signals whose level is estimated; none if the residuals are already in standard deviations."""
        ...

    @property
    def channel_of_row(self) -> NDArray[np.intp]:
        """(n,) index in `channels` of each row of `residual`; zeros if there are no channels."""
        ...

    @property
    def samples(self) -> Array:
        """(n_c,) number of samples per channel, including degrees of freedom that `residual` leaves out."""
        ...

    @property
    def rest(self) -> Array:
        """(n_c,) sum of squares that `residual` leaves out since no model changes it, in the channel's unit squared."""
        ...

    @property
    def noise(self) -> tuple[float, ...]:
        """(n_c,) standard deviation of each channel's noise, specified or estimated from the log alone."""
        ...

    def residual(self, answers: Sequence[Simulated], measure: Measure = Measure.SIGNAL) -> Array:
        """(n, 1 + n_x + n_s) residual, measured minus simulated; its derivatives by search coordinates and states."""
        ...

    def nuisance_columns(self, answers: Sequence[Simulated], nuisances: Sequence[Nuisance]) -> Array:
        """(n, k) what one unit of each sensor error adds to the measured rows."""
        ...

    def sensed(self, answers: Sequence[Simulated], errors: SensorErrors) -> tuple[Simulated, ...]:
        """The results as sensors with these errors show them."""
        ...

    def pieces(self, residual: Array, shortest: float) -> NDArray[np.intp]:
        """(n,) number of the piece that each row belongs to; pieces count as independent of each other.

        Args:
            residual: (n,), whose autocorrelation sets the length of the pieces.
            shortest: length of a piece in units of lambda (`effective_size.inflation`)."""
        ...

    def beside(self, answers: Sequence[Simulated]) -> tuple[tuple[RecordFit, ...], tuple[ResponseFit, ...]]:
        """The measurements with the model's signals, logs and responses."""
        ...
