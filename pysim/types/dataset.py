"""Measurements of a test bench: what was logged, in which units, and what each log is for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from pysim.types.errors import BadInput
from pysim.types.frequency_response import FrequencyResponse
from pysim.types.record import Record
from pysim.types.record_kind import Command


@dataclass(frozen=True)
class MeasuredSignal:
    """One column of the logs.

    Args:
        name: the column's name.
        role: "input" | "output".
        unit: SI unit, "1" or "%", whatever the file was written in.
        quantity: what it is, in words.
        variable: the model variable it stands for.
        noise: standard deviation of the measurement noise, in `unit`, or None where not known.
        resolution: quantisation step, in `unit`, or None where not known.
        hold: how an input runs between samples; None where the record's kind says it.
    """

    name: str
    role: str
    unit: str
    quantity: str
    variable: str
    noise: float | None = None
    resolution: float | None = None
    hold: Command | None = None

    @property
    def deviation(self) -> float:
        """Standard deviation of noise and rounding together, in `unit`, as far as they are known.

        Rounding to steps of h is evenly spread over h, of variance h^2/12.
        """
        return math.hypot(self.noise or 0.0, (self.resolution or 0.0) / math.sqrt(12))


USES = ("fit", "validate", "test")  # fitted; used to choose between models; held out, which is only reported
INITIAL = ("rest", "estimate", "model")  # what a record may say of the plant at its first sample


@dataclass(frozen=True)
class MeasuredRecord:
    """One log or table.

    Args:
        source: where it came from, relative to the data set.
        kind: name of one of `KINDS`.
        use: one of `USES`.
        data: signals over time, or a response over frequency.
        offset: what the command was meant to swing around, in the input's unit, or None where not stated.
        amplitude: the same of its swing.
        frequency: Hz, of a stepped sine; None for all else.
        command: name of the input that the three speak of; empty where a log has several inputs and does not say.
        initial: what is known of the plant at a log's first sample. "rest": it stood still at the first input.
            "model": the model's start values hold. "estimate": nothing. None: near rest, as far as the data agree.
        begin: s, of a log's first row on a clock that all records share, so that slow drift can be seen: then the
            model's `time` is this clock. None where not known.
        holds: column -> how it runs between samples, of a log that is handed on without its data set.
    """

    source: str
    kind: str
    use: str
    data: Record | FrequencyResponse
    offset: float | None = None
    amplitude: float | None = None
    frequency: float | None = None
    command: str = ""
    initial: str | None = None
    begin: float | None = None
    holds: Mapping[str, Command] = field(default_factory=dict)

    @property
    def held_out(self) -> bool:
        """Whether nothing is fitted to it."""
        return self.use != "fit"


@dataclass(frozen=True)
class Dataset:
    """All measurements of one system. Signals are named by their columns; see `MeasuredSignal.variable`."""

    name: str
    description: str
    system: str
    signals: tuple[MeasuredSignal, ...]
    records: tuple[MeasuredRecord, ...]

    def signal(self, name: str) -> MeasuredSignal:
        """The signal of that column name."""
        for signal in self.signals:
            if signal.name == name:
                return signal
        raise BadInput(
            f"data set {self.name!r} has no signal {name!r}; it has {', '.join(s.name for s in self.signals)}"
        )

    def responses(self) -> tuple[FrequencyResponse, ...]:
        """Every measured frequency response, in the order of the records."""
        return tuple(record.data for record in self.records if isinstance(record.data, FrequencyResponse))

    def logs(self) -> tuple[MeasuredRecord, ...]:
        """Every record over time, in order."""
        return tuple(record for record in self.records if isinstance(record.data, Record))

    def columns(self, record: MeasuredRecord, role: str) -> tuple[str, ...]:
        """Names of a log's columns that are "input" or "output", in its order."""
        names = record.data.names if isinstance(record.data, Record) else ()
        return tuple(name for name in names if self.signal(name).role == role)
