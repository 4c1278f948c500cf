"""A log over time, compared sample by sample with the model, which is driven by the logged command."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.accuracy import time_deviations
from pysim.identify.greybox.context import Context
from pysim.identify.greybox.effective_size import independent_pieces, piece_of_sample
from pysim.identify.greybox.nuisance import Nuisance, NuisanceKind, SensorErrors, gains
from pysim.identify.greybox.observation import Measure, Run, Simulated
from pysim.identify.logged import logged_command
from pysim.simulate import Rodas, simulate_many
from pysim.types import Experiment, MeasuredRecord, MeasuredSignal, Outcome, Record, RecordFit, ResponseFit, Signal

Array = NDArray[np.float64]

_WATCHED = 1000  # samples of a log, at most, from which the range of the model's states is taken


@dataclass(frozen=True)
class TimeLog:
    """Every sample of every compared signal.

    A cell without a number was not measured: it has no row. For white noise, all that follows is exact. The
    autocorrelation of coloured noise is that from one sample that is there to the next.

    Args:
        dataset, source, kind, use: of the log.
        measured: the compared columns; not-a-number where nothing was measured.
        noise: (n_y,) standard deviations, in the columns' units.
        full_scale: (n_y,) value that counts as 100 percent, in the columns' units.
        run: the model's run, recorded at the log's times.
        index: index of the log, as in `RecordFit`.
        begin: time of the first sample in s on the common clock of all records; None if not known.
    """

    dataset: str
    source: str
    kind: str
    use: str
    measured: Record
    noise: tuple[float, ...]
    full_scale: tuple[float, ...]
    run: Run
    domain: str = "time"
    index: int = field(kw_only=True)
    begin: float | None = None

    @property
    def sources(self) -> tuple[str, ...]:
        """The one log."""
        return (self.source,)

    @property
    def runs(self) -> tuple[Run, ...]:
        """The one run."""
        return (self.run,)

    def with_runs(self, runs: Sequence[Run]) -> TimeLog:
        """See Observation."""
        return replace(self, run=runs[0])

    def held_out(self) -> TimeLog:
        """See Observation."""
        return replace(self, use="validate")

    def head(self, share: float) -> TimeLog:
        """See Observation. At least twice as many measured values as free initial states are kept."""
        if not self.run.begins_anywhere:
            return self
        found = np.cumsum(np.count_nonzero(self.there, axis=1))
        least = int(np.searchsorted(found, 2 * self.run.free.size)) + 1
        count = min(max(math.ceil(share * self.measured.time.size), least), self.measured.time.size)
        whole = self.measured
        measured = replace(whole, time=whole.time[:count], values=whole.values[:count])
        experiment = replace(self.run.experiment, times=self.run.experiment.times[:count])
        run = replace(self.run, experiment=experiment, measured=self.run.measured[:count])
        return replace(self, measured=measured, run=run)

    @property
    def channels(self) -> tuple[str, ...]:
        """The compared columns."""
        return self.measured.names

    @cached_property
    def there(self) -> NDArray[np.bool_]:
        """(n_t, n_y) whether a sample was measured."""
        return np.isfinite(self.measured.values)

    @cached_property
    def _rows(self) -> NDArray[np.bool_] | slice:
        """The rows of samples that were measured, among those of all."""
        return slice(None) if self.there.all() else self.there.ravel()

    @property
    def channel_of_row(self) -> NDArray[np.intp]:
        """Index of each row's signal; rows are ordered by sample, then signal."""
        return np.tile(np.arange(len(self.channels)), self.measured.time.size)[self._rows]

    @property
    def samples(self) -> Array:
        """Number of samples of each signal."""
        return np.count_nonzero(self.there, axis=0).astype(np.float64)

    @property
    def rest(self) -> Array:
        """Zeros, since `residual` has every sample."""
        return np.zeros(len(self.channels))

    def residual(self, answers: Sequence[Simulated], measure: Measure = Measure.SIGNAL) -> Array:
        """Rows per sample and signal; in percent of full scale for the thesis' measure (Eq. 2.24, Table 4.9)."""
        (answer,) = answers
        size = np.array(self.full_scale) / 100 if measure is Measure.THESIS else np.ones(len(self.channels))
        free = answer.by_initial.shape[2]
        n_x = answer.slopes.shape[2]
        rows = np.empty((*self.measured.values.shape, 1 + n_x + free))
        rows[:, :, 0] = (self.measured.values - answer.values) / size
        np.divide(answer.slopes, -size[:, None], out=rows[:, :, 1 : 1 + n_x])
        if free:
            np.divide(answer.by_initial, -size[:, None], out=rows[:, :, 1 + n_x :])
        return rows.reshape(-1, rows.shape[2])[self._rows]

    def nuisance_columns(self, answers: Sequence[Simulated], nuisances: Sequence[Nuisance]) -> Array:
        """See Observation. One unit of drift is 1 per s on the common clock, from zero at the clock's origin."""
        return self._by_error(answers, nuisances)[self._rows]

    def _by_error(self, answers: Sequence[Simulated], nuisances: Sequence[Nuisance]) -> Array:
        """The same with a row for samples that were not measured, too."""
        (answer,) = answers
        time, columns = self.measured.time, np.zeros((*self.measured.values.shape, len(nuisances)))
        for k, one in enumerate(nuisances):
            if one.dataset != self.dataset or one.signal not in self.channels:
                continue
            j = self.channels.index(one.signal)
            if one.kind is NuisanceKind.GAIN:
                columns[:, j, k] = answer.values[:, j]
            elif one.kind is NuisanceKind.OFFSET:
                columns[:, j, k] = 1.0
            elif one.kind is NuisanceKind.DELAY:
                columns[:, j, k] = -np.gradient(answer.values[:, j], time)
            else:
                columns[:, j, k] = (self.begin or 0.0) + time - time[0]
        return columns.reshape(self.measured.values.size, len(nuisances))

    def sensed(self, answers: Sequence[Simulated], errors: SensorErrors) -> tuple[Simulated, ...]:
        """See Observation."""
        (answer,) = answers
        moved = self._by_error(answers, [one for one, _ in errors]) @ np.array([size for _, size in errors])
        gain = gains(errors, self.dataset, self.channels)[:, None]
        values = answer.values + moved.reshape(answer.values.shape)
        return (
            Simulated(
                values, answer.slopes * gain, answer.by_initial * gain if answer.by_initial.size else answer.by_initial
            ),
        )

    def pieces(self, residual: Array, shortest: float) -> NDArray[np.intp]:
        """Contiguous stretches of samples of equal length, set by the channel with the largest lambda."""
        channel = self.channel_of_row
        count = independent_pieces([residual[channel == j] for j in range(len(self.channels))], shortest)
        return np.repeat(piece_of_sample(self.there, count), len(self.channels))[self._rows]

    def beside(self, answers: Sequence[Simulated]) -> tuple[tuple[RecordFit, ...], tuple[ResponseFit, ...]]:
        """The log with the criteria of thesis Table 1.4."""
        (answer,) = answers
        deviations = {
            name: time_deviations(answer.values[:, j], self.measured.values[:, j], self.full_scale[j])
            for j, name in enumerate(self.channels)
        }
        model = replace(self.measured, values=answer.values, origin="simulated")
        fit = RecordFit(
            self.dataset, self.source, self.kind, self.use, self.measured, model, self.noise, deviations,
            index=self.index,
        )  # fmt: skip
        return (fit,), ()


