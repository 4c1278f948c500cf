"""The tests of a plan: each becomes runs, a command with the file it is logged to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Protocol

from pysim.excitation import Chirp, Excitation, LeadIn, Multisine, Step, SteppedSineCommand, StochasticWave
from pysim.types import BadInput
from pysim.types.record_kind import STEPPED_SINE


@dataclass(frozen=True)
class Run:
    """One test as it is driven and logged.

    Args:
        source: file of the log, relative to the data set.
        kind, use: as in `MeasuredRecord`.
        input: name of the commanded signal.
        outputs: names of the measured signals.
        command: in the input's SI unit.
        log_from: s of the test at which the log starts; it ends with the excitation.
        offset, amplitude, frequency: what the log says of itself, in the input's SI unit and Hz.
    """

    source: str
    kind: str
    use: str
    input: str
    outputs: tuple[str, ...]
    command: Excitation
    log_from: float
    offset: float | None = None
    amplitude: float | None = None
    frequency: float | None = None


class BenchTest(Protocol):
    """What every kind of test offers."""

    @property
    def input(self) -> str:
        """The commanded signal."""
        ...

    @property
    def outputs(self) -> tuple[str, ...]:
        """The measured signals."""
        ...

    def runs(self, unit: float) -> Iterator[Run]:
        """Its runs; files are named by numbers in a unit that is `unit` of the input's SI units."""
        ...


@dataclass(frozen=True)
class SteppedSines:
    """Stepped sines: every frequency at every offset and amplitude (thesis Section 2.1.1).

    Args:
        input, outputs: signal names.
        points: (offset, amplitude) in the input's SI unit.
        frequencies: Hz.
        periods: whole periods at least.
        least: s of sine at least.
        most: s of sine at most, but for one period.
        lead: how the command comes to its offset; the log starts with the sine.
        folder: of the logs.
        use: one of `pysim.types.dataset.USES`.
    """

    input: str
    outputs: tuple[str, ...]
    points: tuple[tuple[float, float], ...]
    frequencies: tuple[float, ...]
    periods: int = 3
    least: float = 1.2
    most: float = 20.0
    lead: LeadIn = field(default_factory=LeadIn)
    folder: str = "frequency_response"
    use: str = "fit"

    def __post_init__(self) -> None:
        if not self.points or not self.frequencies:
            raise BadInput("stepped sines: give at least one pair of offset and amplitude, and one frequency")
        if any(amplitude <= 0 for _, amplitude in self.points):
            raise BadInput("stepped sines: every amplitude, the second number of a point, must be positive")
        if min(self.frequencies) <= 0 or self.periods < 1 or not 0 <= self.least <= self.most:
            raise BadInput("stepped sines: frequencies and periods must be positive, and most not less than least")

    def runs(self, unit: float) -> Iterator[Run]:
        """A run per point and frequency."""
        for offset, amplitude in self.points:
            point = f"{self.folder}/{_point(offset, amplitude, unit)}"
            for frequency in self.frequencies:
                command = SteppedSineCommand(offset, amplitude, frequency, self.periods_of(frequency), self.lead)
                yield Run(
                    f"{point}/{frequency:g}Hz.txt",
                    STEPPED_SINE.name,
                    self.use,
                    self.input,
                    self.outputs,
                    command,
                    command.onset,
                    offset,
                    amplitude,
                    frequency,
                )

    def periods_of(self, frequency: float) -> int:
        """Whole periods at that frequency, Hz."""
        wanted = max(self.periods, math.ceil(self.least * frequency - 1e-9))
        return max(1, min(wanted, math.floor(self.most * frequency + 1e-9)))


@dataclass(frozen=True)
class _SingleTest:
    """A test that is one run.

    Args:
        input, outputs: signal names.
        command: its excitation.
        name: of the log; one that tells the test where it is empty.
        folder: of the log.
        use: one of `pysim.types.dataset.USES`.
    """

    input: str
    outputs: tuple[str, ...]
    command: Excitation
    name: str = ""
    folder: str = ""
    use: str = "fit"

    def _run(self, kind: str, usual_name: str, log_from: float, *stated: float) -> Iterator[Run]:
        """One run; `stated` is what the log says of itself: offset, amplitude."""
        source = f"{self.folder}/{self.name or usual_name}.txt"
        yield Run(source, kind, self.use, self.input, self.outputs, self.command, log_from, *stated)


@dataclass(frozen=True)
class ChirpTest(_SingleTest):
    """A chirp; the log starts with the sweep."""

    command: Chirp
    folder: str = "chirp"

    def runs(self, unit: float) -> Iterator[Run]:
        """One run."""
        offset, amplitude = self.command.offset, self.command.amplitude
        return self._run("chirp", _point(offset, amplitude, unit), self.command.onset, offset, amplitude)


@dataclass(frozen=True)
class WaveTest(_SingleTest):
    """A stochastic wave; the log starts at rest at the offset, before the wave does."""

    command: StochasticWave
    folder: str = "stochastic"

    def __post_init__(self) -> None:
        _at_offset("wave", self.command)

    def runs(self, unit: float) -> Iterator[Run]:
        """One run."""
        name = f"Tp{self.command.spectrum.peak_period:g}s"
        return self._run("stochastic", name, _at_offset("wave", self.command))


@dataclass(frozen=True)
class StepTest(_SingleTest):
    """A step; the log starts at rest at the offset."""

    command: Step
    folder: str = "step"

    def __post_init__(self) -> None:
        _at_offset("step", self.command)

    def runs(self, unit: float) -> Iterator[Run]:
        """One run."""
        offset, height = self.command.offset, self.command.height
        name = f"O{offset / unit:+g}_H{height / unit:+g}"
        return self._run("step", name, _at_offset("step", self.command), offset)


@dataclass(frozen=True)
class MultisineTest:
    """A multisine with as many realisations of its phases as asked for; the log starts with the first period.

    Args:
        input, outputs: signal names.
        command: the first realisation.
        realisations: how many, each a run of its own.
    """

    input: str
    outputs: tuple[str, ...]
    command: Multisine
    realisations: int = 1
    name: str = ""
    folder: str = "multisine"
    use: str = "fit"

    def __post_init__(self) -> None:
        if self.realisations < 1:
            raise BadInput(f"multisine: {self.realisations} realisations; give one or more")

    def runs(self, unit: float) -> Iterator[Run]:
        """A run per realisation."""
        name = self.name or f"O{self.command.offset / unit:+g}"
        for number in range(self.realisations):
            command = self.command.realisation(number)
            source = f"{self.folder}/{name}_R{number + 1}.txt"
            yield Run(
                source,
                "multisine",
                self.use,
                self.input,
                self.outputs,
                command,
                command.onset,
                command.offset,
            )


def _point(offset: float, amplitude: float, unit: float) -> str:
    """Offset and amplitude as in the names of the thesis' folders."""
    return f"O{offset / unit:+g}_A{amplitude / unit:g}"


def _at_offset(kind: str, command: StochasticWave | Step) -> float:
    """From when on the command rests at its offset, s."""
    lead = command.lead
    if lead.hold > 0:
        return lead.rest + lead.ramp
    if command.offset == 0 and lead.onset > 0:
        return 0.0
    raise BadInput(f"{kind}: without a hold its log cannot start at rest at the offset; give the lead a hold")
