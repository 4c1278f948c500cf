"""The stepped sines of one test: their harmonics compared with those of the model's periodic orbits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.accuracy import frequency_deviations
from pysim.identify.greybox.context import Context
from pysim.identify.greybox.harmonics import interpolation
from pysim.identify.greybox.nuisance import Nuisance, NuisanceKind, SensorErrors, gains
from pysim.identify.greybox.observation import Measure, Run, Simulated
from pysim.identify.greybox.response import LogResponse, beside_measured, log_response, thesis_deviation
from pysim.identify.greybox.settings import SteadySettings
from pysim.identify.greybox.sine_log import Sine, SineLog, sine_log, steady_sine
from pysim.identify.greybox.steady_run import steady_run
from pysim.identify.greybox.time_log import kept_columns
from pysim.identify.greybox.treatment import SinePlan
from pysim.identify.logged import logged_wave
from pysim.types import (
    BadInput,
    FrequencyResponse,
    Harmonics,
    MeasuredRecord,
    Record,
    RecordFit,
    ResponseComparison,
    ResponseFit,
    Signal,
    SineTest,
)
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]

_SETTINGS = SteadySettings()


@dataclass(frozen=True)
class SteppedSines:
    """Logs at one offset and amplitude.

    Args:
        dataset, use: of the logs.
        logs: by increasing frequency.
        runs: one per log, recorded at equidistant points over one period.
        reference: index of the log whose gain counts as 0 dB; None: absolute gains.
    """

    dataset: str
    use: str
    logs: tuple[SineLog, ...]
    runs: tuple[Run, ...]
    reference: int | None
    kind: str = STEPPED_SINE.name
    domain: str = "frequency"

    @property
    def sources(self) -> tuple[str, ...]:
        """Sources of the logs."""
        return tuple(log.source for log in self.logs)

    def with_runs(self, runs: Sequence[Run]) -> SteppedSines:
        """See Observation."""
        return replace(self, runs=tuple(runs))

    def held_out(self) -> SteppedSines:
        """See Observation."""
        return replace(self, use="validate")

    def head(self, share: float) -> SteppedSines:
        """See Observation."""
        return self

    @property
    def channels(self) -> tuple[str, ...]:
        """The compared columns."""
        return self.logs[0].measured.names

    @property
    def noise(self) -> tuple[float, ...]:
        """(n_y,) standard deviation of each column's noise, in its unit."""
        return self.logs[0].noise

    @property
    def channel_of_row(self) -> NDArray[np.intp]:
        """Index of each row's signal; rows are ordered by log, then harmonic, then signal."""
        return np.tile(np.arange(len(self.channels)), sum(log.harmonics.shape[0] for log in self.logs))

    @property
    def samples(self) -> Array:
        """Number of compared samples of all logs, per signal."""
        return np.full(len(self.channels), float(sum(log.measured.time.size for log in self.logs)))

    @cached_property
    def rest(self) -> Array:
        """Sum of squares of the samples less mean and harmonics, per signal."""
        return np.sum([log.measured.time.size * log.scatter**2 for log in self.logs], axis=0)

    def residual(self, answers: Sequence[Simulated], measure: Measure = Measure.SIGNAL) -> Array:
        """Differences of `SineLog.harmonics`; or of magnitudes and phases (thesis Eq. 2.11 to 2.13 and 2.25)."""
        if measure is Measure.THESIS:
            return np.concatenate([self._deviation(answers, j) for j in range(len(self.channels))])
        parts: dict[int, Array] = {}
        for places, onto, harmonics in self._stacks:
            values = np.array([answers[i].values for i in places])
            slopes = np.array([answers[i].slopes for i in places])
            n, points, n_y, n_x = slopes.shape
            table = np.empty((*harmonics.shape, 1 + n_x))
            np.subtract(harmonics, onto @ values, out=table[..., 0])
            flat = onto @ slopes.reshape(n, points, n_y * n_x)
            np.negative(flat.reshape(*harmonics.shape, n_x), out=table[..., 1:])
            parts |= zip(places, table.reshape(n, -1, 1 + n_x), strict=True)
        return np.concatenate([parts[i] for i in range(len(self.logs))])

    @cached_property
    def _stacks(self) -> list[tuple[list[int], Array, Array]]:
        """Logs grouped by number of harmonics: indices, `onto` (n, n_h, points) and `harmonics` (n, n_h, n_y)."""
        groups: dict[tuple[int, ...], list[int]] = {}
        for i, log in enumerate(self.logs):
            groups.setdefault(log.onto.shape, []).append(i)
        return [
            (places, np.array([self.logs[i].onto for i in places]), np.array([self.logs[i].harmonics for i in places]))
            for places in groups.values()
        ]

    def _deviation(self, answers: Sequence[Simulated], column: int) -> Array:
        measured = np.array([self.measured_gains[i, column] for i in range(len(self.logs))])
        return thesis_deviation(measured, self.response(answers, column), self.reference)

    def nuisance_columns(self, answers: Sequence[Simulated], nuisances: Sequence[Nuisance]) -> Array:
        """See Observation. A drift counts as constant over a steady sine, with its value at the middle."""
        parts = []
        for log, answer in zip(self.logs, answers, strict=True):
            columns = np.tensordot(log.onto, self._by_error(log, answer, nuisances), 1)
            parts.append(columns.reshape(-1, len(nuisances)))
        return np.concatenate(parts)

    def sensed(self, answers: Sequence[Simulated], errors: SensorErrors) -> tuple[Simulated, ...]:
        """See Observation."""
        gain, sizes = gains(errors, self.dataset, self.channels)[:, None], np.array([size for _, size in errors])
        kinds = [one for one, _ in errors]
        return tuple(
            Simulated(answer.values + self._by_error(log, answer, kinds) @ sizes, answer.slopes * gain)
            for log, answer in zip(self.logs, answers, strict=True)
        )

    def _by_error(self, log: SineLog, answer: Simulated, nuisances: Sequence[Nuisance]) -> Array:
        """What one unit of each sensor error adds to a period of the orbit, (points, n_y, k)."""
        found = np.zeros((*answer.values.shape, len(nuisances)))
        for k, one in enumerate(nuisances):
            if one.dataset == self.dataset and one.signal in self.channels:
                j = self.channels.index(one.signal)
                found[:, j, k] = _effect(one.kind, answer.values[:, j], log)
        return found

    def pieces(self, residual: Array, shortest: float) -> NDArray[np.intp]:
        """Each log is one piece, since its harmonics are not independent."""
        return np.repeat(np.arange(len(self.logs)), [log.harmonics.size for log in self.logs])

    @cached_property
    def measured_gains(self) -> NDArray[np.complex128]:
        """Measured ln(gain) + j phase of every log and signal, (n_f, n_y)."""
        return np.array([np.log(log.coefficients(log.harmonics)[1] / log.sine.amplitude) for log in self.logs])

    def response(self, answers: Sequence[Simulated], column: int) -> LogResponse:
        """The model's frequency response of one signal."""
        rows = []
        for log, answer in zip(self.logs, answers, strict=True):
            onto = log.fundamental() @ log.onto
            rows.append(
                log_response(onto @ answer.values[:, column], onto @ answer.slopes[:, column], log.sine.amplitude)
            )
        return LogResponse(np.array([row[0] for row in rows]), np.array([row[1] for row in rows]))

    def beside(self, answers: Sequence[Simulated]) -> tuple[tuple[RecordFit, ...], tuple[ResponseFit, ...]]:
        """Every log, and the frequency response of all logs, with the criteria of thesis Table 1.3."""
        records = tuple(self._record(log, answer) for log, answer in zip(self.logs, answers, strict=True))
        return records, tuple(self._response(answers, j) for j in range(len(self.channels)))

    def _record(self, log: SineLog, answer: Simulated) -> RecordFit:
        values = interpolation(log.phase, log.points) @ answer.values
        measured, model = log.coefficients(log.harmonics), log.coefficients(log.onto @ answer.values)
        harmonics = tuple(
            Harmonics(name, log.sine.frequency, measured[:, j], model[:, j], log.noise[j] * log.deviations())
            for j, name in enumerate(log.measured.names)
        )
        beside = replace(log.measured, values=values, origin="simulated")
        return RecordFit(
            self.dataset, log.source, self.kind, self.use, log.measured, beside, log.noise, {}, harmonics,
            index=log.index,
        )  # fmt: skip

    def _response(self, answers: Sequence[Simulated], column: int) -> ResponseFit:
        first = self.logs[0]
        frequency = np.array([log.sine.frequency for log in self.logs])
        test = SineTest(first.sine.offset, first.sine.amplitude, "command", self.channels[column])
        logarithm = self.measured_gains[:, column]
        measured = FrequencyResponse(
            frequency, np.exp(logarithm.real), np.unwrap(logarithm.imag), test, "measured, stepped sines"
        )
        model = beside_measured(measured, self.response(answers, column))
        reference = None if self.reference is None else float(frequency[self.reference])
        deviations = frequency_deviations(model, measured, reference_hz=reference)
        return ResponseFit(self.dataset, self.use, ResponseComparison(measured, model, deviations))


