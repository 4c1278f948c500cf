"""From the records of a data set to what the model is compared with."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.command import from_rest
from pysim.identify.greybox.log_target import LogTarget
from pysim.identify.greybox.noise import signal_noise
from pysim.identify.greybox.sine_log import Sine, SineLog, sine_log, steady_sine
from pysim.identify.greybox.sine_target import SineTarget
from pysim.identify.greybox.table_target import TableTarget
from pysim.identify.greybox.target import Run, Target
from pysim.identify.greybox.treatment import Measurements, Treatment
from pysim.identify.greybox.unsettled import unsettled, unsettled_note
from pysim.identify.logged import logged_command, logged_wave
from pysim.simulate import Periodic, Rodas, simulate
from pysim.types import (
    BadInput,
    Dataset,
    Experiment,
    FrequencyResponse,
    MeasuredRecord,
    MeasuredSignal,
    Model,
    Outcome,
    Record,
    Signal,
    SineTest,
)
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]

# s for which a model is watched, and the share of its values that one at rest may move by.
_WATCHED, _STILL = 1.0, 1e-9
# s of a sine after which a model that has not settled never will, and the share of a swing by which two periods differ
# that are the same.
_PATIENCE, _REPEATED = 60.0, 5e-4


@dataclass(frozen=True)
class _Setting:
    """Everything that making one data set's targets needs."""

    model: Model
    dataset: Dataset
    overrides: Mapping[str, float]
    outputs: tuple[str, ...]
    noise: Mapping[str, float]
    treatment: Treatment
    started: Collection[str | None]

    def columns(self, record: MeasuredRecord) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Commands and compared outputs of a log."""
        assert isinstance(record.data, Record)
        names = record.data.names
        commands = tuple(n for n in names if self.dataset.signal(n).role == "input")
        outputs = tuple(n for n in names if n in self.outputs)
        if not commands:
            raise BadInput(f"{record.source}: no column is an input; name the command in the data set")
        return commands, outputs

    def variable(self, column: str) -> str:
        """The model's name of a column, once both have the same unit."""
        return self.model.measured(self.dataset.signal(column), f"data set {self.dataset.name!r}").name

    def experiment(
        self, times: Array, outputs: tuple[str, ...], commands: Mapping[str, Signal], start: float
    ) -> Experiment:
        """A run of the model, everything by the model's names."""
        names = tuple(self.variable(column) for column in outputs)
        return Experiment(times, names, commands, self.overrides, start, rates=self.model.rate_inputs(commands))

    @cached_property
    def rests(self) -> bool:
        """Whether the model stands still from its start on, its inputs at theirs.

        Then it is to stand still too where a parameter or an effect moves its equilibrium, as the plant did before the
        log began: it is given the time to come there.
        """
        names = tuple(self.variable(column) for column in self.outputs)
        still = Experiment(np.linspace(0.0, _WATCHED, 11), names, overrides=self.overrides)
        record = simulate(self.model, still, solver=Rodas(), check=False)
        if record.outcome is not Outcome.DONE:
            return False
        return bool(np.all(np.ptp(record.values, axis=0) <= _STILL * np.abs(record.values).max(axis=0)))


def build_targets(
    model: Model, data: Measurements, treatment: Treatment, started: Collection[str | None] = ()
) -> tuple[list[Target], list[str]]:
    """Targets in the order of the records, the stepped sines of a test together, and notes on what was assumed.

    Args:
        started: records with free start values, None for all: their model does not come to rest first.
    Raises:
        BadInput: what cannot be compared, naming record or signal.
    """
    dataset = data.dataset
    outputs = _compared(dataset, data.outputs)
    noise, notes = _noise(dataset, outputs, data.noise)
    setting = _Setting(model, dataset, data.overrides, outputs, noise, treatment, started)
    targets: list[Target] = []
    sines: dict[tuple[object, ...], list[_Swing]] = {}
    index = -1  # of the log
    for record in dataset.records:
        index += isinstance(record.data, Record)
        if isinstance(record.data, FrequencyResponse):
            if record.data.test.output in outputs:
                targets.append(_table(setting, record, record.data))
        elif not setting.columns(record)[1]:
            notes.append(f"{record.source}: no column of it is compared")
        elif record.kind == STEPPED_SINE.name:
            test = (record.use, record.offset, record.amplitude, *setting.columns(record))
            sines.setdefault(test, []).append(_swing(setting, record, record.data, index))
        else:
            targets.append(_log(setting, record, record.data, index))
    early = _unsettled(setting, [one for group in sines.values() for one in group])
    for group in sines.values():
        steady = [one for one in group if one not in early]
        targets += [_sines(setting, steady)] if steady else []
    targets += [_log(setting, one.record, one.data, one.log.index) for one in early]
    notes += unsettled_note([one.record.source for one in early])
    if any(isinstance(target, TableTarget) and not target.told for target in targets):
        notes.append("tables without covariance: 20/90 dB and 1 degree are taken as standard deviations (Eq. 2.25)")
    return targets, notes


