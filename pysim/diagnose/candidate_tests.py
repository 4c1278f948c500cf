"""Experiments that a bench could run next, within what it has run already."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.excitation import Excitation, LeadIn, PiersonMoskowitz, Step, SteppedSineCommand, StochasticWave
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal, Model, Record
from pysim.types.record_kind import STEPPED_SINE, STOCHASTIC

Array = NDArray[np.float64]

# Parts of equal width that the range of the command so far is cut into: where it went to both sides of zero, and where
# it did not. A sine is around the middle of a part; its amplitudes in shares of half the part.
_BOTH_SIDES, _ONE_SIDE, _AMPLITUDES = 4, 2, (0.2, 1.0)
# Share of its largest size that a command must reach on either side to count as having been there.
_SIDE = 0.1
# Frequencies between the lowest and the highest, in equal ratios; samples a test takes at least, and whole periods.
_FREQUENCIES, _SAMPLES, _PERIODS = 6, 300, 3
# Of a wave: its samples, its significant height in shares of half the range of the command so far, and its seed.
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
            f'kind = "{STEPPED_SINE.name if self.periods else STOCHASTIC.name}"',
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
        around = f" around {self.offset:.3g}{unit}" if self.offset else ""
        wave = f"a wave of {self.amplitude:.3g}{unit} significant height{around}"
        return f"{wave}, its peak at {self.frequency:.3g} Hz, {seconds}"


@dataclass(frozen=True)
class _Range:
    """What a bench has done so far.

    Args:
        command: the one that is driven.
        lowest, highest: of its values, in its unit.
        interval: s between samples.
        band: lowest and highest frequency, Hz.
    """

    command: MeasuredSignal
    lowest: float
    highest: float
    interval: float
    band: tuple[float, float]

    @property
    def middle(self) -> float:
        """Of the range, in the command's unit."""
        return (self.lowest + self.highest) / 2

    @property
    def half(self) -> float:
        """Of the range's width, in the command's unit."""
        return (self.highest - self.lowest) / 2

    @property
    def both_sides(self) -> bool:
        """Whether the command went to both sides of zero."""
        least = _SIDE * max(-self.lowest, self.highest)
        return self.lowest < -least and self.highest > least

    @property
    def parts(self) -> int:
        """That the range is cut into."""
        return _BOTH_SIDES if self.both_sides else _ONE_SIDE

    @property
    def offsets(self) -> tuple[float, ...]:
        """Middles of the parts, in the command's unit."""
        halves = range(1 - self.parts, self.parts, 2)
        return tuple(self.middle + number * (self.half / self.parts) for number in halves)

    @property
    def amplitudes(self) -> tuple[float, ...]:
        """That stay within a part, in the command's unit."""
        return tuple(self.half / self.parts * share for share in _AMPLITUDES)


def candidate_tests(
    dataset: Dataset, settled: Callable[[Experiment], float], model: Model
) -> tuple[CandidateTest, ...]:
    """Stepped sines and waves that stay between the data set's lowest and highest command, no faster than it can log.

    Args:
        settled: when a run that records nothing yet comes to rest, s.
        model: of the system.
    Raises:
        BadInput: no log over time, other than one command, or one that never moves.
    """
    known = _range(dataset)
    farthest = max(known.offsets, key=lambda offset: (abs(offset), offset))
    step = Step(0.0, farthest, _WAIT * known.interval, lead=LeadIn(_SOON, 0.0, 0.0, 0.0))
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
    lowest, highest = min(float(c.min()) for c in columns), max(float(c.max()) for c in columns)
    if lowest == highest:
        raise BadInput(f"data set {dataset.name!r}: a next test needs a command that moves in a log to go by")
    interval = float(np.median([np.median(np.diff(log.time)) for log in logs]))
    told = [record.frequency for record in dataset.logs() if record.frequency is not None]
    longest = max(float(log.time[-1] - log.time[0]) for log in logs)
    low, high = (min(told), max(told)) if len(set(told)) > 1 else (5 / longest, 1 / (8 * interval))
    return _Range(inputs[0], lowest, highest, interval, (low, high))


def _grid(known: _Range, hold: float) -> Iterator[CandidateTest]:
    for offset in known.offsets:
        for frequency in np.geomspace(*known.band, _FREQUENCIES).tolist():
            periods = max(_PERIODS, math.ceil(_SAMPLES * known.interval * frequency - 1e-9))
            for amplitude in known.amplitudes:
                yield CandidateTest(
                    known.command, offset, amplitude, float(f"{frequency:.3g}"), periods, known.interval, hold
                )
    low, high = known.band
    for share in _PEAKS if known.both_sides else ():
        peak = float(f"{low * (high / low) ** share:.3g}")
        yield CandidateTest(known.command, known.middle, known.half * _HEIGHT, peak, 0, known.interval, hold)
