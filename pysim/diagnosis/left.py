"""What a model leaves: the residual's size over the noise floor, and whether the model's own signals predict it.

Source: Ljung 1999, Lecture Notes in Control and Information Sciences 245:97 (the model-error model).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.refit import FinalFit, begin
from pysim.diagnosis.rivals import of
from pysim.identify.greybox.noise import white_floor
from pysim.identify.greybox.residuals import Channel
from pysim.types import Dataset, Record
from pysim.types.answer import FloorSource, NoiseFloor

Array = NDArray[np.float64]

# Of the regression: lags of the signals in samples, ridge penalties over the information of a block on a regressor,
# and the fewest samples per regressor.
_LAGS = (0, 1, 2, 4, 8, 16, 32, 64)
_RIDGES = (1e-3, 1e-2, 1e-1, 1.0, 10.0)
_SAMPLES = 30


@dataclass(frozen=True)
class Follows:
    """How far the model's own signals predict a residual.

    Args:
        share: of the residual's sum of squares that a regression predicts on blocks left out, 0 ... 1.
        t: t statistic of that share, from its scatter over the blocks.
    """

    share: float
    t: float


@dataclass(frozen=True)
class Floors:
    """The noise floor of each channel (data set and signal), as far as the models so far show it.

    Args:
        floors: channel -> the least white-noise level in any model's residual; the specified noise if that is larger.
    """

    floors: Mapping[Channel, NoiseFloor] = field(default_factory=dict)

    def with_(self, fit: FinalFit) -> Floors:
        """The floors with another model's residual: the lower one for each channel."""
        found = dict(self.floors)
        for channel, floor in white_floors(fit).items():
            if channel not in found or floor.sd < found[channel].sd:
                found[channel] = floor
        return Floors(found)

    @property
    def sd(self) -> dict[Channel, float]:
        """Standard deviation of the noise of each channel."""
        return {channel: floor.sd for channel, floor in self.floors.items()}

    def over(self, fit: FinalFit) -> dict[Channel, float]:
        """Root mean square residual over the floor, per channel."""
        residuals = fit.candidate.residuals(fit.simulation)
        sizes = np.sqrt(fit.point.squares / np.maximum(residuals.samples, 1.0))
        return {c: float(size) / self.floors[c].sd for c, size in zip(residuals.channels, sizes, strict=True)}

    def whole(self, fit: FinalFit) -> float:
        """Root mean square residual over the floors, of all fitted channels together."""
        residuals = fit.candidate.residuals(fit.simulation)
        counts = dict(zip(residuals.channels, residuals.samples.tolist(), strict=True))
        total = sum(counts[channel] * ratio**2 for channel, ratio in self.over(fit).items())
        return math.sqrt(total / max(sum(counts.values()), 1.0))

    def rows(self, fit: FinalFit) -> Array:
        """(n_r,) noise floor of each measured row."""
        series = fit.candidate.residuals(fit.simulation).series
        sizes = [1.0 if name is None else self.floors[one.dataset, name].sd for one, name in series]
        return np.array(sizes)[of(fit).series]

    def between(self, fit: FinalFit, other: FinalFit) -> float:
        """Root mean square difference over the floors of the residuals of two simulations of one model."""
        return float(np.sqrt(np.mean(((of(fit).residual - of(other).residual) / self.rows(fit)) ** 2)))

    def roughest(self, fit: FinalFit, error: float) -> FinalFit:
        """The fit simulated with the largest tolerance that changes its residual by less than `error` floors.
        With a larger one, the cost would jump between iterations by more than an effect or a law gains."""
        simulation = fit.simulation.rough()
        while simulation.solver.rtol > fit.simulation.solver.rtol:
            rough = begin(fit.candidate, fit.values, simulation, fit)
            if rough.good and self.between(fit, rough) < error:
                return rough
            simulation = simulation.finer()
        return fit

    def within(self, fit: FinalFit, factor: float) -> bool:
        """Whether the root mean square residual of every channel is below `factor` times its floor."""
        return all(ratio < factor for ratio in self.over(fit).values())

    def avoidable(self, fit: FinalFit) -> float:
        """Avoidable sum of squares: what the residuals have beyond the noise floors, over the floors' variances."""
        samples = fit.candidate.residuals(fit.simulation).samples
        squares = np.square(list(self.over(fit).values()))
        return float(np.sum(samples * np.maximum(squares - 1.0, 0.0)))

    def potential(self, fit: FinalFit) -> float:
        """Nats (log-likelihood) by which a model that left only the noise floors would be better."""
        residuals = fit.candidate.residuals(fit.simulation)
        counts = dict(zip(residuals.channels, residuals.samples.tolist(), strict=True))
        return sum(counts[c] * math.log(max(ratio, 1.0)) for c, ratio in self.over(fit).items())


