"""What a fit found: parameters with their doubt, what the data cannot tell, and what each record leaves over."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pysim.types._frozen import FrozenMapping
from pysim.types.comparison import ResponseComparison
from pysim.types.criterion import Deviation
from pysim.types.errors import BadInput
from pysim.types.experiment import Experiment
from pysim.types.note import Note
from pysim.types.record import Record

HALF_95 = 1.959964  # half width of a 95 percent interval of a normal error, standard deviations

Array = NDArray[np.float64]


class FitOutcome(Enum):
    """How the search for the best parameters ended."""

    CONVERGED = "converged"
    STALLED = "no better point was found, though the slope promises one"
    ITERATION_LIMIT = "the limit of iterations was reached"
    NO_START = "the model could not be simulated at the start"


@dataclass(frozen=True)
class Estimate:
    """One fitted parameter; numbers in `unit`.

    Args:
        name: of the model's variable; behind an @ the record it belongs to, where it has a value for that one alone.
        value: the estimate.
        start: where the fit began.
        lower, upper: bounds; infinite where there are none.
        std: standard deviation to first order; infinite where the data do not determine the parameter.
        interval: 95 percent; one-sided where the estimate stands at a bound, the bounds where it is not determined.
        at: "lower" or "upper" where the estimate stands at that bound, else "".
    """

    name: str
    unit: str
    value: float
    start: float
    lower: float
    upper: float
    std: float
    interval: tuple[float, float]
    at: str = ""

    @property
    def determined(self) -> bool:
        """Whether the data say anything about this parameter by itself."""
        return math.isfinite(self.std)


@dataclass(frozen=True)
class Direction:
    """A product of powers of parameters along which the data say little or nothing.

    Args:
        exponents: parameter -> exponent; multiplying each by s to its exponent leaves the compared signals as they are.
        spread: standard deviation of ln s; infinite where nothing at all changes.
        reach: least and largest s with which every parameter stays inside its 95 percent interval, and so its bounds.
    """

    exponents: Mapping[str, float]
    spread: float
    reach: tuple[float, float] = (0.0, math.inf)

    def __post_init__(self) -> None:
        object.__setattr__(self, "exponents", FrozenMapping(self.exponents))


@dataclass(frozen=True)
class Combination:
    """A product of powers of parameters that the data determine although its factors are not.

    Args:
        exponents: parameter -> exponent.
        name: the product as text.
        value: in the product of the parameters' units.
        interval: 95 percent.
    """

    exponents: Mapping[str, float]
    name: str
    value: float
    interval: tuple[float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "exponents", FrozenMapping(self.exponents))


@dataclass(frozen=True)
class Harmonics:
    """One signal of a stepped sine as mean and harmonics, the phase counted from the command's.

    Args:
        frequency: Hz, of the fundamental.
        measured, simulated: (n_h + 1,) complex: the mean, then a exp(j phi) for a sin(k omega t + phi).
        std: (n_h + 1,) standard deviation of the measured ones' sizes, in the signal's unit.
    """

    signal: str
    frequency: float
    measured: NDArray[np.complex128]
    simulated: NDArray[np.complex128]
    std: Array


@dataclass(frozen=True)
class RecordFit:
    """One log beside the fitted model.

    Args:
        dataset, source, kind, use: of the log.
        measured: the samples that were compared, columns by their names in the log.
        simulated: the same of the model.
        noise: (n_y,) standard deviation of the measurement noise, in the columns' units.
        deviations: per column, the criteria of thesis Table 1.4.
        harmonics: of a stepped sine, one per column.
        index: place of the log among `Dataset.logs()`, from 0; a diagnosis leaves tables out, which does not change it.
    """

    dataset: str
    source: str
    kind: str
    use: str
    measured: Record
    simulated: Record
    noise: tuple[float, ...]
    deviations: Mapping[str, tuple[Deviation, ...]] = field(default_factory=dict)
    harmonics: tuple[Harmonics, ...] = ()
    index: int = field(kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "deviations", FrozenMapping(self.deviations))
        if self.measured.values.shape != self.simulated.values.shape or len(self.noise) != len(self.measured.names):
            raise BadInput(f"record fit {self.source}: measured, simulated and noise must have the same columns")

    @property
    def held_out(self) -> bool:
        """Whether nothing was fitted to it."""
        return self.use != "fit"

    @property
    def residual(self) -> Record:
        """Measured minus simulated, in standard deviations of the noise; not-a-number where nothing was measured."""
        values = (self.measured.values - self.simulated.values) / np.array(self.noise)
        units = ("1",) * len(self.noise)
        return Record(self.measured.time, values, self.measured.names, units, origin="measured minus simulated")

    @property
    def rms(self) -> dict[str, float]:
        """Per column, the root-mean-square residual over the noise: 1 where nothing but noise is left."""
        sizes = np.sqrt(np.nanmean(self.residual.values**2, axis=0))
        return dict(zip(self.measured.names, sizes.tolist(), strict=True))

    @property
    def fit_percent(self) -> dict[str, float]:
        """Per column, 100 (1 - |measured - simulated| / |measured - its mean|); NaN of a column that never moves."""
        moved = self.measured.values - np.nanmean(self.measured.values, axis=0)
        size, away = (
            np.sqrt(np.nansum(own**2, axis=0)) for own in (moved, self.measured.values - self.simulated.values)
        )
        fit = 100 * (1 - np.divide(away, size, out=np.full(size.shape, np.nan), where=size > 0))
        return dict(zip(self.measured.names, fit.tolist(), strict=True))


@dataclass(frozen=True)
class ResponseFit:
    """One frequency response beside that of the fitted model, with the criteria of thesis Table 1.3."""

    dataset: str
    use: str
    comparison: ResponseComparison


@dataclass(frozen=True)
class Start:
    """Where one search began, the cost there, and what came of it."""

    name: str
    values: Mapping[str, float]
    first_cost: float
    cost: float
    outcome: FitOutcome

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", FrozenMapping(self.values))


@dataclass(frozen=True)
class Fit:
    """A model fitted to measurements. It never calls itself a success: read outcome, misfit and the other records.

    Args:
        model: its name.
        objective, optimiser: what was minimised, and how, in words.
        estimates: one per free parameter.
        covariance: (n_p, n_p) of the estimates, their units; rows of what is not determined are not a number.
        values: every parameter that was free, tied or fixed -> value; what `overrides` of an experiment takes.
        undetermined: directions the data do not determine, exact ones first.
        combinations: what of those directions is determined after all.
        records: logs beside the fitted model, those too that were not fitted.
        responses: frequency responses, from tables or from stepped sines.
        cost: of the objective at the estimates; start_cost at the start. Nats where squares are summed up, and then of
            any sign, so that only differences count.
        misfit: root-mean-square residual over the noise, per degree of freedom: 1 where nothing but noise is left.
        outcome, message: how the search ended.
        iterations: evaluations of the objective that were tried in the search that won.
        starts: every search.
        notes: what a reader must know: noise that was estimated, records that were left out.
        experiments: exactly what was run for the logs over time, at the estimates.
        tolerance: relative, of the integration.
        initial: states at the first sample of logs of which nothing else says where they began; `start` is at rest.
    """

    model: str
    objective: str
    optimiser: str
    estimates: tuple[Estimate, ...]
    covariance: Array
    values: Mapping[str, float]
    undetermined: tuple[Direction, ...]
    combinations: tuple[Combination, ...]
    records: tuple[RecordFit, ...]
    responses: tuple[ResponseFit, ...]
    cost: float
    start_cost: float
    misfit: float
    outcome: FitOutcome
    message: str
    iterations: int
    starts: tuple[Start, ...] = ()
    notes: tuple[Note, ...] = ()
    experiments: tuple[Experiment, ...] = ()
    initial: tuple[Estimate, ...] = ()
    tolerance: float = 1e-5

    def __post_init__(self) -> None:
        covariance = np.array(self.covariance, dtype=np.float64)
        covariance.setflags(write=False)
        object.__setattr__(self, "covariance", covariance)
        object.__setattr__(self, "values", FrozenMapping(self.values))
        n = len(self.estimates)
        if covariance.shape != (n, n):
            raise BadInput(f"fit: {n} estimates need a covariance of shape ({n}, {n}), got {covariance.shape}")

    def __getitem__(self, name: str) -> Estimate:
        """The estimate of that parameter, or of a state at the first sample of a log, "x@run1.csv"."""
        for estimate in (*self.estimates, *self.initial):
            if estimate.name == name:
                return estimate
        raise BadInput(f"fit: {name!r} was not free; free were {', '.join(e.name for e in self.estimates)}")

    @property
    def correlation(self) -> Array:
        """(n_p, n_p) correlations of the estimates; not a number where one is not determined."""
        std = np.sqrt(np.diag(self.covariance))
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.asarray(self.covariance / np.outer(std, std))

    def held_out(self) -> dict[str, float]:
        """Root-mean-square residual over noise of the records that were not fitted: "source: signal" -> number."""
        return {
            f"{record.source}: {signal}": value
            for record in self.records
            if record.held_out
            for signal, value in record.rms.items()
        }
