"""How the noise of a signal looks: white, or white and some with memory; estimated from the logs, without a model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.adapter import Target
from pysim.identify.greybox.harmonics import regressors
from pysim.identify.greybox.sine_log import SineLog
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.identify.greybox.time_log import TimeLog
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]

# (data set, column).
Column = tuple[str, str]

# Memories to try, in samples and in s: shorter is white, longer is an offset to most logs.
_SHORTEST, _LONGEST, _GRID = 1.0, 1.0, 12
# Ordinates below which nothing is concluded, and blocks of neighbours that a log is reduced to.
_ENOUGH, _BLOCKS = 60, 60
# Harmonics that are taken off a log whose periods are no whole number of samples.
_HARMONICS = 20
# Lowest part of the sampled band, as a share of the sampling rate, that a log without repeated periods is taken to hold
# nothing but noise in; how far down the next look goes, and by how much a band may stick out before it holds signal.
_QUIET, _DOWN, _STICKS_OUT = 0.25, 0.8, 3.0
_LOWEST = 0.02


@dataclass(frozen=True)
class Noise:
    """White noise and, beside it, first-order noise with memory, in the signal's unit.

    Args:
        white: standard deviation of the white part, quantisation included.
        coloured: standard deviation of the part with memory; its correlation over a lag s is exp(-s/memory).
        memory: s.
        told: standard deviation of both that the data set tells, or that stands in for it.
    """

    white: float
    coloured: float
    memory: float
    told: float

    @property
    def deviation(self) -> float:
        """Of both parts together."""
        return math.hypot(self.white, self.coloured)

    @property
    def plain(self) -> bool:
        """Whether it is white and as large as told, so that nothing has to be done."""
        return self.coloured == 0.0 and self.white == self.told

    def over(self, gain: float) -> Noise:
        """Of the signal over a gain."""
        return Noise(self.white / gain, self.coloured / gain, self.memory, self.told / gain)

    def spectrum(self, frequency: Array, interval: float) -> Array:
        """Variance per sample at frequencies (n,) in Hz of samples every `interval` s: white noise is flat."""
        return np.asarray(self.white**2 + self.coloured**2 * _coloured(frequency, interval, self.memory))


def white(deviation: float) -> Noise:
    """Noise as a data set tells it."""
    return Noise(deviation, 0.0, 0.0, deviation)


def estimated_noise(targets: Sequence[Target], *, told: bool = True) -> dict[Column, Noise]:
    """The noise of every logged signal, pooled over its logs.

    Stepped sines show it between the harmonics of their repeated periods, at every frequency. Other logs show it only
    above what the signal itself does, from where its spectrum fits noise: how much lies below follows from the
    deviation that is told, and over which memory from the signals beside it that do repeat.

    Args:
        told: whether the deviations in the targets are told by the data set, or only seen there.
    Source: maximum likelihood of Whittle 1953, Arkiv foer Matematik 2:423, with the exact expectation of the
        periodogram (Sykulski et al. 2019, Biometrika 106:251); its information criterion is Schwarz 1978.
    """
    found: dict[Column, Noise] = {}
    hidden: dict[Column, float] = {}
    for column, size in _columns(targets).items():
        repeated = _joined(list(_repeated(targets, column)))
        if repeated.count > _ENOUGH:
            found[column] = _chosen(repeated, size, (True, False) if told else (False,), _memories(repeated))
        else:
            hidden[column] = size
    for column, size in hidden.items():
        memories = [noise.memory for other, noise in found.items() if other[0] == column[0] and noise.coloured > 0]
        found[column] = _above_signal(_joined(list(_tapered(targets, column))), size, told, memories)
    return found


@dataclass(frozen=True)
class _Ordinates:
    """Periodogram ordinates of noise, averaged over neighbours.

    Args:
        power: (n,) in the signal's unit squared.
        number: (n,) of ordinates in each average.
        frequency: (n,) Hz. interval: (n,) s.
        length: (n,) samples of the log; infinite where it is tapered.
    """

    power: Array
    number: Array
    frequency: Array
    interval: Array
    length: Array

    @property
    def count(self) -> float:
        """Of all ordinates."""
        return float(self.number.sum())

    def mean(self, values: Array) -> float:
        """Of values (n,) over all ordinates."""
        return float(self.number @ values) / self.count

    def above(self, low: float, high: float = math.inf) -> _Ordinates:
        """Those from `low` to `high`, Hz."""
        keep = (self.frequency >= low) & (self.frequency < high)
        return _Ordinates(*(v[keep] for v in (self.power, self.number, self.frequency, self.interval, self.length)))


def _ordinates(power: Array, frequency: Array, interval: float, length: float) -> _Ordinates:
    """Neighbours averaged: few at low frequencies, where the spectrum may be steep."""
    edges = np.unique(np.round(np.geomspace(1, power.size + 1, _BLOCKS)).astype(int)) - 1
    number = np.diff(edges).astype(float)
    middle, level = (np.add.reduceat(v, edges[:-1]) / number for v in (frequency, power))
    n = number.size
    return _Ordinates(level, number, middle, np.full(n, interval), np.full(n, length))


def _joined(parts: Sequence[_Ordinates]) -> _Ordinates:
    names = ("power", "number", "frequency", "interval", "length")
    return _Ordinates(*(np.concatenate([np.zeros(0), *(getattr(p, n) for p in parts)]) for n in names))


def _columns(targets: Sequence[Target]) -> dict[Column, float]:
    """Every logged signal and the noise that the targets give it."""
    found: dict[Column, float] = {}
    for target in targets:
        parts = [target] if isinstance(target, TimeLog) else target.logs if isinstance(target, SteppedSines) else ()
        for part in parts:
            for name, size in zip(part.measured.names, part.noise, strict=True):
                found.setdefault((target.dataset, name), size)
    return found


def _repeated(targets: Sequence[Target], column: Column) -> Iterator[_Ordinates]:
    """Between the harmonics of stepped sines of two periods or more."""
    for target in targets:
        if isinstance(target, SteppedSines) and target.dataset == column[0]:
            for log in target.logs:
                if column[1] in log.measured.names:
                    yield from _between(log, column[1])


def _between(log: SineLog, name: str) -> Iterator[_Ordinates]:
    time = log.measured.time
    n, interval = time.size, float(np.median(np.diff(time)))
    periods = round(n * interval * log.sine.frequency)
    if periods < 2 or not _uniform(time, interval):
        return
    rest = log.measured[name]
    if abs(n * interval * log.sine.frequency - periods) > 1e-6:  # else harmonics are frequencies of their own
        columns = regressors(log.phase, min(int(0.45 / interval / log.sine.frequency), n // 4, _HARMONICS))
        rest = rest - columns @ np.linalg.solve(columns.T @ columns, columns.T @ rest)
    k = np.arange(1, (n + 1) // 2)
    k = k[k % periods != 0]
    if k.size:
        yield _ordinates(np.abs(np.fft.rfft(rest)[k]) ** 2 / n, k / (n * interval), interval, n)


def _tapered(targets: Sequence[Target], column: Column) -> Iterator[_Ordinates]:
    """Of logs over time, every second frequency, since a taper ties neighbours."""
    for target in targets:
        if isinstance(target, TimeLog) and target.dataset == column[0] and column[1] in target.measured.names:
            if target.kind == STEPPED_SINE.name:  # of lines at some of those frequencies
                continue
            time, values = target.measured.time, target.measured[column[1]]
            n, interval = time.size, float(np.median(np.diff(time))) if time.size > 1 else 0.0
            if n < 2 * _ENOUGH or not _uniform(time, interval):
                continue
            taper = np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 4
            k = np.arange(4, (n + 1) // 2, 3)
            power = np.abs(np.fft.rfft((values - values.mean()) * taper)[k]) ** 2 / float(taper @ taper)
            yield _ordinates(power, k / (n * interval), interval, math.inf)


def _uniform(time: Array, interval: float) -> bool:
    return bool(np.all(np.abs(np.diff(time) - interval) < 1e-3 * interval))


def _above_signal(seen: _Ordinates, size: float, told: bool, memories: Sequence[float]) -> Noise:
    """From as far down as the spectrum fits what was found further up."""
    if seen.count < _ENOUGH:
        return white(size)
    rate = 1 / float(np.median(seen.interval))
    low, best = _QUIET * rate, white(size)
    while low > _LOWEST * rate:
        part, band = seen.above(low), seen.above(_DOWN * low, low)
        if part.count > _ENOUGH:
            best = _chosen(part, size, (told,), memories or _memories(part))
        if band.count:
            excess = band.mean(band.power / _expected(best, band)) - 1
            if excess > _STICKS_OUT / math.sqrt(band.count):
                break
        low *= _DOWN
    return best


def _memories(seen: _Ordinates) -> list[float]:
    """To start from, s."""
    low = _SHORTEST * float(seen.interval.min())
    return np.geomspace(low, max(_LONGEST, 3 * low), _GRID).tolist()


def _chosen(seen: _Ordinates, size: float, fixed: Sequence[bool], memories: Sequence[float]) -> Noise:
    """White or coloured, with the deviation fixed to what is told or not: as the information criterion has it."""
    tried: list[tuple[float, Noise]] = []
    for total in fixed:
        plain = white(size) if total else Noise(math.sqrt(seen.mean(seen.power)), 0.0, 0.0, size)
        coloured = _best_memory(seen, size, total, memories)
        known = 0 if total else 1
        tried.append((_cost(plain, seen) + known * math.log(seen.count), plain))
        tried.append((_cost(coloured, seen) + (known + 2) * math.log(seen.count), coloured))
    return min(tried, key=lambda pair: pair[0])[1]


def _best_memory(seen: _Ordinates, size: float, total: bool, memories: Sequence[float]) -> Noise:
    """The best of a grid, then halfway to its neighbours, and so on."""
    found = {m: _shares(seen, size, total, m) for m in memories}
    costs = {m: _cost(noise, seen) for m, noise in found.items()}
    best = min(costs, key=lambda m: costs[m])
    factor = memories[1] / memories[0] if len(memories) == _GRID else 1.0
    while factor > 1.03:
        factor = math.sqrt(factor)
        for m in (best / factor, best * factor):
            found[m] = _shares(seen, size, total, m)
            costs[m] = _cost(found[m], seen)
        best = min(costs, key=lambda m: costs[m])
    return found[best]


def _shares(seen: _Ordinates, size: float, total: bool, memory: float) -> Noise:
    """Both variances at one memory by scoring: the periodogram's expectation is linear in them."""
    shape, ones = _expected(Noise(0.0, 1.0, memory, size), seen), np.ones_like(seen.power)
    if total:
        columns, rest, scale, values = (shape - 1.0)[:, None], ones, size**2, np.array([0.2])
    else:
        columns, rest, scale = np.stack([ones, shape], axis=1), 0.0 * ones, seen.mean(seen.power)
        values = np.array([0.8, 0.2])
    power = seen.power / scale
    for _ in range(6):
        weighted = columns * (seen.number / (rest + columns @ values) ** 2)[:, None]
        values = np.linalg.lstsq(weighted.T @ columns, weighted.T @ (power - rest), rcond=None)[0]
        values = np.clip(values, 1e-6, 1.0 - 1e-6 if total else None)
    parts = np.array([1 - values[0], values[0]]) if total else values
    return Noise(math.sqrt(parts[0] * scale), math.sqrt(parts[1] * scale), memory, size)


