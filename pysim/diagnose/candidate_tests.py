"""Experiments that a bench could run next, within what it has run already."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.excitation import Excitation, LeadIn, PiersonMoskowitz, Step, SteppedSineCommand, StochasticWave
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal, Model, Record

Array = NDArray[np.float64]

# Offsets and amplitudes in shares of the largest command so far.
_OFFSETS, _AMPLITUDES = (-0.75, -0.25, 0.25, 0.75), (0.05, 0.25)
# Frequencies between the lowest and the highest, in equal ratios; samples a test takes at least, and whole periods.
_FREQUENCIES, _SAMPLES, _PERIODS = 6, 300, 3
# Of a wave: its samples, its significant height in shares of the largest command so far, and its seed.
_WAVE, _HEIGHT, _SEED = 2000, 0.8, 1
# Samples in which a system must come to rest after a step, and when that comes, s.
_WAIT, _SOON = 10_000, 0.01
# Peak frequencies of waves, from the lowest frequency to the highest in shares of their ratio's logarithm.
_PEAKS = (0.4, 0.7)


@dataclass(frozen=True)
class CandidateTest:
    """A stepped sine, or a stochastic wave.

    Args:
        input: the commanded signal.
        offset: in its unit.
        amplitude: of the sine, or the wave's significant height, in its unit.
        frequency: of the sine or of the wave's peak, Hz.
        periods: whole, of a sine; 0 for a wave.
        interval: s between samples.
        hold: s at the offset until the system is at rest.
    """

    input: MeasuredSignal
    offset: float
    amplitude: float
    frequency: float
    periods: int
    interval: float
    hold: float

    @property
    def command(self) -> Excitation:
        """What drives it: rest, ramp, hold, then the sine or the wave."""
        lead = LeadIn(hold=self.hold)
        if self.periods:
            return SteppedSineCommand(self.offset, self.amplitude, self.frequency, self.periods, lead)
        spectrum = PiersonMoskowitz(self.amplitude, 1 / self.frequency)
        return StochasticWave(spectrum, _WAVE * self.interval, _SEED, offset=self.offset, lead=lead)

    @property
    def log_from(self) -> float:
        """When its log starts, s: with the sine, or at rest before the wave."""
        return self.command.onset - (0.0 if self.periods else self.hold)

    @property
    def seconds(self) -> float:
        """On the bench, lead included."""
        return self.command.end

    @property
    def samples(self) -> int:
        """Of its log."""
        return math.floor((self.command.end - self.log_from) / self.interval + 1e-6)

    def longer(self, count: int) -> tuple[CandidateTest, ...]:
        """The test with so much more of the same: a sine of more periods, or the wave again."""
        return (replace(self, periods=count * self.periods),) if self.periods else (self,) * count

    def experiment(self, model: Model, record: tuple[str, ...], overrides: dict[str, float]) -> Experiment:
        """The test as a run of the model, recorded as it would be logged."""
        commands = {self.input.variable: self.command.signal()}
        times = np.array(self.log_from + self.interval * np.arange(self.samples))
        return Experiment(times, record, commands, overrides, rates=model.rate_inputs(commands))

    def plan_rows(self, outputs: tuple[str, ...], name: str) -> list[str]:
        """The test as a table of a test plan."""
        names = ", ".join(f'"{output}"' for output in outputs)
        rows = [
            "[[tests]]",
            f'kind = "{"frequency-response" if self.periods else "stochastic"}"',
            f"outputs = [{names}]",
        ]
        if self.periods:
            rows += [f"points = [[{self.offset:.6g}, {self.amplitude:.6g}]]", f"frequencies = [{self.frequency:.6g}]"]
            rows += [f"periods = {self.periods}", "least = 0.0", f"most = {2 * self.periods / self.frequency:.6g}"]
            return [*rows, f'folder = "{name}"', f"lead.hold = {self.hold:.6g}"]
        rows += [f'name = "{name}"', f"offset = {self.offset:.6g}", f"significant_height = {self.amplitude:.6g}"]
        rows += [f"peak_period = {1 / self.frequency:.9g}", f"length = {_WAVE * self.interval:.6g}", f"seed = {_SEED}"]
        return [*rows, f"lead.hold = {self.hold:.6g}"]

    def __str__(self) -> str:
        unit = "" if self.input.unit == "1" else f" {self.input.unit}"
        seconds = f"for {self.command.end - self.command.onset:.3g} s"
        if self.periods:
            sine = f"a sine of {self.frequency:.3g} Hz and {self.amplitude:.3g}{unit}"
            return f"{sine} around {self.offset:.3g}{unit} {seconds}"
        return (
            f"a wave of {self.amplitude:.3g}{unit} significant height, its peak at {self.frequency:.3g} Hz, {seconds}"
        )


@dataclass(frozen=True)
class _Range:
    """What a bench has done so far.

    Args:
        command: the one that is driven.
        largest: absolute value, in its unit.
        signs: whether it went to both sides.
        interval: s between samples.
        band: lowest and highest frequency, Hz.
    """

    command: MeasuredSignal
    largest: float
    signs: bool
    interval: float
    band: tuple[float, float]


def candidate_tests(
    dataset: Dataset, settled: Callable[[Experiment], float], model: Model
) -> tuple[CandidateTest, ...]:
    """Stepped sines and waves at commands no larger than those of the data set, and no faster than it can log.

    Args:
        settled: when a run that records nothing yet comes to rest, s.
        model: of the system.
    Raises:
        BadInput: no log over time, or other than one command.
    """
    known = _range(dataset)
    step = Step(0.0, _OFFSETS[-1] * known.largest, _WAIT * known.interval, lead=LeadIn(_SOON, 0.0, 0.0, 0.0))
    commands = {known.command.variable: step.signal()}
    times = np.array(known.interval * np.arange(_WAIT))
    rest = settled(Experiment(times, ("time",), commands, rates=model.rate_inputs(commands))) - _SOON
    hold = math.ceil(10 * max(LeadIn().hold, rest) - 1e-9) / 10
    return tuple(_grid(known, hold))


def _range(dataset: Dataset) -> _Range:
    inputs = [signal for signal in dataset.signals if signal.role == "input"]
    logs = [record.data for record in dataset.logs() if isinstance(record.data, Record)]
    if len(inputs) != 1 or not logs:
        raise BadInput(f"data set {dataset.name!r}: a next test needs one command and a log over time to go by")
    columns = [log[inputs[0].name] for log in logs]
    largest = max(float(np.abs(column).max()) for column in columns)
    signs = min(column.min() for column in columns) < -0.1 * largest and max(c.max() for c in columns) > 0.1 * largest
    interval = float(np.median([np.median(np.diff(log.time)) for log in logs]))
    told = [record.frequency for record in dataset.logs() if record.frequency is not None]
    longest = max(float(log.time[-1] - log.time[0]) for log in logs)
    low, high = (min(told), max(told)) if len(set(told)) > 1 else (5 / longest, 1 / (8 * interval))
    return _Range(inputs[0], largest, signs, interval, (low, high))


def _grid(known: _Range, hold: float) -> Iterator[CandidateTest]:
    for offset in (share for share in _OFFSETS if known.signs or share > 0):
        for frequency in np.geomspace(*known.band, _FREQUENCIES).tolist():
            periods = max(_PERIODS, math.ceil(_SAMPLES * known.interval * frequency - 1e-9))
            for amplitude in _AMPLITUDES:
                yield CandidateTest(
                    known.command, known.largest * offset, known.largest * amplitude, float(f"{frequency:.3g}"),
                    periods, known.interval, hold,
                )  # fmt: skip
    low, high = known.band
    for share in _PEAKS if known.signs else ():
        peak = float(f"{low * (high / low) ** share:.3g}")
        yield CandidateTest(known.command, 0.0, known.largest * _HEIGHT, peak, 0, known.interval, hold)
