"""Comparison of logs with a model's simulation: wrong signs, units and columns."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.data_check.finding import Finding, FindingCode, finding
from pysim.identify.data_check.settings import ModelCheckSettings
from pysim.identify.greybox.noise import seen_noise
from pysim.io.prepare import Flip, Rename, Scaled, short_name
from pysim.types import UNITS, Dataset, MeasuredSignal, Model, Record, conversion

Array = NDArray[np.float64]

_SETTINGS = ModelCheckSettings()
_FACTORS = (10.0, 60.0, 1000.0)  # usual factors between units that are mixed up; by unit these instead
_OF_UNIT: Mapping[str, tuple[float, ...]] = {
    "rad": (180 / math.pi,),
    "rad/s": (180 / math.pi, 30 / math.pi),
    "Pa": (1e5, 10.0, 1000.0),
    "m3/s": (6e4, 60.0, 1000.0),
}


@dataclass(frozen=True)
class _Log:
    """A measured signal and the simulated one in a log, each without its mean.

    Args:
        source, name: of the log; empty for several logs in a row.
        measured: (n,).
        own: (n,) simulated.
        levels: means of both.
    """

    source: str
    name: str
    measured: Array
    own: Array
    levels: tuple[float, float]

    @cached_property
    def correlation(self) -> float:
        """Of both; 0 if one of them is constant."""
        return _correlation(self.measured, self.own)

    @property
    def follows(self) -> bool:
        """Whether it follows the model, or its negative."""
        return abs(self.correlation) >= _SETTINGS.follows

    @property
    def is_tone(self) -> bool:
        """Whether the simulated signal is one sine of several periods."""
        power = np.abs(np.fft.rfft(self.own * np.hanning(self.own.size))) ** 2
        peak = int(np.argmax(power))
        lobe = _SETTINGS.lobe
        line = float(power[max(peak - lobe, 0) : peak + lobe + 1].sum())
        return peak > lobe and line > (1 - _SETTINGS.tone) * float(power.sum())

    @property
    def gain(self) -> float:
        """Measured over simulated signal, by least squares."""
        return float(self.measured @ self.own / (self.own @ self.own))

    @property
    def ratio(self) -> float | None:
        """Measured over simulated swing, whatever their levels and shapes; None if either may be noise or rounding."""
        swings = []
        for values in (self.measured, self.own):
            low, high = np.quantile(values, (_SETTINGS.tail, 1 - _SETTINGS.tail))
            if not high - low > _SETTINGS.clear * seen_noise(values):
                return None
            swings.append(float(high - low))
        return swings[0] / swings[1]


@dataclass(frozen=True)
class _Pair:
    """A measured signal and the simulated one in all logs.

    Args:
        signal: the signal of the data set.
        unit: unit of the simulated signal.
        logs: those that have both.
    """

    signal: MeasuredSignal
    unit: str
    logs: tuple[_Log, ...]

    @cached_property
    def whole(self) -> _Log:
        """All logs in a row, with the levels of the first."""
        return _in_a_row(self.logs)

    @property
    def telling(self) -> tuple[_Log, ...]:
        """Logs to judge one by one; all in a row where none follows by itself, and all together do."""
        size = [float(np.std(log.own)) for log in self.logs]
        least = _SETTINGS.moves * max(size)
        able = [log for log, own in zip(self.logs, size, strict=True) if own > least and np.ptp(log.measured)]
        return (self.whole,) if self.whole.follows and not any(log.follows for log in able) else tuple(able)


def _in_a_row(logs: Sequence[_Log]) -> _Log:
    measured, own = (np.concatenate([getattr(log, name) for log in logs]) for name in ("measured", "own"))
    return _Log("", "", measured, own, logs[0].levels)


def against_model(dataset: Dataset, answers: Mapping[str, Record]) -> Iterator[Finding]:
    """Findings of signals with a wrong sign, a wrong unit, or swapped names.

    Args:
        answers: source of a log -> simulated log, with columns named like signals or their variables.
    """
    pairs = [pair for s in dataset.signals if s.role == "output" and (pair := _pair(dataset, answers, s))]
    swapped = set()
    for one, other in combinations(pairs, 2):
        found = _swapped(one, other)
        if found is not None:
            swapped |= {one.signal.name, other.signal.name}
            names = {one.signal.name: other.signal.name, other.signal.name: one.signal.name}
            told = {"signal": one.signal.name, "other": other.signal.name}
            yield finding(FindingCode.SWAPPED, one.logs[0].source, Rename(names), correlation=found, **told)
    for pair in pairs:
        if pair.signal.name not in swapped:
            yield from _of_signal(pair)


def names_beside(dataset: Dataset, model: Model, known: Collection[str] = ()) -> Iterator[Finding]:
    """Findings of signals that the model does not have, and of its inputs without a signal.

    Args:
        known: inputs that are set to a constant value.
    """
    logs = [record for record in dataset.logs() if isinstance(record.data, Record)]
    if not logs:
        return
    variables = {v.name: v for v in model.variables}
    sides = {side: [v for v in model.variables if v.causality == side] for side in ("input", "output")}
    for signal in dataset.signals:
        variable = variables.get(signal.variable)
        if variable is None or not variable.moves:
            own = ", ".join(v.name for v in sides[signal.role]) or f"its {signal.role}s, of which there are none"
            more = {"still": variable.name} if variable else {}
            yield finding(FindingCode.NOT_IN_MODEL, logs[0].source, signal=signal.name, known=own, **more)
    driven = [signal.variable for signal in dataset.signals if signal.role == "input"]
    rates = model.rate_inputs(driven)
    for one in sides["input"]:
        if not (one.name in (*driven, *rates, *known) or one.name.startswith("probe.")):
            told = {"signal": one.name, "unit": "" if one.unit == "1" else one.unit}
            yield finding(FindingCode.NOT_DRIVEN, logs[0].source, value=one.start or 0.0, **told)


def _pair(dataset: Dataset, answers: Mapping[str, Record], signal: MeasuredSignal) -> _Pair | None:
    """The pair of one signal; None if it was not simulated, or if the measured or simulated signal is constant."""
    logs, unit = [], ""
    for record in dataset.logs():
        log, answer = record.data, answers.get(record.source)
        if not isinstance(log, Record) or answer is None or signal.name not in log.names:
            continue
        name = next((name for name in (signal.variable, signal.name) if name in answer.names), None)
        if name is None:
            continue
        there = np.isfinite(log[signal.name]) & (log.time >= answer.time[0]) & (log.time <= answer.time[-1])
        if np.count_nonzero(there) < 2:
            continue
        time, y = log.time[there], log[signal.name][there]
        s = np.interp(time, answer.time, answer[name])
        unit, levels = unit or answer.units[answer.names.index(name)], (float(y.mean()), float(s.mean()))
        logs.append(_Log(record.source, short_name(dataset, record), y - levels[0], s - levels[1], levels))
    pair = _Pair(signal, unit, tuple(logs))
    return pair if logs and np.ptp(pair.whole.measured) and np.ptp(pair.whole.own) else None


def _correlation(one: Array, other: Array) -> float:
    size = math.sqrt((one @ one) * (other @ other))
    return float(one @ other) / size if size else 0.0


def _swapped(one: _Pair, other: _Pair) -> float | None:
    """The smaller correlation with the other's simulated signal, if both far exceed those with their own; else None."""
    a, b = one.whole, other.whole
    if one.signal.unit != other.signal.unit or a.own.size != b.own.size:
        return None
    crossed = abs(_correlation(a.measured, b.own)), abs(_correlation(b.measured, a.own))
    straight = abs(a.correlation), abs(b.correlation)
    if min(crossed) < _SETTINGS.follows or 2 - sum(crossed) > _SETTINGS.swapped * (2 - sum(straight)):
        return None
    return min(crossed)


