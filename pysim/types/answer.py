"""What a diagnosis answers, as numbers and codes alone: the effects that are needed, and what is left after them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pysim.types._frozen import FrozenMapping
from pysim.types.effect import Effect
from pysim.types.errors import BadInput
from pysim.types.factor import Factor
from pysim.types.fit import HALF_95, Direction, Estimate, RecordFit, ResponseFit
from pysim.types.note import Note

Array = NDArray[np.float64]

NONE, UNKNOWN = "none", "unknown"
PRIOR, REFIT = "prior", "refit"  # steps of the error history: the model as it is, and with its parameters refitted


class FloorSource(Enum):
    """Where the level below which no residual can fall comes from."""

    SPECIFIED = "specified"
    REPEATS = "repeats"  # the scatter of repeated periods
    SPECTRUM = "spectrum"  # the lowest bands of the residual's periodogram
    RESOLUTION = "resolution"  # rounding, integration error, or a share of the signal's range


@dataclass(frozen=True)
class NoiseFloor:
    """The least standard deviation that the residual of one signal can have.

    Args:
        sd: in the signal's unit, above 0.
        source: what gives it.
    """

    sd: float
    source: FloorSource

    def __post_init__(self) -> None:
        if not self.sd > 0:
            raise BadInput(f"noise floor: a standard deviation above 0 is needed, got {self.sd:g}")


class Verdict(Enum):
    """What a comparison of two models comes to."""

    BETTER = "better"
    NO_BETTER = "no_better"
    VETOED = "vetoed"  # worse on logs that may choose, or on blocks left out
    UNDECIDABLE = "undecidable"  # too few independent samples


@dataclass(frozen=True)
class GainTest:
    """A larger model against a smaller one: the F test at the effective sample size.

    Args:
        gain: fall of the objective, nats.
        df: parameters more.
        effective_size: number of independent samples that the residuals are worth.
        p_value: chance of such a gain where the effect is absent, all that was tried counted.
        penalised: gain less the penalty of the parameters, nats; rivals are ordered by it.
        held_out: nats by which validation logs fit worse; None if not asked.
        verdict: what it comes to.
    """

    gain: float
    df: int
    effective_size: float
    p_value: float
    penalised: float
    held_out: float | None
    verdict: Verdict


@dataclass(frozen=True)
class Rival:
    """A set of effects that was refitted, or only screened.

    Args:
        effects: standard names.
        score: gain less the penalty of the parameters, nats.
        p_value: chance of such a gain where the last of the effects is absent.
        explained: share of the avoidable sum of squares, 0 ... 1.
        refitted: whether a refit reached it; else the screening promises it.
        parameters: of the last effect, by their names as declared.
        test: against the model without the last of the effects; None where it was not refitted.
    """

    effects: tuple[str, ...]
    score: float
    p_value: float
    explained: float
    refitted: bool
    parameters: Mapping[str, float] = field(default_factory=dict)
    test: GainTest | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "parameters", FrozenMapping(self.parameters))


@dataclass(frozen=True)
class FoundEffect:
    """One effect that the data demand.

    Args:
        effect: of the catalogue.
        place: name ahead of its parameters' names in the extended model.
        estimates: of its parameters, by their names as the class declares them.
        share: of the avoidable sum of squares that leaving it out brings back, 0 ... 1; None where not counted.
    """

    effect: Effect
    place: str
    estimates: tuple[Estimate, ...]
    share: float | None = None


@dataclass(frozen=True)
class SensorError:
    """An error of a sensor that a model has beside its parameters.

    Args:
        kind: "gain" (share of the signal), "offset" (in its unit), "delay" (s) or "drift" (its unit per s).
        dataset, signal: where.
        size: how large.
    """

    kind: str
    dataset: str
    signal: str
    size: float


@dataclass(frozen=True)
class Failure:
    """A place where a model fails.

    Args:
        record, signal: of the data set.
        region: frequency band, time window, or range of a state.
        error: root-mean-square residual there, in standard deviations of the noise.
    """

    record: str
    signal: str
    region: str
    error: float


@dataclass(frozen=True)
class PlannedTest:
    """A test that is to be run on the bench.

    Args:
        sine: whether the command is a steady sine; else it is a stochastic wave.
        frequency: Hz, of the sine or of the wave's peak.
        amplitude: of the sine, or significant height of the wave, in the command's unit.
        offset: that it is around.
        unit: of the command.
        seconds: on the bench, lead included.
    """

    sine: bool
    frequency: float
    amplitude: float
    offset: float
    unit: str
    seconds: float


@dataclass(frozen=True)
class NextTest:
    """The experiment that would separate two answers best.

    Args:
        separates: the two.
        gain: difference of their sums of squares over noise that is expected once it is run and both are refitted.
        tests: what to run.
        log: signals to log.
        assumed: signal that was never logged -> standard deviation and unit of the noise that it is taken to have.
        plan: text of a test plan that `pysim bench` can run.
    """

    separates: tuple[str, str]
    gain: float
    tests: tuple[PlannedTest, ...]
    log: tuple[str, ...]
    assumed: Mapping[str, tuple[float, str]]
    plan: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "assumed", FrozenMapping(self.assumed))


@dataclass(frozen=True)
class ErrorStep:
    """One model of the error history, from the untouched one to that with every effect.

    Args:
        step: "prior", "refit", or the effects that came in, joined by " + ".
        fit, validate, test: rms residual over the noise floor of logs fitted, used to choose, and held out; None
            where there is no such log.
        criteria: worst value of each criterion of thesis Tables 1.3 and 1.4, by symbol; none where they do not hold.
        passes: whether all of these are within their limits, and every record was simulated.
        cost: of the objective.
        not_simulated: number of records that the model could not be run through.
        estimates, undetermined: parameters of this model; what the data do not determine.
        records, responses: logs and frequency responses beside it.
        failures: where it fails, worst first.
        sensors: errors of sensors that it has.
    """

    step: str
    fit: float | None
    validate: float | None
    test: float | None
    criteria: Mapping[str, float]
    passes: bool
    cost: float
    not_simulated: int = 0
    estimates: tuple[Estimate, ...] = ()
    undetermined: tuple[Direction, ...] = ()
    records: tuple[RecordFit, ...] = field(default=(), repr=False)
    responses: tuple[ResponseFit, ...] = field(default=(), repr=False)
    failures: tuple[Failure, ...] = field(default=(), repr=False)
    sensors: tuple[SensorError, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "criteria", FrozenMapping(self.criteria))

    def on_the_scale_of(self, other: ErrorStep) -> dict[str, float]:
        """Its values, moved along what changes nothing until the parameters held have the other model's values."""
        values, ends = {e.name: e.value for e in self.estimates}, {e.name: e.value for e in other.estimates}
        for direction in self.undetermined:
            held, exponent = next(iter(direction.exponents.items()))
            if values.get(held, 0.0) > 0 and ends.get(held, 0.0) > 0:
                factor = (ends[held] / values[held]) ** (1 / exponent)
                values |= {name: values[name] * factor**e for name, e in direction.exponents.items()}
        return values

    def moves_from(self, before: ErrorStep) -> dict[str, float | None]:
        """By how many half widths of the move's 95 percent interval each parameter has moved; None without one."""
        ends, values = {e.name: e for e in self.estimates}, before.on_the_scale_of(self)
        return {e.name: _moved(e, values[e.name], ends[e.name]) for e in before.estimates if e.name in ends}