def _cost(noise: Noise, seen: _Ordinates) -> float:
    """Twice the negative logarithm of Whittle's likelihood."""
    expected = _expected(noise, seen)
    return 2 * float(seen.number @ (np.log(expected) + seen.power / expected))


def _expected(noise: Noise, seen: _Ordinates) -> Array:
    """What the periodogram is on average, (n,)."""
    flat = np.full(seen.power.size, noise.white**2)
    if noise.coloured == 0.0:
        return flat
    return np.asarray(flat + noise.coloured**2 * _coloured(seen.frequency, seen.interval, noise.memory, seen.length))


def _coloured(frequency: Array, interval: Array | float, memory: float, length: Array | None = None) -> Array:
    """Expected periodogram of noise with memory and variance 1, of logs of `length` samples or of endless ones."""
    if memory <= 0:
        return np.ones_like(frequency)
    kept = np.exp(-interval / memory) * np.ones_like(frequency)
    turn = kept * np.exp(-2j * np.pi * frequency * interval)
    endless = 1 + 2 * (turn / (1 - turn)).real
    if length is None:
        return np.asarray(endless)
    # sum over k of k/n turn^k at the frequencies of the log, where turn^n = kept^n
    finite = np.isfinite(length)
    n = np.where(finite, length, 1.0)
    last = kept**n
    ends = 2 * (turn * (1 - last) / (n * (1 - turn) ** 2)).real
    return np.asarray(endless - np.where(finite, ends, 0.0))
