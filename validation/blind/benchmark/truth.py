"""What only the one who knows the truth can say of a case: detectability, and how well the true model could be known.

Counted by itself, not by the diagnosis that is judged: stepped sines as mean and five harmonics, settled; other logs
sample by sample; each over the noise that the data set states, resolution included.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox import GaussNewton, Parameter, Simulation, Threads, Treatment, problem
from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.observation import Observation, Simulated
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.parameters import ParameterSpace, parameter_space
from pysim.identify.greybox.residuals import Point, failed_point
from pysim.identify.greybox.runs import Failure, simulate_runs
from pysim.simulate import Rodas, simulate_many
from pysim.types import Dataset, Effect, Experiment, Model, Outcome, Record
from validation.blind.benchmark.workshop import Workshop
from validation.blind.plant import BOUNDS, Case, Measured
from validation.blind.plant.effects import told

Array = NDArray[np.float64]

_SOLVER = Rodas(rtol=1e-5, atol=1e-5)
_STEP = 1e-2  # of one-sided differences, in natural logarithms or shares of the scale, for models with events
# A refit ends where a full step would lower the sum of squares by less than this share of it, or by half of one.
_REFIT = GaussNewton(max_iterations=8, tolerance=0.25, share=1e-2)


@dataclass(frozen=True)
class Extension:
    """A model, its free numbers, and whether its runs have events, so that slopes have to be taken by differences."""

    model: Model
    space: ParameterSpace
    events: bool = False

    @property
    def x(self) -> Array:
        """The truth, (n,) of the space, as near as the bounds let it."""
        return self.space.to_search(self.space.start)


@dataclass(frozen=True)
class Truth:
    """A case beside its noise-free readings.

    Args:
        case, measured: what was done, and what it left.
        shop: compiles models.
    """

    case: Case
    measured: Measured
    shop: Workshop

    @cached_property
    def targets(self) -> tuple[Observation, ...]:
        """Noise-free readings in the form in which models are compared with them."""
        data = noise_free(self.measured)
        treatment = Treatment(steady="transient", initial="rest")
        return problem(self.shop.model, [data], tuple(BOUNDS), treatment=treatment).observations

    def of_use(self, use: str) -> tuple[Observation, ...]:
        """Those to fit or to validate."""
        return tuple(target for target in self.targets if target.use == use)

    def model(self, names: Sequence[str]) -> Extension:
        """The pump with these effects, all at the truth."""
        effects = [self.shop.effect(name) for name in names]
        parameters = [_parameter(name, value, *BOUNDS[name]) for name, value in self.base.items()]
        if not effects:
            return Extension(self.shop.model, parameter_space(self.shop.model, parameters))
        built, places = self.shop.variant(effects)
        for effect in effects:
            own = self.strengths(effect)
            for p in effect.parameters:
                log = None if p.off is None else False
                parameters.append(_parameter(f"{places[effect.name]}.{p.name}", own[p.name], p.min, p.max, log))
        still = Extension(built, parameter_space(built, parameters))
        return replace(still, events=_has_events(self.of_use("fit"), still))

    @cached_property
    def base(self) -> dict[str, float]:
        """The 13 identified parameters."""
        return {name: float(getattr(self.case.parameters(), name)) for name in BOUNDS}

    def strengths(self, effect: Effect) -> dict[str, float]:
        """An effect's parameters as its class declares them."""
        spoken = told(effect.name, self.case.strengths())
        return {p.name: 1 / spoken[p.inverse] if p.inverse else spoken[p.name] for p in effect.parameters}

    def left(self, names: Sequence[str], near: Mapping[str, float] | None = None) -> float | None:
        """Sum of squares that the model with these effects leaves once refitted; None where it cannot be simulated.

        Args:
            near: another point to start from, taken where it leaves less than the truth.
        """
        point, targets = self.model(names), self.of_use("fit")
        bounds = Bounds(*point.space.bounds())
        state = _REFIT.begin(self._first(point, near or {}), bounds, True)
        while state.best.good and state.outcome is None:
            proposal = _REFIT.propose(state, bounds)
            state = _REFIT.tell(state, proposal, evaluation(targets, point, proposal.x), bounds)
        return 2 * state.best.cost if state.best.good else None

    def _first(self, point: Extension, near: Mapping[str, float]) -> Point:
        """The better of the truth and a point that may be nearer."""
        targets, space = self.of_use("fit"), point.space
        here = [near.get(name, value) for name, value in zip(space.keys, space.start.tolist(), strict=True)]
        there = space.to_search(np.clip(here, space.lower, space.upper))
        costs = [
            np.inf if found is None else float(found @ found)
            for found in (_residual(targets, point.model, space.values(x)) for x in (point.x, there))
        ]
        return evaluation(targets, point, there if costs[1] < costs[0] else point.x)

    def bound(self) -> float | None:
        """Cramer and Rao's bound of the error on held-out records, a root mean square over the noise."""
        point = self.model([name for name, _ in self.case.effects])
        fitted, held = (evaluation(self.of_use(use), point, point.x) for use in ("fit", "validate"))
        if not (fitted.good and held.good):
            return None
        inverse = np.linalg.pinv(np.linalg.qr(fitted.jacobian, mode="r"), rcond=EXACT)
        return float(np.linalg.norm(held.jacobian @ inverse) / np.sqrt(held.residual.size))