def _moved(before: Estimate, value: float, after: Estimate) -> float | None:
    """From a value on the scale of the estimate afterwards; the errors of the two count as independent."""
    up, scale = int(after.value > value), value / before.value if before.value else 1.0
    half = float(np.hypot(scale * (before.interval[up] - before.value), after.interval[1 - up] - after.value))
    return abs(after.value - value) / half if before.determined and after.determined and half > 0 else None


@dataclass(frozen=True)
class LearnedLaw:
    """A law that no catalogue has: `factor(z2) * h(z1)` at a slot, `h` a curve through knots.

    Args:
        slot: place in the model.
        factor: of the curve h: a variable z2 and what is done with it, or 1.
        argument: variable z1.
        knots: (m,) increasing, in `argument_unit`.
        coefficients: (m,) value of h at each, in `unit`.
        covariance: (m, m) of the coefficients.
        share: of the avoidable sum of squares, 0 ... 1.
        argument_unit, unit: SI.
        absorbed: (m, k) curves that the model's own parameters do as well: any amount may be added without a trace.
        edf: effective number of coefficients.
        formula: a short expression, "" where none fits.
        modelica: text of its class; "" where none was written.
        alternatives: other places that these data do not tell from this one.
        parameters: free numbers of the model, by name, refitted beside the law.
        test: against the model without it; None where it was not refitted to the end.
        held_out: rms over floor of the logs that may choose, without the law and with it; None where there are none.
        reach: smallest and largest argument in the fitted logs; the outermost knots where it is not known.
    """

    slot: str
    factor: Factor
    argument: str
    knots: Array
    coefficients: Array
    covariance: Array
    share: float
    argument_unit: str
    unit: str
    absorbed: Array = field(default_factory=lambda: np.zeros((0, 0)))
    edf: float | None = None
    formula: str = ""
    modelica: str = ""
    alternatives: tuple[str, ...] = ()
    parameters: Mapping[str, float] = field(default_factory=dict)
    test: GainTest | None = None
    held_out: tuple[float | None, float | None] = (None, None)
    reach: tuple[float, float] = (math.nan, math.nan)

    def __post_init__(self) -> None:
        for name in ("knots", "coefficients", "covariance", "absorbed"):
            values = np.array(getattr(self, name), dtype=np.float64)
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        object.__setattr__(self, "parameters", FrozenMapping(self.parameters))
        m = self.knots.size
        if m and math.isnan(self.reach[0]):
            object.__setattr__(self, "reach", (float(self.knots[0]), float(self.knots[-1])))
        if self.coefficients.shape != (m,) or self.covariance.shape != (m, m):
            raise BadInput(
                f"learned law at {self.slot}: {m} knots need {m} coefficients and their ({m}, {m}) covariance"
            )

    @property
    def band(self) -> tuple[Array, Array]:
        """(m,) ends of the 95 percent interval of each coefficient."""
        half = HALF_95 * np.sqrt(np.maximum(np.diag(self.covariance), 0.0))
        return self.coefficients - half, self.coefficients + half

    @property
    def is_flat(self) -> bool:
        """Whether one value lies within the interval of every coefficient."""
        low, high = self.band
        return bool(np.max(low) <= np.min(high))