def time_logs(context: Context, records: Sequence[tuple[int, MeasuredRecord]]) -> list[TimeLog]:
    """The observations of logs over time, given as index and record, with the priors of their initial states."""
    known = [_initial(context, record) for _, record in records]
    logs = [_log(context, record, index, one) for (index, record), one in zip(records, known, strict=True)]
    free = [i for i, one in enumerate(known) if one not in ("model", "rest")]
    ranges = _state_ranges(context, [logs[i].run.experiment for i in free])
    states = [context.model[name] for name in context.model.abilities.states]
    between = [math.inf if s.min is None or s.max is None else (s.max - s.min) / 2 for s in states]  # their limits
    for i, spread in zip(free, ranges, strict=True):
        unknown = known[i] == "estimate"  # also of states that no input moves, such as a mass that is released
        sd = np.array(between) if unknown else context.treatment.noise.initial * spread
        run = replace(logs[i].run, initial=sd, begins_anywhere=unknown and bool(states))
        logs[i] = replace(logs[i], run=run)
    return logs


def _initial(context: Context, record: MeasuredRecord) -> str:
    """What is known of the plant's state at a log's first sample; "model" if the model's start values hold."""
    if record.initial == "model" or record.source in context.started or None in context.started:
        return "model"
    usual = context.treatment.initial
    return record.initial or ("estimate" if usual == "near rest" and context.integrates else usual)


