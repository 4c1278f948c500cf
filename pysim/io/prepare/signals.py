"""What a signal is: its sign, unit, name, level, and when it was taken."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pysim.io.prepare.gaps import refuse_missing_in
from pysim.io.prepare.interpolation import at_times
from pysim.io.prepare.step import each_log, refuse_tables, rows, signals_of, stands, with_columns
from pysim.io.units import Scale, unit_cure
from pysim.types import UNITS, BadInput, Dataset, MeasuredRecord, Record, conversion

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Flip:
    """Turn the sign of signals.

    Args:
        signals: their names.
        logs: names of those to turn them in; all where there are none.
    """

    word: ClassVar[str] = "flip"
    star: ClassVar[str] = "signals"
    signals: tuple[str, ...]
    logs: tuple[str, ...] = ()

    def apply(self, dataset: Dataset) -> Dataset:
        for name in signals_of(dataset, self.signals):
            dataset = _scaled(dataset, name, Scale(dataset.signal(name).unit, -1.0), self.logs)
        return dataset


@dataclass(frozen=True)
class Scaled:
    """Multiply a signal, and add to it: for raw sensor values, and for what was logged in another unit.

    Args:
        signal: its name.
        factor: of the values, which are in the unit `of`.
        offset: added to that, in `unit`.
        unit: of the product; that of the signal where empty.
        of: of the values; that of the signal where empty.
        logs: names of those to scale it in, where it keeps its unit and noise; all where there are none.
    """

    word: ClassVar[str] = "scale"
    star: ClassVar[str] = ""
    signal: str
    factor: float = 1.0
    offset: float = 0.0
    unit: str = ""
    of: str = ""
    logs: tuple[str, ...] = ()

    def apply(self, dataset: Dataset) -> Dataset:
        own = dataset.signal(self.signal).unit
        for unit in (self.unit, self.of):
            if unit and unit not in UNITS:
                raise BadInput(f"the unit {unit!r} is not known; {unit_cure(unit)}")
        known = conversion(own, self.of or own)
        if known is None:
            raise BadInput(f"{self.signal} is in {own}, which is no quantity in {self.of}; correct the unit")
        if self.factor == 0:
            raise BadInput(f"{self.signal}: a factor of 0 leaves nothing; give another")
        per, zero = known
        new = Scale.of(self.unit or self.of or own, self.factor, self.offset)
        if self.logs and new.unit != own:
            raise BadInput(f"{self.signal} is in {own} in the other logs; scale it in all of them, or keep its unit")
        return _scaled(dataset, self.signal, Scale(new.unit, new.gain * per, new.number(zero)), self.logs)


def _scaled(dataset: Dataset, name: str, scale: Scale, logs: tuple[str, ...]) -> Dataset:
    """A data set whose signal is in another measure, with its noise and what its test says of it.

    Args:
        logs: names of those that alone are; the signal's noise is then that of the others.
    """
    refuse_tables(dataset, "a new scale")
    signal, gain = dataset.signal(name), 1.0 if logs else abs(scale.gain)
    noise, resolution = (None if v is None else gain * v for v in (signal.noise, signal.resolution))
    changed = replace(signal, unit=scale.unit, noise=noise, resolution=resolution)

    def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
        if name not in log.names:
            yield record
            return
        if record.command == name:
            offset = None if record.offset is None else scale.number(record.offset)
            record = replace(record, offset=offset)
            if record.amplitude is not None:
                record = replace(record, amplitude=abs(scale.gain) * record.amplitude)
        units = tuple(scale.unit if own == name else unit for own, unit in zip(log.names, log.units, strict=True))
        moved = with_columns(record, log, {name: scale.gain * log[name] + scale.zero})
        assert isinstance(moved.data, Record)
        yield replace(moved, data=replace(moved.data, units=units))

    signals = tuple(changed if one is signal else one for one in dataset.signals)
    return each_log(replace(dataset, signals=signals), change, logs)


@dataclass(frozen=True)
class Rename:
    """Give signals other names; a pair may swap theirs, and what these stand for in the model.

    Args:
        names: old -> new.
    """

    word: ClassVar[str] = "rename"
    star: ClassVar[str] = ""
    names: Mapping[str, str]

    def apply(self, dataset: Dataset) -> Dataset:
        refuse_tables(dataset, "a new name")
        signals_of(dataset, tuple(self.names))
        new = [self.names.get(signal.name, signal.name) for signal in dataset.signals]
        twice = next((name for name in new if new.count(name) > 1), None)
        if twice is not None:
            raise BadInput(f"two signals would be called {twice!r}; choose another name")
        signals = []
        known = {signal.name: signal for signal in dataset.signals}
        for signal, name in zip(dataset.signals, new, strict=True):
            like = known.get(name, signal)  # who takes the name of another one stands for what that stood for
            variable = name if like.variable == like.name else like.variable
            quantity = name if like.quantity == like.name else like.quantity
            signals.append(replace(signal, name=name, variable=variable, quantity=quantity))

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            names = tuple(self.names.get(name, name) for name in log.names)
            command = self.names.get(record.command, record.command)
            yield replace(record, data=replace(log, names=names), command=command)

        return each_log(replace(dataset, signals=tuple(signals)), change)


@dataclass(frozen=True)
class Detrend:
    """Take the mean, or the straight line, off signals, log by log.

    Args:
        signals: their names; all where there are none.
        order: 0 for the mean, 1 for the line, more for a polynomial.
    """

    word: ClassVar[str] = "detrend"
    star: ClassVar[str] = "signals"
    signals: tuple[str, ...] = ()
    order: int = 0

    def apply(self, dataset: Dataset) -> Dataset:
        if self.order < 0:
            raise BadInput(f"the order is {self.order}; give 0 for the mean, 1 for a line")
        names = signals_of(dataset, self.signals)

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            middle = 0.5 * (log.time[0] + log.time[-1])
            x = 2 * (log.time - middle) / np.ptp(log.time)  # -1 to 1
            own = [name for name in names if name in log.names]
            there = {name: np.isfinite(log[name]) for name in own}
            fits = {
                name: np.polynomial.legendre.legfit(x[rows], log[name][rows], self.order)
                for name, rows in there.items()
                if rows.any()
            }
            yield with_columns(
                record, log, {name: log[name] - np.polynomial.legendre.legval(x, fit) for name, fit in fits.items()}
            )

        return each_log(dataset, change)


@dataclass(frozen=True)
class Delay:
    """Let a signal come later: its new value at t is the old one at t - seconds; a negative number, earlier.

    The log becomes shorter by that time. A new value of an output is missing where an old one beside it is.

    Args:
        signal: its name.
        seconds: s.
    """

    word: ClassVar[str] = "delay"
    star: ClassVar[str] = ""
    signal: str
    seconds: float

    def apply(self, dataset: Dataset) -> Dataset:
        dataset.signal(self.signal)

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            if self.signal not in log.names:
                yield record
                return
            if dataset.signal(self.signal).role == "input":
                refuse_missing_in(dataset, record, log, (self.signal,))
            wanted = log.time - self.seconds
            edge = 1e-9 * float(log.time[-1] - log.time[0])
            first, stop = np.searchsorted(wanted, [log.time[0] - edge, log.time[-1] + edge])
            held = stands(dataset, record, self.signal)
            moved = with_columns(record, log, {self.signal: _moved(log.time, log[self.signal], wanted, held=held)})
            assert isinstance(moved.data, Record)
            yield rows(moved, moved.data, int(first), int(stop))

        return each_log(dataset, change)


def _moved(time: Array, values: Array, wanted: Array, *, held: bool) -> Array:
    """Values (n_t,) at other times, made of samples that are there; not-a-number beside one that is not."""
    there = np.isfinite(values)
    if there.all() or not there.any():
        return at_times(time, values, wanted, held=held)
    found = at_times(time[there], values[there], wanted, held=held)
    place = np.round(np.interp(wanted, time, np.arange(time.size)), 6)  # at a sample, it is on both sides
    ahead, behind = np.floor(place).astype(np.intp), np.ceil(place).astype(np.intp)
    return np.asarray(np.where(there[ahead] & there[behind], found, np.nan))
