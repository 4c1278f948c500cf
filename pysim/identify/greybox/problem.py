"""Problem of a fit: a model, its measurements and its free parameters, checked once and then never changed."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.context import Context, on_one_clock
from pysim.identify.greybox.noise import noise_floor, signal_noise
from pysim.identify.greybox.objective import NOISE, Objective
from pysim.identify.greybox.observation import Observation, Run
from pysim.identify.greybox.parameters import Parameter, ParameterSpace, Tie, parameter_space
from pysim.identify.greybox.residuals import Channel, WeightedResiduals
from pysim.identify.greybox.response_table import UNSPECIFIED_DB, UNSPECIFIED_DEG, ResponseTable, response_table
from pysim.identify.greybox.runs import Simulation
from pysim.identify.greybox.settings import NoiseSettings
from pysim.identify.greybox.stepped_sines import stepped_sines, swing, unsettled
from pysim.identify.greybox.time_log import kept_columns, time_logs
from pysim.identify.greybox.treatment import Measurements, Treatment
from pysim.simulate import one_blas_thread
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, Model, Note, NoteCode, Record
from pysim.types.answer import FloorSource, NoiseFloor
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Problem:
    """Everything that defines a fit.

    Args:
        model: left unchanged.
        space: free, tied and fixed parameters.
        observations: measurements, including those that are not fitted.
        floors: noise floor of each channel, below which the level of its residual never falls.
        notes: assumptions about the data.
        settings: how levels, blocks and priors are set.
        specified: whether the data specify the noise of every signal and table.
    """

    model: Model
    space: ParameterSpace
    observations: tuple[Observation, ...]
    floors: Mapping[Channel, NoiseFloor] = field(default_factory=dict)
    notes: tuple[Note, ...] = ()
    settings: NoiseSettings = field(default_factory=NoiseSettings)
    specified: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "floors", MappingProxyType(dict(self.floors)))

    @property
    def noise(self) -> Mapping[Channel, float]:
        """Standard deviation of each channel's noise, specified or estimated from the logs alone."""
        own = [((o.dataset, n), sd) for o in self.observations for n, sd in zip(o.channels, o.noise, strict=True)]
        return {channel: floor.sd for channel, floor in self.floors.items()} | dict(own)

    def without(self, sources: Collection[str]) -> Problem:
        """The problem with the observations of these sources held out, as validation logs are."""
        own = [one.held_out() if set(one.sources) <= set(sources) else one for one in self.observations]
        return replace(self, observations=tuple(own))

    def residuals(
        self, objective: Objective = NOISE, simulation: Simulation | None = None, *, use: str = "fit"
    ) -> WeightedResiduals:
        """Residuals of the records of one use ("fit" or "validate"), in the objective's measure.

        Raises:
            BadInput: no record with use "fit" belongs to the objective.
        """
        chosen = objective.chosen(self.observations) if use == "fit" else [o for o in self.observations if o.use == use]
        return WeightedResiduals(
            tuple(chosen),
            self.floors,
            simulation or Simulation(),
            objective.measure,
            not objective.squares,
            settings=self.settings,
        )


def beside(problem: Problem, model: Model, free: Sequence[Parameter | str]) -> Problem:
    """The problem with an extended model and other free parameters; the observations are reused, not made again.

    In logs with free initial states, new states are free as well, with their nominal size as prior standard deviation.

    Args:
        model: has all variables of the problem's model.
    """
    parameters = [Parameter(p) if isinstance(p, str) else p for p in free]
    space = parameter_space(model, parameters, fixed=problem.space.fixed, ties=problem.space.ties)
    known = problem.model.abilities.states

    def moved(run: Run) -> Run:
        if not run.free.size:
            return run if not run.initial.size else replace(run, initial=np.zeros(len(model.abilities.states)))
        sd = dict(zip(known, run.initial.tolist(), strict=True))
        nominal = {name: abs(model[name].nominal or 1.0) for name in model.abilities.states}
        return replace(run, initial=np.array([sd.get(name, nominal[name]) for name in model.abilities.states]))

    observations = tuple(one.with_runs([moved(run) for run in one.runs]) for one in problem.observations)
    return replace(problem, model=model, space=space, observations=observations)