def noise_free(measured: Measured) -> Dataset:
    """The data set as it would be without noise and resolution."""
    records = []
    for record in measured.dataset.records:
        assert isinstance(record.data, Record)
        clean = dict(zip(("alphaPercent", "u"), measured.clean[record.source].T, strict=True))
        columns = [clean.get(name, record.data[name]) for name in record.data.names]
        records.append(replace(record, data=replace(record.data, values=np.column_stack(columns))))
    return replace(measured.dataset, records=tuple(records))


def _parameter(name: str, value: float, lower: float, upper: float, log: bool | None = None) -> Parameter:
    return Parameter(name, float(np.clip(value, lower, upper)), lower, upper, log=log)


def evaluation(targets: Sequence[Observation], point: Extension, x: Array) -> Point:
    """Residuals of targets and their slopes: exact for a run without events, else by one-sided differences."""
    model, space = point.model, point.space
    if not point.events:
        runs = [run for target in targets for run in target.runs]
        answer = simulate_runs(model, space, runs, x, [None] * len(runs), Simulation(workers=Threads(1)), initial=False)
        return failed_point(x, answer.failure) if answer.failure else _counted(targets, x, answer.simulated)
    low, high = space.bounds()
    steps = np.where(high - x >= x - low, _STEP, -_STEP)
    residual, *moved = (_residual(targets, model, space.values(p)) for p in (x, *(x + np.diag(steps))))
    if residual is None or any(r is None for r in moved):
        why = "the model could not be simulated at this point or beside it"
        return failed_point(x, Failure("", Outcome.MODEL_ERROR, why))
    columns = [(r - residual) / step for r, step in zip(moved, steps, strict=True) if r is not None]
    return Point(x, 0.5 * float(residual @ residual), residual, np.stack(columns, axis=1))


def _counted(targets: Sequence[Observation], x: Array, simulated: Sequence[Simulated]) -> Point:
    rest, values, slopes = list(simulated), [], []
    for target in targets:
        own, rest = rest[: len(target.runs)], rest[len(target.runs) :]
        rows = target.residual(own) / np.array(target.noise)[target.channel_of_row][:, None]
        values.append(rows[:, 0])
        slopes.append(rows[:, 1:])
    residual = np.concatenate(values)
    return Point(x, 0.5 * float(residual @ residual), residual, np.concatenate(slopes))


def _runs(targets: Sequence[Observation], values: Mapping[str, float]) -> list[Experiment]:
    runs = [run.experiment for target in targets for run in target.runs]
    return [replace(run, overrides={**run.overrides, **values}) for run in runs]


def _residual(targets: Sequence[Observation], model: Model, values: Mapping[str, float]) -> Array | None:
    records = simulate_many(model, _runs(targets, values), solver=_SOLVER, workers=1)
    if any(r.outcome is not Outcome.DONE or not np.isfinite(r.values).all() for r in records):
        return None
    simulated = [Simulated(r.values, np.zeros((*r.values.shape, 0))) for r in records]
    return _counted(targets, np.zeros(0), simulated).residual


def _has_events(targets: Sequence[Observation], point: Extension) -> bool:
    """Whether the shortest run, a stepped sine, makes more events than its command has pieces."""
    shortest = min(_runs(targets, point.space.values(point.x)), key=lambda run: float(run.times[-1]) - run.start)
    record = simulate_many(point.model, [shortest], solver=_SOLVER, workers=1)[0]
    return record.statistics["events"] > sum(signal.starts.size for signal in shortest.inputs.values())
