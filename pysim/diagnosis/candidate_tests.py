"""Tests that a bench could run next: stepped sines and stochastic waves within the range of its earlier commands."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.settings import TestSettings
from pysim.excitation import Excitation, LeadIn, PiersonMoskowitz, Step, SteppedSineCommand, StochasticWave
from pysim.identify.greybox import SinePlan
from pysim.identify.greybox.harmonics import harmonic_count, regressors
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal, Model, PlannedTest, Record
from pysim.types.record_kind import STEPPED_SINE, STOCHASTIC

Array = NDArray[np.float64]

_SOON = 0.01  # s before the step whose response shows the settling time


@dataclass(frozen=True)
class CandidateTest:
    """A stepped sine, or a stochastic wave.

    Args:
        input: the commanded signal.
        offset: mean of the command, in the signal's unit.
        amplitude: of the sine, or the wave's significant height, in the signal's unit.
        frequency: of the sine, or of the peak of the wave's spectrum, Hz.
        periods: number of whole periods of a sine; 0 for a wave.
        length: duration of a wave, s.
        interval: s between samples.
        hold: s at the offset until the system has settled.
        seed: random seed of a wave.
    """

    input: MeasuredSignal
    offset: float
    amplitude: float
    frequency: float
    periods: int
    length: float
    interval: float
    hold: float
    seed: int

    @property
    def command(self) -> Excitation:
        """The command over time: rest, ramp, hold, then the sine or the wave."""
        lead = LeadIn(hold=self.hold)
        if self.periods:
            return SteppedSineCommand(self.offset, self.amplitude, self.frequency, self.periods, lead)
        spectrum = PiersonMoskowitz(self.amplitude, 1 / self.frequency)
        return StochasticWave(spectrum, self.length, self.seed, offset=self.offset, lead=lead)

    @property
    def log_from(self) -> float:
        """Time at which the log starts, s: with the sine, or with the hold before the wave."""
        return self.command.onset - (0.0 if self.periods else self.hold)

    @property
    def seconds(self) -> float:
        """Duration on the bench, s, lead-in included."""
        return self.command.end

    @property
    def samples(self) -> int:
        """Number of samples in the log."""
        return math.floor((self.command.end - self.log_from) / self.interval + 1e-6)

    def repeated(self, count: int) -> tuple[CandidateTest, ...]:
        """`count` times the test: a sine with more periods, or the wave several times."""
        return (replace(self, periods=count * self.periods),) if self.periods else (self,) * count

    def experiment(self, model: Model, record: tuple[str, ...], overrides: dict[str, float]) -> Experiment:
        """The test as a run of the model, recorded as it would be logged."""
        commands = {self.input.variable: self.command.signal()}
        times = np.array(self.log_from + self.interval * np.arange(self.samples))
        return Experiment(times, record, commands, overrides, rates=model.rate_inputs(commands))

    def counted(self, rows: Array) -> Array:
        """What a fit compares of rows (n_t, ...) of the log, once the lead-in has died away.

        Of a wave: the samples after the hold. Of a sine: mean and harmonics after the first period, orthonormalised.
        """
        if not self.periods:
            return rows[round(self.hold / self.interval) :]
        turns: Array = self.frequency * self.interval * np.arange(len(rows), dtype=np.float64)
        steady = turns > 1 - 1e-6
        count = harmonic_count(self.frequency, 1 / self.interval, SinePlan().harmonics)
        onto, _ = np.linalg.qr(regressors(2 * np.pi * turns[steady], count))
        return np.asarray(np.tensordot(onto.T, rows[steady], 1))

    def plan_rows(self, outputs: tuple[str, ...], name: str) -> list[str]:
        """Lines of the test's [[tests]] table in a plan.toml; `outputs` are the signals to log."""
        names = ", ".join(f'"{output}"' for output in outputs)
        kind = STEPPED_SINE.name if self.periods else STOCHASTIC.name
        rows = ["[[tests]]", f'kind = "{kind}"', f"outputs = [{names}]"]
        if self.periods:
            rows += [f"points = [[{self.offset:.6g}, {self.amplitude:.6g}]]", f"frequencies = [{self.frequency:.6g}]"]
            rows += [f"periods = {self.periods}", "least = 0.0", f"most = {2 * self.periods / self.frequency:.6g}"]
            return [*rows, f'folder = "{name}"', f"lead.hold = {self.hold:.6g}"]
        rows += [f'name = "{name}"', f"offset = {self.offset:.6g}", f"significant_height = {self.amplitude:.6g}"]
        rows += [f"peak_period = {1 / self.frequency:.9g}", f"length = {self.length:.6g}", f"seed = {self.seed}"]
        return [*rows, f"lead.hold = {self.hold:.6g}"]

    @property
    def planned(self) -> PlannedTest:
        """The test in the form of the answer."""
        sizes = self.frequency, self.amplitude, self.offset
        return PlannedTest(bool(self.periods), *sizes, self.input.unit, self.command.end - self.command.onset)