def problem(
    model: Model,
    data: Sequence[Measurements | Dataset],
    free: Sequence[Parameter | str],
    *,
    fixed: Mapping[str, float] | None = None,
    ties: Sequence[Tie] = (),
    treatment: Treatment | None = None,
) -> Problem:
    """Check model, data sets and parameters, and make the problem.

    Args:
        model: has a variable for each compared signal, in the same unit. An input with the name of a command and the
            suffix `_t` is taken as the command's rate, and gets the exact derivative.
        data: data sets; a plain Dataset means all its outputs and no overrides.
        free: parameters; a plain name takes start and bounds from the model.
        fixed: parameter -> value, in its unit.
        ties: parameters that are proportional to free ones.
        treatment: how logs are compared.
    Raises:
        BadInput: model, data and parameters do not match.
    """
    treatment = treatment or Treatment()
    parameters = [Parameter(p) if isinstance(p, str) else p for p in free]
    space = parameter_space(model, parameters, fixed=fixed, ties=ties)
    if not data:
        raise BadInput("fit: give at least one data set")
    at = _set_beside(model, space.overrides(space.to_search(space.start), ""))
    observations: list[Observation] = []
    floors: dict[Channel, NoiseFloor] = {}
    notes: list[Note] = []
    specified = True
    for one in (d if isinstance(d, Measurements) else Measurements(d) for d in data):
        for name in one.overrides:
            if name in (*space.variables, *space.fixed, *(tie.name for tie in space.ties)):
                raise BadInput(f"fit: data set {one.dataset.name!r} overrides {name}, which is free, tied or fixed")
        one = replace(one, dataset=on_one_clock(one.dataset))
        context, said = _context(model, one, treatment, _started(model, space), at)
        with one_blas_thread():
            found, more, stated = _observations(context)
        own = _floors(context)
        observations, notes = [*observations, *found], [*notes, *said, *more]
        specified = specified and stated and all(f.source is FloorSource.SPECIFIED for f in own.values())
        floors |= own
    _check_records(space, observations)
    if not any(one.use == "fit" for one in observations):
        raise BadInput(
            'fit: no record is for fitting; give at least one use = "fit" in dataset.toml, in Python hold out fewer'
        )
    return Problem(model, space, tuple(observations), floors, tuple(dict.fromkeys(notes)), treatment.noise, specified)


def of_outputs(dataset: Dataset, outputs: Sequence[str]) -> Dataset:
    """The measurements without other outputs than these; as they are where none is named.

    Raises:
        BadInput: one that is not measured.
    """
    if not outputs:
        return dataset
    measured = [signal.name for signal in dataset.signals if signal.role == "output"]
    for name in outputs:
        if name not in measured:
            raise BadInput(
                f"data set {dataset.name!r} measures no output {name!r}; it has {', '.join(measured)}",
                argument="outputs",
            )
    signals = tuple(signal for signal in dataset.signals if signal.role == "input" or signal.name in outputs)
    names, records = {signal.name for signal in signals}, list[MeasuredRecord]()
    for record in dataset.records:
        if isinstance(record.data, Record):
            kept = tuple(name for name in record.data.names if name in names)
            records.append(replace(record, data=kept_columns(record.data, kept)))
        elif record.data.test.output in names:
            records.append(record)
    return replace(dataset, signals=signals, records=tuple(records))


def _set_beside(model: Model, values: Mapping[str, float]) -> dict[str, float]:
    """Those that are not the model's own, but for states, up to the rounding of a logarithmic scale."""
    own = {name: model[name].start for name in values if name not in model.abilities.states}
    return {
        name: values[name]
        for name, start in own.items()
        if start is None or not math.isclose(values[name], start, rel_tol=1e-12)
    }