def _of_signal(pair: _Pair) -> Iterator[Finding]:
    signal, logs = pair.signal, pair.telling
    known = conversion(pair.unit, signal.unit)
    if known is None:
        if pair.unit in UNITS and signal.unit in UNITS and pair.whole.follows:
            yield _calibrated(pair)
        return
    most = max((abs(log.correlation) for log in logs), default=0.0)
    least = min(_SETTINGS.follows, _SETTINGS.alike * most) if most >= _SETTINGS.follows else math.inf
    right = any(log.correlation >= least for log in logs)
    wrong = [log for log in logs if log.correlation <= -least]
    if right:
        wrong = [log for log in wrong if log.correlation <= -_SETTINGS.turned_tone or not log.is_tone]
    if wrong:
        some = tuple(log.name for log in wrong) if right else ()
        cure, how = Flip((signal.name,), some), _in_a_row(wrong).correlation
        yield _of_logs(FindingCode.SIGN, pair, wrong, cure, signal=signal.name, correlation=how)
    slips = _slips(logs, known[0], _OF_UNIT.get(signal.unit, _FACTORS))
    for factor in dict.fromkeys(slips.values()):
        if factor != 1:
            those = [log for log in logs if slips.get(log.source) == factor]
            some = tuple(log.name for log in those) if len({*slips.values()}) > 1 else ()
            scaled = Scaled(signal.name, float(f"{1 / factor:.10g}"), logs=some)
            yield _of_logs(FindingCode.FACTOR, pair, those, scaled, signal=signal.name, factor=factor)