def _log(context: Context, record: MeasuredRecord, index: int, initial: str) -> TimeLog:
    columns, outputs = context.columns(record)
    data = record.data
    assert isinstance(data, Record)
    measured, start = kept_columns(data, outputs), float(data.time[0])
    rest = None if initial == "model" or (initial == "estimate" and context.integrates) else context.treatment.rest
    later = 0.0 if record.begin is None else record.begin - start
    commands, begin = {}, start
    own_start = context.first_value
    for column in columns:
        name, signal = context.variable(column), logged_command(record, column, context.dataset.signal(column).hold)
        if rest is not None and (context.still or signal.value(np.array(start)) != own_start(name)):
            signal, first = from_rest(signal, start, own_start(name), rest.times(context.settling))
            begin = min(begin, first)
        commands[name] = signal
    return TimeLog(
        dataset=context.dataset.name,
        source=record.source,
        kind=record.kind,
        use=record.use,
        measured=measured,
        noise=tuple(context.noise[name] for name in outputs),
        full_scale=tuple(full_scale(context.dataset.signal(n), measured[n]) for n in outputs),
        run=Run(
            record.source,
            context.experiment(data.time, outputs, commands, begin, later),
            begins=start + later,
            measured=measured.values,
        ),
        index=index,
        begin=record.begin,
    )


def _state_ranges(context: Context, experiments: Sequence[Experiment]) -> list[Array]:
    """Range of each state over each log (n_x,) where the search begins; nominal sizes if it cannot be simulated."""
    states = context.model.abilities.states
    if not states or not experiments:
        return [np.zeros(0)] * len(experiments)
    looks = [
        replace(one.override(**context.at), record=states, times=one.times[:: -(-one.times.size // _WATCHED)])
        for one in experiments
    ]
    found = []
    for record in simulate_many(context.model, looks, solver=Rodas(1e-3, 1e-3)):
        done = record.outcome is Outcome.DONE and bool(np.isfinite(record.values).all())
        sizes = np.array([abs(context.model[name].nominal or 1.0) for name in states])
        found.append(np.ptp(record.values, axis=0) if done else sizes)
    return found


def kept_columns(data: Record, names: tuple[str, ...]) -> Record:
    """The log with these columns only."""
    places = [data.names.index(name) for name in names]
    units, values = tuple(data.units[i] for i in places), data.values[:, places].copy()
    values.setflags(write=False)  # so that Record does not copy a long log again
    return Record(data.time, values, names, units, origin=data.origin)


def full_scale(signal: MeasuredSignal, values: Array) -> float:
    """Value that counts as 100 percent: 100 for the unit %, 1 for the unit 1, else the largest measured magnitude."""
    return {"%": 100.0, "1": 1.0}.get(signal.unit) or float(np.nanmax(np.abs(values))) or 1.0


def from_rest(signal: Signal, start: float, first: float, times: tuple[float, float]) -> tuple[Signal, float]:
    """Put a ramp and a hold before a command, so that the model settles at the command's first value.

    Args:
        signal: the command; its part before `start` (s) is cut off.
        first: the input's start value in the model, in the signal's unit.
        times: durations in s of the ramp from `first` to the command's value at `start`, and of the hold there.
    Returns:
        the whole command, and the start of the run in s. There is no ramp if both values are equal.
    """
    tail, (ramp, hold) = _cut(signal, start), times
    if not (ramp > 0 and hold > 0):
        return tail, start
    value = float(signal.value(np.array(start)))
    if value == first:
        return tail, start - hold
    begin = start - hold - ramp
    starts = np.concatenate([[begin, start - hold], tail.starts])
    cubics = np.vstack([[first, (value - first) / ramp, 0.0, 0.0], [value, 0.0, 0.0, 0.0], tail.cubics])
    sines = np.concatenate([np.zeros((2, *tail.sines.shape[1:])), tail.sines])
    return Signal(starts, cubics, sines), begin


def _cut(signal: Signal, start: float) -> Signal:
    """The signal from `start` on."""
    k = max(int(np.searchsorted(signal.starts, start, side="right")) - 1, 0)
    s = start - signal.starts[k]
    if s <= 0:
        return signal
    c0, c1, c2, c3 = signal.cubics[k]
    cubics, sines, starts = signal.cubics[k:].copy(), signal.sines[k:].copy(), signal.starts[k:].copy()
    starts[0] = start
    cubics[0] = c0 + s * (c1 + s * (c2 + s * c3)), c1 + s * (2 * c2 + 3 * s * c3), c2 + 3 * s * c3, c3
    omega, kappa = sines[0, :, 2].copy(), sines[0, :, 3]
    sines[0, :, 1] += s * (omega + 0.5 * kappa * s)
    sines[0, :, 2] += kappa * s
    return Signal(starts, cubics, sines)
