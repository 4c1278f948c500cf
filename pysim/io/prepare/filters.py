"""Filters without phase, and another sampling rate."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pysim.io.prepare.gaps import even_step
from pysim.io.prepare.interpolation import at_times
from pysim.io.prepare.step import each_log, refuse_tables, signals_of, stands, with_columns
from pysim.types import BadInput, Dataset, MeasuredRecord, Record, sampling

Array = NDArray[np.float64]
Gain = Callable[[Array], Array]

_ORDER = 4  # of the Butterworth filter, which runs forward and backward
_FLAT = 0.8  # of half the new sampling rate: up to there nothing is lost
_EVEN = 0.05  # of a sampling interval: steadier clocks count as even
_ROUNDING = 1e-9


@dataclass(frozen=True)
class LowPass:
    """Take fast parts off, without any phase: a Butterworth filter of order 4, run forward and backward.

    At `hz` half the amplitude is left: 1 / (1 + (f / hz)^8). Input and output are to be filtered alike; then what a
    linear plant makes of the one is still the other. The noise that is specified falls by the filter's own measure.

    Args:
        hz: Hz.
        signals: their names; all where there are none.
    """

    word: ClassVar[str] = "lowpass"
    star: ClassVar[str] = "signals"
    hz: float
    signals: tuple[str, ...] = ()

    def apply(self, dataset: Dataset) -> Dataset:
        if not self.hz > 0:
            raise BadInput(f"{self.hz:g} Hz is no frequency; give a positive one")
        refuse_tables(dataset, "a filter")
        names = signals_of(dataset, self.signals)

        def gain(frequency: Array) -> Array:
            return np.asarray(1 / (1 + (frequency / self.hz) ** (2 * _ORDER)))

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            own = tuple(name for name in names if name in log.names)
            step = even_step(dataset, record, log, own)
            if self.hz >= 0.5 / step:
                raise BadInput(f"{record.source} is sampled at {1 / step:.4g} Hz; give less than half of that")
            _refuse_uneven(record, log, step)
            yield with_columns(record, log, {name: filtered(log[name], step, gain) for name in own})

        return _quieter(each_log(dataset, change), dataset, names, gain)


@dataclass(frozen=True)
class Resample:
    """Sample all signals evenly at another rate; ahead of a lower one, what that cannot hold is filtered off.

    Up to 0.8 of half the new rate nothing is lost. Signals that stand between their samples stay so.

    Args:
        hz: samples a second.
    """

    word: ClassVar[str] = "resample"
    star: ClassVar[str] = ""
    hz: float

    def apply(self, dataset: Dataset) -> Dataset:
        if not self.hz > 0:
            raise BadInput(f"{self.hz:g} Hz is no rate; give a positive one")
        refuse_tables(dataset, "a new sampling rate")
        half = 0.5 * self.hz

        def gain(frequency: Array) -> Array:
            share = np.clip((frequency / half - _FLAT) / (1 - _FLAT), 0.0, 1.0)
            return np.asarray(0.5 * (1 + np.cos(np.pi * share)))

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            step = even_step(dataset, record, log)
            duration = float(log.time[-1] - log.time[0])
            count = 1 + int(duration * self.hz * (1 + _ROUNDING) + _ROUNDING)
            if count < 2:
                raise BadInput(f"{record.source} lasts {duration:.4g} s; sample it faster")
            time, values = log.time, log.values
            if self.hz < (1 - _ROUNDING) / step:
                time = log.time[0] + step * np.arange(1 + round(duration / step))
                even = np.column_stack([at_times(log.time, column, time) for column in values.T])
                values = np.column_stack([filtered(column, step, gain) for column in even.T])
            wanted = log.time[0] + np.arange(count) / self.hz
            held = [stands(dataset, record, name) for name in log.names]
            columns = [at_times(time, column, wanted, held=own) for column, own in zip(values.T, held, strict=True)]
            yield replace(record, data=replace(log, time=wanted, values=np.column_stack(columns)))

        changed = each_log(dataset, change)
        rates = [1 / sampling(record.data.time).step for record in dataset.logs() if isinstance(record.data, Record)]
        is_lower = any(self.hz < (1 - _ROUNDING) * rate for rate in rates)
        return _quieter(changed, dataset, signals_of(dataset, ()), gain) if is_lower else changed


def filtered(values: Array, step: float, gain: Gain) -> Array:
    """Even samples (n_t,) through a filter that is a gain over frequency in Hz, its ends mirrored."""
    n = values.size
    front, back = 2 * values[0] - values[:0:-1], 2 * values[-1] - values[-2::-1]
    long = np.concatenate([front, values, back])
    line: Array = np.linspace(long[0], long[-1], long.size)  # what is left begins and ends with zero
    size = 1 << (long.size - 1).bit_length()
    share = gain(np.asarray(np.fft.rfftfreq(size, step), dtype=np.float64))
    smooth = np.fft.irfft(np.fft.rfft(long - line, size) * share, size)[: long.size]
    return np.asarray((smooth + line)[n - 1 : 2 * n - 1])


def _quieter(changed: Dataset, before: Dataset, names: tuple[str, ...], gain: Gain) -> Dataset:
    """The same with the noise that a filter leaves of white noise, at the highest rate among the logs."""
    steps = [sampling(record.data.time).step for record in before.logs() if isinstance(record.data, Record)]
    left = float(np.sqrt(np.mean(gain(np.linspace(0.0, 0.5 / min(steps), 1 << 12)) ** 2))) if steps else 1.0
    signals = tuple(
        s if s.noise is None or s.name not in names else replace(s, noise=left * s.noise) for s in changed.signals
    )
    return replace(changed, signals=signals)


def _refuse_uneven(record: MeasuredRecord, log: Record, step: float) -> None:
    if float(np.std(np.diff(log.time))) > _EVEN * step:
        raise BadInput(f"{record.source} is sampled unevenly; data.resample({1 / step:.3g}) first")