def _unsettled(setting: _Setting, sines: list[_Swing]) -> list[_Swing]:
    """Those that the plant did not follow steadily yet; none where the model is not run as the bench was."""
    if setting.treatment.steady != "transient":
        return []
    return [one for one, early in zip(sines, unsettled([one.log for one in sines]), strict=True) if early]


def _compared(dataset: Dataset, wanted: tuple[str, ...] | None) -> tuple[str, ...]:
    measured = tuple(signal.name for signal in dataset.signals if signal.role == "output")
    for name in wanted or ():
        if name not in measured:
            raise BadInput(f"data set {dataset.name!r} measures no output {name!r}; it has {', '.join(measured)}")
    return measured if wanted is None else tuple(wanted)


def _noise(
    dataset: Dataset, outputs: tuple[str, ...], given: Mapping[str, float]
) -> tuple[dict[str, float], list[str]]:
    """Per column that stands in a log, its noise."""
    for name in given:
        dataset.signal(name)
    sizes, notes = {}, []
    for name in outputs:
        logs = [r.data[name] for r in dataset.records if isinstance(r.data, Record) and name in r.data.names]
        if logs:
            sizes[name], note = signal_noise(dataset.signal(name), logs, given)
            notes += [note] if note else []
    return sizes, notes


def _cut(data: Record, names: tuple[str, ...]) -> Record:
    places = [data.names.index(name) for name in names]
    units = tuple(data.units[i] for i in places)
    return Record(data.time, data.values[:, places], names, units, origin=data.origin)


def _full_scale(signal: MeasuredSignal, values: Array) -> float:
    """What counts as 100 percent: 100 %, 1, else the largest measured size."""
    return {"%": 100.0, "1": 1.0}.get(signal.unit) or float(np.max(np.abs(values))) or 1.0


def _log(setting: _Setting, record: MeasuredRecord, data: Record, index: int) -> LogTarget:
    columns, outputs = setting.columns(record)
    measured, start, rest = _cut(data, outputs), float(data.time[0]), setting.treatment.rest
    commands, begin = {}, start
    for column in columns:
        name, signal = setting.variable(column), logged_command(record, column, setting.dataset.signal(column).hold)
        if rest is not None:
            signal, first = from_rest(signal, start, float(setting.model[name].start or 0.0), rest)
            begin = min(begin, first)
        commands[name] = signal
    free = record.source in setting.started or None in setting.started
    if rest is not None and begin == start and not free and setting.rests:
        begin = start - rest.hold
    experiment = setting.experiment(data.time, outputs, commands, begin)
    return LogTarget(
        dataset=setting.dataset.name,
        source=record.source,
        kind=record.kind,
        use=record.use,
        measured=measured,
        noise=tuple(setting.noise[name] for name in outputs),
        full_scale=tuple(_full_scale(setting.dataset.signal(n), measured[n]) for n in outputs),
        run=Run(record.source, experiment),
        index=index,
    )


@dataclass(frozen=True, eq=False)
class _Swing:
    """One stepped sine: its record, what of it is compared, and the model's run for that."""

    record: MeasuredRecord
    data: Record
    log: SineLog
    run: Run


def _swing(setting: _Setting, record: MeasuredRecord, data: Record, index: int) -> _Swing:
    columns, outputs = setting.columns(record)
    swinging = max(columns, key=lambda column: float(np.std(data[column])))  # the others stand still
    sine = steady_sine(logged_wave(record, swinging))
    noise = tuple(setting.noise[name] for name in outputs)
    plan = setting.treatment.sine
    log = sine_log(record.source, _cut(data, outputs), sine, noise, plan, index=index)
    others = {c: Signal.constant(float(np.mean(data[c]))) for c in columns if c != swinging}
    return _Swing(
        record, data, log, _steady_run(setting, record.source, swinging, sine, outputs, others, plan.settle_time)
    )