def _of_logs(code: FindingCode, pair: _Pair, logs: Sequence[_Log], cure: Flip | Scaled, **told: float | str) -> Finding:
    """A finding of some logs; it names them if its cure does."""
    more = {"logs": ", ".join(cure.logs)} if cure.logs else {}
    return finding(code, logs[0].source or pair.logs[0].source, cure, **told, **more)


def _slips(logs: Sequence[_Log], unit: float, factors: tuple[float, ...]) -> dict[str, float]:
    """Source of a log that can tell -> the factor by which its signal is wrong, 1 if it is right.

    Args:
        unit: of the simulated signal in that of the measured one.
        factors: that are known.
    """
    every = [f for one in factors for f in (one, 1 / one)]
    far = [f for f in every if abs(math.log(f)) > math.log(_SETTINGS.beyond_effects)]
    found, rough = dict[str, float](), dict[str, float]()
    for log in logs:
        gain, ratio = math.log(abs(log.gain) / unit) if log.follows else math.inf, log.ratio
        size = 0.0 if ratio is None else math.log(ratio / unit)
        factor = _closest(every, gain)
        if abs(gain - math.log(factor)) < math.log(_SETTINGS.near_factor):
            found[log.source] = factor
        elif abs(size) > math.log(_SETTINGS.beyond_effects):
            factor = _closest(far, size)
            if abs(size - math.log(factor)) <= _SETTINGS.rough * abs(math.log(factor)):
                rough[log.source] = factor
        elif log.follows or ratio is not None:
            found[log.source] = 1.0
    if 1.0 in found.values():  # a plant that hardly moves in one log, as in its dead band, may be measured right there
        rough = {source: f for source, f in rough.items() if abs(math.log(f)) > math.log(_SETTINGS.beyond_rest)}
    return found | rough


def _closest(factors: Sequence[float], size: float) -> float:
    return min(factors, key=lambda factor: abs(size - math.log(factor)))


def _calibrated(pair: _Pair) -> Finding:
    """Finding of a raw sensor value, with factor and offset to the model's quantity by regression."""
    signal, whole = pair.signal, pair.whole
    factor = float(f"{1 / whole.gain:.4g}")
    offset = whole.levels[1] - factor * whole.levels[0]
    small = _SETTINGS.no_offset * float(np.ptp(whole.own))
    offset = 0.0 if abs(offset) < small else float(f"{offset:.4g}")
    cure = Scaled(signal.name, factor, offset, pair.unit, signal.unit)
    told = {"signal": signal.name, "unit": signal.unit, "wanted": pair.unit}
    return finding(FindingCode.QUANTITY, pair.logs[0].source, cure, factor=factor, **told)
