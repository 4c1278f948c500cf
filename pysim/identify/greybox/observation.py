"""What a model is compared with: a log, the stepped sines of a test, or a table of a response."""

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
    """In what residuals are counted."""

    SIGNAL = "signal"  # the signal's own unit; a response table over its standard deviations
    THESIS = "thesis"  # percent over time (Eq. 2.24), 90/20 dB and degrees over frequency (Eq. 2.25)


@dataclass(frozen=True)
class Run:
    """One run that an observation needs, without the parameters that are fitted.

    Args:
        record: source of the log, which may have parameters of its own.
        experiment: a run over time; with `orbit`, the same test as a transient, recorded at the orbit's points.
        orbit: the periodic steady state, where one is to be found first.
        initial: (n_x,) standard deviation of the states at the log's start around rest: infinite where nothing is
            known of them, 0 where they are held. All are held where it is empty.
        begins: s, when the log starts.
        measured: (n_t, n_y) what each row of a run over time is compared with; empty where it is not row by row.
    """

    record: str
    experiment: Experiment
    orbit: Periodic | None = None
    initial: Array = field(default_factory=lambda: np.zeros(0))
    begins: float = 0.0
    measured: Array = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def free(self) -> NDArray[np.intp]:
        """Places of the states that are free at the log's start."""
        return np.flatnonzero(self.initial)

    @property
    def begins_anywhere(self) -> bool:
        """Whether nothing is known of some state at the log's start."""
        return bool(np.isinf(self.initial).any())

    def over_time(self, overrides: Mapping[str, float], offset: Array | None) -> Experiment:
        """The run over time with parameters set, its free states begun at an offset (n_s,) from rest, or at rest."""
        experiment = self.experiment.override(**overrides)
        if offset is None or not self.free.size:
            return experiment
        whole = np.zeros(self.initial.size)
        whole[self.free] = offset
        return experiment.moved(whole, self.begins)


@dataclass(frozen=True)
class Simulated:
    """Answer of a run.

    Args:
        values: (n_t, n_y) in the variables' units.
        slopes: (n_t, n_y, n_x) by the search's numbers.
        by_initial: (n_t, n_y, n_s) by the free states at the log's start.
        reduction: what a long log became instead; then there are no rows.
    """

    values: Array
    slopes: Array
    by_initial: Array = field(default_factory=lambda: np.zeros((0, 0, 0)))
    reduction: Reduction | None = None


class Observation(Protocol):
    """Measurements in the form in which the model is compared with them. Only its own file knows its kind."""

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
        """Of its records."""
        ...

    @property
    def runs(self) -> tuple[Run, ...]:
        """What has to be simulated."""
        ...

    def with_runs(self, runs: Sequence[Run]) -> Observation:
        """The same measurements beside other runs, one for each of `runs`."""
        ...

    def head(self, share: float) -> Observation:
        """The first share of a log that begins anywhere; anything else as it is."""
        ...

    @property
    def channels(self) -> tuple[str, ...]:
        """Signals with a level of their own; none where the residuals have a known one, 1."""
        ...

    @property
    def channel_of_row(self) -> NDArray[np.intp]:
        """(n,) place among `channels` of each row of `residual`; zeros where there are none."""
        ...

    @property
    def samples(self) -> Array:
        """(n_c,) independent numbers per channel, those too that `residual` leaves out."""
        ...

    @property
    def rest(self) -> Array:
        """(n_c,) sum of squares of those that it leaves out, which no model changes, in the unit squared."""
        ...

    @property
    def noise(self) -> tuple[float, ...]:
        """(n_c,) standard deviation of each channel's noise, specified or estimated from the log alone."""
        ...

    def residual(self, answers: Sequence[Simulated], measure: Measure = Measure.SIGNAL) -> Array:
        """Measured minus simulated, and its slopes by the search's numbers and the free initial states: (n, m)."""
        ...

    def nuisance_columns(self, answers: Sequence[Simulated], nuisances: Sequence[Nuisance]) -> Array:
        """What one unit of each nuisance adds to the measured rows, (n, k)."""
        ...

    def sensed(self, answers: Sequence[Simulated], errors: SensorErrors) -> tuple[Simulated, ...]:
        """The answers as sensors with these errors show them."""
        ...

    def pieces(self, residual: Array, shortest: float) -> NDArray[np.intp]:
        """(n,) number of the piece that each row belongs to: stretches that count as independent of each other.

        Args:
            residual: (n,) at the point, whose memory says how long a stretch has to be.
            shortest: length of a piece in memories.
        """
        ...

    def beside(self, answers: Sequence[Simulated]) -> tuple[tuple[RecordFit, ...], tuple[ResponseFit, ...]]:
        """The measurements beside the model."""
        ...
