"""Comparison of logs with a model's simulation: wrong signs, units and columns."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.data_check.finding import Finding, FindingCode, finding
from pysim.io.prepare import Flip, Rename, Scaled
from pysim.types import UNITS, Dataset, MeasuredSignal, Model, Record, conversion

Array = NDArray[np.float64]

_FOLLOWS = 0.7  # absolute correlation above which a signal follows the simulated one, or its negative
_NEAR = 1.5  # ratio to a factor below, up to which a gain counts as that factor; the model's own gain may be wrong
_FACTORS = (10.0, 60.0, 1000.0)  # usual factors between units that are mixed up; by unit these instead
_OF_UNIT: Mapping[str, tuple[float, ...]] = {
    "rad": (180 / math.pi,),
    "rad/s": (180 / math.pi, 30 / math.pi),
    "Pa": (1e5, 10.0, 1000.0),
    "m3/s": (6e4, 60.0, 1000.0),
}
_OFFSET = 0.02  # share of a signal's range below which an offset of its regression is set to zero


@dataclass(frozen=True)
class _Pair:
    """A measured signal and the simulated one, of all logs in a row, each log without its mean.

    Args:
        signal: the signal of the data set.
        source: source of the first log.
        unit: unit of the simulated signal.
        measured: (n,).
        own: (n,) simulated.
        levels: means of both in the first log.
    """

    signal: MeasuredSignal
    source: str
    unit: str
    measured: Array
    own: Array
    levels: tuple[float, float]

    @property
    def gain(self) -> float:
        """Measured over simulated signal, by least squares."""
        return float(self.measured @ self.own / (self.own @ self.own))


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
            yield finding(FindingCode.SWAPPED, one.source, Rename(names), correlation=found, **told)
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
    measured, own, levels, first, unit = [], [], None, "", ""
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
        y, s = log[signal.name][there], np.interp(log.time[there], answer.time, answer[name])
        unit, first = answer.units[answer.names.index(name)], first or record.source
        levels = levels or (float(y.mean()), float(s.mean()))
        measured.append(y - y.mean())
        own.append(s - s.mean())
    if levels is None or not np.ptp(np.concatenate(measured)) or not np.ptp(np.concatenate(own)):
        return None
    return _Pair(signal, first, unit, np.concatenate(measured), np.concatenate(own), levels)


def _correlation(one: Array, other: Array) -> float:
    return float(one @ other / math.sqrt((one @ one) * (other @ other)))


def _swapped(one: _Pair, other: _Pair) -> float | None:
    """The smaller correlation with the other's simulated signal, if both far exceed those with their own; else None."""
    if one.signal.unit != other.signal.unit or one.own.size != other.own.size:
        return None
    crossed = abs(_correlation(one.measured, other.own)), abs(_correlation(other.measured, one.own))
    straight = abs(_correlation(one.measured, one.own)), abs(_correlation(other.measured, other.own))
    if min(crossed) < _FOLLOWS or 2 - sum(crossed) > 0.5 * (2 - sum(straight)):
        return None
    return min(crossed)


def _of_signal(pair: _Pair) -> Iterator[Finding]:
    signal, correlation = pair.signal, _correlation(pair.measured, pair.own)
    if abs(correlation) < _FOLLOWS:
        return
    known = conversion(pair.unit, signal.unit)
    if known is None:
        if pair.unit in UNITS and signal.unit in UNITS:
            yield _calibrated(pair)
        return
    if correlation < 0:
        yield finding(FindingCode.SIGN, pair.source, Flip((signal.name,)), signal=signal.name, correlation=correlation)
    gain = abs(pair.gain) / known[0]
    factors = _OF_UNIT.get(signal.unit, _FACTORS)
    near = [f for one in factors for f in (one, 1 / one) if 1 / _NEAR < gain / f < _NEAR]
    if near:
        factor = min(near, key=lambda f: abs(math.log(gain / f)))
        cure = Scaled(signal.name, float(f"{1 / factor:.10g}"))
        yield finding(FindingCode.FACTOR, pair.source, cure, signal=signal.name, factor=factor)


def _calibrated(pair: _Pair) -> Finding:
    """Finding of a raw sensor value, with factor and offset to the model's quantity by regression."""
    signal = pair.signal
    factor = float(f"{1 / pair.gain:.4g}")
    offset = pair.levels[1] - factor * pair.levels[0]
    small = _OFFSET * float(np.ptp(pair.own))
    offset = 0.0 if abs(offset) < small else float(f"{offset:.4g}")
    cure = Scaled(signal.name, factor, offset, pair.unit, signal.unit)
    told = {"signal": signal.name, "unit": signal.unit, "wanted": pair.unit}
    return finding(FindingCode.QUANTITY, pair.source, cure, factor=factor, **told)