def _sines(setting: _Setting, group: list[_Swing]) -> SineTarget:
    swings = sorted(group, key=lambda one: one.log.sine.frequency)
    logs, runs = tuple(one.log for one in swings), tuple(one.run for one in swings)
    frequencies = np.array([log.sine.frequency for log in logs])
    near = np.flatnonzero(np.isclose(frequencies, setting.treatment.reference_hz or -1.0, rtol=1e-3))
    return SineTarget(setting.dataset.name, group[0].record.use, logs, runs, int(near[0]) if near.size else None)


def _table(setting: _Setting, record: MeasuredRecord, response: FrequencyResponse) -> TableTarget:
    test, reference_hz = response.test, setting.treatment.reference_hz
    near = np.flatnonzero(np.isclose(response.frequency, reference_hz or -1.0, rtol=1e-6))
    if reference_hz is not None and not near.size:
        raise BadInput(
            f"{record.source}: magnitudes relative to {reference_hz:g} Hz need that frequency; measured are "
            f"{response.frequency[0]:g} to {response.frequency[-1]:g} Hz: take one of these as the reference, or none"
        )
    sines = [Sine(test.offset, test.amplitude, f, 0.0, 0.0, math.inf) for f in response.frequency.tolist()]
    runs = tuple(_settled_run(setting, record.source, test, sine) for sine in sines)
    return TableTarget(
        setting.dataset.name, record.source, record.use, response, runs, int(near[0]) if near.size else None
    )


def _settled_run(setting: _Setting, source: str, test: SineTest, sine: Sine) -> Run:
    """One for a table, which tells of a steady state and not how long the bench waited for it.

    A transient lasts until the model repeats itself at its own parameters, and twice as long where that is later than
    the plan says, since others may be slower. Where it never does, the plan counts.
    """

    def run(settle: float) -> Run:
        return _steady_run(setting, source, test.input, sine, (test.output,), {}, settle)

    planned = setting.treatment.sine.settle_time
    if setting.treatment.steady == "transient":
        settle = planned
        while settle < _PATIENCE:
            if _repeats(setting.model, run(settle).experiment, 1 / sine.frequency):
                return run(settle if settle == planned else 2 * settle)
            settle = 2 * max(settle, 1 / sine.frequency)
    return run(planned)


def _repeats(model: Model, experiment: Experiment, period: float) -> bool:
    """Whether the period after the recorded one is the same."""
    times = np.concatenate([experiment.times, experiment.times + period])
    record = simulate(model, replace(experiment, times=times), solver=Rodas(), check=False)
    if record.outcome is not Outcome.DONE:
        return False
    first, second = np.split(record.values, 2)
    return bool(np.max(np.abs(second - first)) <= _REPEATED * np.ptp(second))


def _steady_run(
    setting: _Setting,
    source: str,
    column: str,
    sine: Sine,
    outputs: tuple[str, ...],
    others: Mapping[str, Signal],
    settle: float,
) -> Run:
    """The orbit of a stepped sine, and the same test as a transient, both recorded over one period from phase zero.

    Args:
        settle: s of the sine that the transient has for itself at least.
    """
    plan, period = setting.treatment.sine, 1 / sine.frequency
    name = setting.variable(column)
    swing = Signal(
        np.zeros(1),
        np.array([[sine.offset, 0.0, 0.0, 0.0]]),
        np.array([[[sine.amplitude, 0.0, 2 * np.pi * sine.frequency, 0.0]]]),
    )
    rest, inputs = setting.treatment.rest, {setting.variable(c): signal for c, signal in others.items()}
    approached, start = swing, 0.0
    if rest is not None:
        approached, start = from_rest(swing, 0.0, float(setting.model[name].start or 0.0), rest)
    settling = max(plan.settle_periods, int(np.ceil(settle / period - 1e-9)))
    times = (settling + np.arange(plan.points) / plan.points) * period
    transient = setting.experiment(times, outputs, {**inputs, name: approached}, start)
    if setting.treatment.steady == "transient":
        return Run(source, transient)
    commands = {**inputs, name: swing}
    orbit = Periodic(
        period=period,
        points=plan.points,
        record=transient.record,
        inputs=commands,
        overrides=setting.overrides,
        rates=setting.model.rate_inputs(commands),
    )
    return Run(source, transient, orbit)
