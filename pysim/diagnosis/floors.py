"""The noise floor of each channel, and a model's residuals over it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.refit import FinalFit, begin
from pysim.diagnosis.rivals import of
from pysim.identify.greybox.noise import white_floor
from pysim.identify.greybox.residuals import Channel
from pysim.types.answer import FloorSource, NoiseFloor

Array = NDArray[np.float64]


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