def white_floors(fit: FinalFit) -> dict[Channel, NoiseFloor]:
    """White-noise level of a model's residual in each channel, never below the channel's specified or least level."""
    residuals = fit.candidate.residuals(fit.simulation)
    problem, found = fit.candidate.problem, dict[Channel, NoiseFloor]()
    parts = _columns(fit)
    rests: dict[Channel, tuple[float, float]] = {}
    for one in residuals.observations:
        if one.domain == "time":
            continue
        rows = np.bincount(one.channel_of_row, minlength=len(one.channels)) if one.channels else ()
        for name, rest, samples, count in zip(one.channels, one.rest, one.samples, rows, strict=True):
            square, number = rests.get((one.dataset, name), (0.0, 0.0))
            rests[one.dataset, name] = square + float(rest), number + float(samples) - float(count)
    for channel, least in problem.floors.items():
        own = parts.get(channel, [])
        white = white_floor(own, problem.settings)
        if white is None:  # no stretch without a missing sample is long enough
            white = white_floor([rest[np.isfinite(rest)] for rest in own], problem.settings)
        seen = [] if white is None else [white]
        if channel in rests and rests[channel][1] > 0:
            seen.append(math.sqrt(rests[channel][0] / rests[channel][1]))
        if seen and min(seen) > least.sd:
            found[channel] = NoiseFloor(min(seen), FloorSource.SPECTRUM)
        else:
            found[channel] = least
    return found


def follows(fit: FinalFit, dataset: Dataset, blocks: int) -> Follows | None:
    """Regress the residuals of logs over time on the model's own inputs and outputs (model-error model).

    Args:
        dataset: the fitted data set, with its inputs.
        blocks: number of contiguous pieces over which the regression is cross-validated.
    Returns:
        the channel with the largest t; None where all have too few samples.
    """
    tables = list(_regressors(fit, dataset))
    if not tables:
        return None
    names = {channel for _, rests in tables for channel in rests}
    found = [one for name in sorted(names) if (one := _regression(tables, name, blocks)) is not None]
    return max(found, key=lambda one: one.t, default=None)


def _columns(fit: FinalFit) -> dict[Channel, list[Array]]:
    """Residuals of the logs over time, (n_t,) each, in the channels' units; not-a-number where nothing was measured."""
    found: dict[Channel, list[Array]] = {}
    for _, rests in logs(fit):
        for channel, rest in rests.items():
            found.setdefault(channel, []).append(rest)
    return found


def logs(fit: FinalFit) -> Iterator[tuple[str, dict[Channel, Array]]]:
    """Source of each log over time that was fitted, and its residuals by channel; of a long log, rows of triangles.

    A residual is not-a-number where nothing was measured.
    """
    left, found = of(fit), dict[str, dict[Channel, Array]]()
    for number, (one, name) in enumerate(fit.candidate.residuals(fit.simulation).series):
        if one.domain == "time" and name is not None:
            rows = left.residual[left.series == number]
            there = np.isfinite(one.runs[0].measured[:, one.channels.index(name)])
            if not there.all() and rows.size == np.count_nonzero(there):
                rows, own = np.full(there.size, np.nan), rows
                rows[there] = own
            found.setdefault(one.sources[0], {})[one.dataset, name] = rows
    yield from found.items()