def candidate_tests(
    dataset: Dataset, settled: Callable[[Experiment], float], model: Model, settings: TestSettings
) -> tuple[CandidateTest, ...]:
    """Stepped sines and waves between the data set's lowest and highest command, no faster than its logs resolve.

    Args:
        settled: returns the time in s at which a run has settled, whatever the run is set to record.
        model: of the system.
    Raises:
        BadInput: no log over time, not exactly one command, or a command that never moves.
    """
    inputs = [signal for signal in dataset.signals if signal.role == "input"]
    logs = [record.data for record in dataset.logs() if isinstance(record.data, Record)]
    if len(inputs) != 1 or not logs:
        raise BadInput(f"data set {dataset.name!r}: a next test needs one command and a log over time to go by")
    (command,), columns = inputs, [log[inputs[0].name] for log in logs]
    low, high = min(float(c.min()) for c in columns), max(float(c.max()) for c in columns)
    if low == high:
        raise BadInput(f"data set {dataset.name!r}: a next test needs a command that moves in a log to go by")
    least = settings.side * max(-low, high)
    both_sides = low < -least and high > least
    count = settings.parts[both_sides]
    middle, half = (low + high) / 2, (high - low) / 2
    offsets = [middle + number * (half / count) for number in range(1 - count, count, 2)]
    interval = float(np.median([np.median(np.diff(log.time)) for log in logs]))
    farthest = max(offsets, key=lambda offset: (abs(offset), offset))
    step = Step(0.0, farthest, settings.wait * interval, lead=LeadIn(_SOON, 0.0, 0.0, 0.0))
    commands, times = {command.variable: step.signal()}, np.array(interval * np.arange(settings.wait))
    rest = settled(Experiment(times, ("time",), commands, rates=model.rate_inputs(commands))) - _SOON
    hold = math.ceil(10 * max(LeadIn().hold, rest) - 1e-9) / 10
    band = _band(dataset, logs, interval)
    rows = []
    for offset, frequency in itertools.product(offsets, np.geomspace(*band, settings.frequencies).tolist()):
        periods = max(settings.periods, math.ceil(settings.samples * interval * frequency - 1e-9))
        rows += [(offset, half / count * share, frequency, periods) for share in settings.amplitudes]
    peaks = [band[0] * (band[1] / band[0]) ** share for share in settings.peaks if both_sides]
    rows += [(middle, settings.height * half, peak, 0) for peak in peaks]
    more = settings.wave * interval, interval, hold, settings.seed
    return tuple(CandidateTest(command, o, a, float(f"{f:.3g}"), periods, *more) for o, a, f, periods in rows)


def _band(dataset: Dataset, logs: Sequence[Record], interval: float) -> tuple[float, float]:
    """Lowest and highest frequency, Hz: of the stepped sines in the data set, else what its logs resolve."""
    run = {record.frequency for record in dataset.logs() if record.frequency is not None}
    if len(run) > 1:
        return min(run), max(run)
    return 5 / max(float(log.time[-1] - log.time[0]) for log in logs), 1 / (8 * interval)


def plan_text(
    tests: Sequence[CandidateTest], signals: Sequence[MeasuredSignal], system: str, separates: tuple[str, str]
) -> str:
    """Text of a plan.toml with these tests, which logs these signals, for `pysim bench` or a real bench."""
    one, other = separates
    rows = [f"# Separates {one} from {other}.", "", "[plan]", 'name = "next-test"']
    rows += [f'description = "to tell {one} from {other}"', f'system = "{system}"', ""]
    for signal in (tests[0].input, *signals):
        rows += [f'[signals."{signal.name}"]', f'role = "{signal.role}"', f'unit = "{signal.unit}"']
        rows += [f'quantity = "{signal.quantity}"', f'variable = "{signal.variable}"']
        rows += [f"{key} = {value:.6g}" for key in ("noise", "resolution") if (value := getattr(signal, key))] + [""]
    rows += ["[logging]", f"rate = {1 / tests[0].interval:.6g}", ""]
    for number, test in enumerate(tests, 1):
        rows += [*test.plan_rows(tuple(signal.name for signal in signals), f"test-{number}"), ""]
    return "\n".join(rows)