def _context(
    model: Model, data: Measurements, treatment: Treatment, started: Collection[str | None], at: Mapping[str, float]
) -> tuple[Context, list[Note]]:
    """The context of a data set, and notes on noise that was estimated."""
    dataset = data.dataset
    outputs = tuple(signal.name for signal in dataset.signals if signal.role == "output")
    sizes: dict[str, float] = {}
    notes: list[Note] = []
    for name in outputs:
        if logs := _columns(dataset, name):
            sizes[name], is_estimated = signal_noise(dataset.signal(name), logs, treatment.noise)
            if is_estimated:
                names = {"dataset": dataset.name, "signal": name, "unit": dataset.signal(name).unit}
                notes.append(Note(NoteCode.NOISE_ESTIMATED, {"value": sizes[name], **names}))
    return Context(model, dataset, data.overrides, outputs, sizes, treatment, started, at), notes


def _columns(dataset: Dataset, name: str) -> list[Array]:
    """The signal in every log that has a sample of it."""
    found = [r.data[name] for r in dataset.records if isinstance(r.data, Record) and name in r.data.names]
    return [column for column in found if np.isfinite(column).any()]


def _floors(context: Context) -> dict[Channel, NoiseFloor]:
    dataset, settings = context.dataset, context.treatment.noise
    return {
        (dataset.name, name): noise_floor(dataset.signal(name), _columns(dataset, name), settings)
        for name in context.noise
    }


def _observations(context: Context) -> tuple[list[Observation], list[Note], bool]:
    """Observations of a data set (stepped sines of one test are one), notes, and whether tables have a covariance.

    Raises:
        BadInput: a record cannot be compared; the message names record or signal.
    """
    tables: list[ResponseTable] = []
    logs: list[tuple[int, MeasuredRecord]] = []
    swings, index = [], -1
    notes: list[Note] = []
    for record in context.dataset.records:
        index += isinstance(record.data, Record)
        if isinstance(record.data, FrequencyResponse):
            if record.data.test.output in context.outputs:
                tables.append(response_table(context, record, record.data))
        elif not context.columns(record)[1]:
            notes.append(Note(NoteCode.NOT_COMPARED, {"record": record.source}))
        elif record.kind == STEPPED_SINE.name:
            swings.append(swing(context, record, index))
        else:
            logs.append((index, record))
    early = []
    if context.treatment.steady == "transient":
        late = unsettled([one.log for one in swings])
        early = [one for one, is_late in zip(swings, late, strict=True) if is_late]
        swings = [one for one, is_late in zip(swings, late, strict=True) if not is_late]
    logs += [(one.log.index, one.record) for one in early]
    if early:
        notes.append(Note(NoteCode.NOT_SETTLED, {"record": early[0].record.source, "others": len(early) - 1}))
    stated = all(table.specified for table in tables)
    if not stated:
        sizes = {"magnitude": UNSPECIFIED_DB, "phase": UNSPECIFIED_DEG}
        notes.append(Note(NoteCode.NOISE_ASSUMED, {"dataset": context.dataset.name, **sizes}))
    return [*tables, *time_logs(context, logs), *stepped_sines(context, swings)], notes, stated


def _started(model: Model, space: ParameterSpace) -> set[str | None]:
    """Records with an initial state among the free parameters; None is among them if it is free in all records."""
    states = model.abilities.states
    return {record for name, record in zip(space.variables, space.records, strict=True) if name in states}


def _check_records(space: ParameterSpace, observations: Sequence[Observation]) -> None:
    known = {run.record for one in observations for run in one.runs}
    for record in space.records:
        if record is not None and record not in known:
            raise BadInput(f"fit: no compared record is called {record!r}; there are {', '.join(sorted(known))}")