def _effect(kind: NuisanceKind, orbit: Array, log: SineLog) -> Array:
    """What one unit of a sensor error adds to a period of an orbit (points,)."""
    if kind is NuisanceKind.GAIN:
        return orbit
    if kind is NuisanceKind.OFFSET:
        return np.ones_like(orbit)
    if kind is NuisanceKind.DRIFT:
        return np.full_like(orbit, log.middle or 0.0)
    order = np.fft.rfftfreq(orbit.size, 1 / orbit.size)
    return -np.fft.irfft(2j * np.pi * log.sine.frequency * order * np.fft.rfft(orbit), orbit.size)


@dataclass(frozen=True, eq=False)
class Swing:
    """One stepped sine: its record, the compared periods, and the model's run."""

    record: MeasuredRecord
    log: SineLog
    run: Run


def swing(context: Context, record: MeasuredRecord, index: int) -> Swing:
    """The stepped sine of one record, with its index among the logs; other commands are taken as constant.

    Samples where a compared column has no number are left out.
    """
    columns, outputs = context.columns(record)
    data = record.data
    assert isinstance(data, Record)
    swinging = max(columns, key=lambda column: float(np.std(data[column])))  # the others are constant
    sine = steady_sine(logged_wave(record, swinging))
    noise = tuple(context.noise[name] for name in outputs)
    whole = kept_columns(data, outputs).whole_rows()
    if whole.time.size < 2:
        raise BadInput(f"{record.source}: {', '.join(outputs)} have no samples at the same time; compare one of them")
    log = _settled(record.source, whole, sine, noise, context.treatment.sine, index)
    others = {c: Signal.constant(float(np.mean(data[c]))) for c in columns if c != swinging}
    settle = float(log.measured.time[0]) - sine.onset
    middle = None if record.begin is None else record.begin + float(np.mean(log.measured.time) - data.time[0])
    run = steady_run(context, record.source, swinging, sine, outputs, others, settle, middle)
    turned = float(sine.at(data.time[:1])[0]) / (2 * np.pi) % 1.0  # of a period, at the log's first sample
    turned += np.ceil(context.settling * sine.frequency)
    run = replace(run, begins=float(run.experiment.times[0]) + turned / sine.frequency)
    return Swing(record, replace(log, middle=middle), run)