def _regressors(fit: FinalFit, dataset: Dataset) -> Iterator[tuple[Array, dict[Channel, Array]]]:
    """Per log the regressors (n_t, m), made of signals that every log has, and the residuals by channel."""
    records = {record.source: record.data for record in dataset.records}
    found = []
    for source, rests in logs(fit):
        record = records[source]
        if not isinstance(record, Record) or any(rest.size != record.time.size for rest in rests.values()):
            continue
        simulated = {name: record[name] - rest for (_, name), rest in rests.items() if name in record.names}
        others = {name: record[name] for name in record.names if name not in simulated}
        simulated = {name: _bridged(record.time, values) for name, values in simulated.items()}
        others = {name: _bridged(record.time, values) for name, values in others.items() if np.isfinite(values).any()}
        found.append((others | simulated, rests))
    if not found:
        return
    names = [name for name in found[0][0] if all(name in signals for signals, _ in found)]
    tables = [np.column_stack([signals[name] for name in names]) for signals, _ in found]
    lags = [lag for lag in _LAGS if lag < min(map(len, tables)) // 4]
    whole = np.concatenate(tables)
    scale = whole.mean(axis=0), np.maximum(whole.std(axis=0), np.finfo(float).tiny)
    for table, (_, rests) in zip(tables, found, strict=True):
        yield _features((table - scale[0]) / scale[1], lags), rests


def _bridged(time: Array, values: Array) -> Array:
    """A regressor (n_t,), with straight lines where nothing was measured: there, the residual has no sample either."""
    there = np.isfinite(values)
    return values if there.all() else np.interp(time, time[there], values[there])


def _features(signals: Array, lags: Sequence[int]) -> Array:
    """Regressors (n_t, m): lagged, squared, absolute and signed copies of scaled signals (n_t, k), and their rates."""
    n = len(signals)
    parts = [np.ones((n, 1))]
    parts += [np.vstack([np.repeat(signals[:1], lag, axis=0), signals[: n - lag]]) for lag in lags]
    rate = np.gradient(signals, axis=0)
    rate = rate / np.maximum(rate.std(axis=0), np.finfo(float).tiny)
    sign = np.tanh(3 * rate)
    parts += [rate, sign, np.abs(rate), signals**2, signals**3, rate * np.abs(rate), np.abs(signals)]
    parts += [np.maximum(signals - 1, 0), np.minimum(signals + 1, 0), signals * np.abs(rate), sign * signals]
    return np.column_stack(parts)


def _regression(tables: list[tuple[Array, dict[Channel, Array]]], channel: Channel, count: int) -> Follows | None:
    """Ridge regression of one channel's residual; penalty and gain come from cross-validation over blocks."""
    own = [(table, rests[channel]) for table, rests in tables if channel in rests]
    table = np.concatenate([rows for rows, _ in own])
    rest = np.concatenate([values for _, values in own])
    table, rest = table[np.isfinite(rest)], rest[np.isfinite(rest)]
    n, m = table.shape
    if n < _SAMPLES * m:
        return None
    table = table / np.maximum(np.sqrt(np.mean(table**2, axis=0)), np.finfo(float).tiny)
    blocks = np.arange(n) * count // n
    inner = [table[blocks == b].T @ table[blocks == b] for b in range(count)]
    outer = [table[blocks == b].T @ rest[blocks == b] for b in range(count)]
    best = Follows(0.0, 0.0)
    for ridge in _RIDGES:
        gains = np.empty(count)
        for b in range(count):
            kept = sum(inner) - inner[b] + ridge * n / count * np.eye(m)
            moved = np.linalg.solve(kept, sum(outer) - outer[b])
            part = rest[blocks == b]
            gains[b] = float(part @ part) - float(np.sum((part - table[blocks == b] @ moved) ** 2))
        spread = float(gains.std(ddof=1)) * math.sqrt(count)
        share = float(gains.sum()) / max(float(rest @ rest), np.finfo(float).tiny)
        if share > best.share:
            best = Follows(share, float(gains.sum()) / spread if spread > 0 else 0.0)
    return best