@dataclass(frozen=True)
class Detectable:
    """How large an effect that was not found would have to be for these logs to show it.

    Args:
        effect: its standard name.
        sizes, units: of its strengths, by their names as declared, to first order.
    """

    effect: str
    sizes: Mapping[str, float]
    units: Mapping[str, str]

    def __post_init__(self) -> None:
        for name in ("sizes", "units"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))


@dataclass(frozen=True)
class StandsOut:
    """A log whose residual of a signal is `over` times as large as in the other logs."""

    record: str
    signal: str
    over: float


@dataclass(frozen=True)
class Left:
    """What is left after the last model.

    Args:
        floors: dataset and signal -> noise floor.
        fit, validate: rms over floor.
        share_explained: of the residual, by regression on the model's own signals, 0 ... 1; None where not judged.
        t: of that share.
        tone: Hz, of one that the residual holds; None where it holds none.
        stands_out: the log that leaves more than the others; None where none does.
    """

    floors: Mapping[str, NoiseFloor]
    fit: float | None
    validate: float | None
    share_explained: float | None = None
    t: float | None = None
    tone: float | None = None
    stands_out: StandsOut | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "floors", FrozenMapping(self.floors))


@dataclass(frozen=True)
class Diagnosis:
    """The whole answer.

    Args:
        effects: that the data demand, what costs most to leave out first.
        complete: whether nothing but noise is left, after the learned laws too.
        left: what is left.
        rivals: what was compared, best first.
        ties: groups of names that the data do not tell apart.
        history: the error, model by model.
        failures: where the refitted base model fails, worst first.
        learned: laws that no catalogue has, in the order they were added.
        detectable: effects that were not found, and from which size on they would have been; none where the model
            leaves more than noise, which hides them.
        missing: of each place where a law was tried the best one, the likeliest place first; those that were added
            among them.
        next_test: where two answers are left that another test would tell apart.
        estimates: parameters of the final model.
        notes: what a reader must know.
        conditions: what it takes to repeat it: model, data, solver, versions.
        seconds: wall time by stage.
    """

    effects: tuple[FoundEffect, ...]
    complete: bool
    left: Left
    rivals: tuple[Rival, ...]
    ties: tuple[tuple[str, ...], ...]
    history: tuple[ErrorStep, ...]
    failures: tuple[Failure, ...]
    learned: tuple[LearnedLaw, ...] = ()
    missing: tuple[LearnedLaw, ...] = ()
    next_test: NextTest | None = None
    estimates: tuple[Estimate, ...] = ()
    notes: tuple[Note, ...] = ()
    conditions: Mapping[str, str] = field(default_factory=dict)
    seconds: Mapping[str, float] = field(default_factory=dict)
    detectable: tuple[Detectable, ...] = ()

    def __post_init__(self) -> None:
        for name in ("seconds", "conditions"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))

    @property
    def verdict(self) -> str:
        """The first effect's name; UNKNOWN where only a learned law, or nothing, explains the rest; else NONE."""
        if self.effects:
            return self.effects[0].effect.name
        return NONE if self.all_named else UNKNOWN

    @property
    def all_named(self) -> bool:
        """Whether nothing but noise is left and nothing is without a name, as the cause of a learned law is."""
        return self.complete and not self.learned

    @property
    def laws(self) -> tuple[LearnedLaw, ...]:
        """Those that were added, then the best at other places."""
        added = {law.slot for law in self.learned}
        return (*self.learned, *(law for law in self.missing if law.slot not in added))

    @property
    def likeliest(self) -> tuple[LearnedLaw, ...]:
        """Learned laws that were added; the best one that was tried where none was."""
        return self.learned or self.missing[:1]

    @property
    def base(self) -> ErrorStep | None:
        """The refitted model; the untouched one where nothing was refitted, None where nothing was simulated."""
        steps = {step.step: step for step in self.history}
        return steps.get(REFIT, steps.get(PRIOR))

    @property
    def last(self) -> ErrorStep | None:
        """The model with all that was added; None where nothing was."""
        return self.history[-1] if self.history and self.history[-1].step not in (PRIOR, REFIT) else None