def _settled(source: str, data: Record, sine: Sine, noise: tuple[float, ...], plan: SinePlan, index: int) -> SineLog:
    """The whole periods after settling. If the plan has no settling time, periods are left out until the first compared
    one agrees with the later ones, but at most half of them.
    """
    log = sine_log(source, data, sine, noise, plan, index=index)
    if plan.settle_time is not None:
        return log
    most = plan.settle_periods + log.periods // 2
    while log.unlike > _SETTINGS.unlike and plan.settle_periods < most:
        plan = replace(plan, settle_periods=min(plan.settle_periods + max(log.periods // 10, 1), most))
        log = sine_log(source, data, sine, noise, plan, index=index)
    return log


def unsettled(logs: Sequence[SineLog]) -> list[bool]:
    """For each log of a data set, whether the plant had not settled when its compared periods began.

    If one log exceeds the limit, a lower limit applies to all, since they are likely to have the same cause."""
    away = [log.unlike for log in logs]
    limit = _SETTINGS.also if max(away, default=0.0) > _SETTINGS.unlike else _SETTINGS.unlike
    return [z > limit for z in away]


def stepped_sines(context: Context, swings: Sequence[Swing]) -> list[SteppedSines]:
    """Group the stepped sines of a data set by test: same use, offset, amplitude and columns."""
    tests: dict[tuple[object, ...], list[Swing]] = {}
    for one in swings:
        record = one.record
        tests.setdefault((record.use, record.offset, record.amplitude, *context.columns(record)), []).append(one)
    return [_test(context, group) for group in tests.values()]


def _test(context: Context, group: Sequence[Swing]) -> SteppedSines:
    swings = sorted(group, key=lambda one: one.log.sine.frequency)
    logs, runs = tuple(one.log for one in swings), tuple(one.run for one in swings)
    frequencies = np.array([log.sine.frequency for log in logs])
    near = np.flatnonzero(np.isclose(frequencies, context.treatment.reference_hz or -1.0, rtol=1e-3))
    return SteppedSines(context.dataset.name, group[0].record.use, logs, runs, int(near[0]) if near.size else None)
