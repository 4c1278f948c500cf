"""What makes measurements differ from a model though no physics is missing: sensors, loggers, wrong starts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.adapter import Target
from pysim.identify.greybox.sine_log import SineLog
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.identify.greybox.time_log import TimeLog

Array = NDArray[np.float64]

GAIN, OFFSET, SHIFT = "gain", "offset", "shift"

# Usual sizes of sensors' gains, of offsets in shares of the full scale, and of shifts between loggers in s, no less
# than a quarter of a sample. A reading from -1 to 1 is that of a valve's own spool: its loop holds what it reads, so
# that an offset of the sensor is one of the valve, and only the logger's is left.
_GAIN, _OFFSET, _OWN, _SHIFT, _SAMPLES = 0.01, 0.005, 0.001, 1e-3, 0.25
# What a suspect of unknown size may do, in standard deviations of the noise; a tenth of it counts for nothing.
_ANY = 1e7


@dataclass(frozen=True)
class Suspect:
    """A nuisance that the data may hold.

    Args:
        kind: GAIN (share beyond 1), OFFSET (the signal's unit) or SHIFT (s by which outputs are logged late).
        dataset: where.
        signal: of which column; "" for all of the data set.
        width: standard deviation of what such sensors and loggers have, in the unit of the kind; infinite where
            nothing is known of it.
    """

    kind: str
    dataset: str
    signal: str
    width: float = field(default=math.inf, compare=False)


@dataclass(frozen=True)
class Span:
    """What the suspects can do to all residuals together, and what of it counts.

    Noise and suspects of normal sizes make residuals of covariance I + U s^2 U'. Taken across, they are multiplied with
    its inverse root and are white again: a suspect of unknown size counts for nothing, one that would have to be many
    widths off still shows.

    Args:
        columns: (n_r, k), one unit of each.
        basis: (n_r, rank) U, orthonormal.
        kept: (rank,) 1 / sqrt(1 + s^2), the share of each direction that counts.
    """

    columns: Array
    basis: Array
    kept: Array

    @property
    def rank(self) -> int:
        """Directions."""
        return int(self.basis.shape[1])

    @property
    def freedom(self) -> int:
        """Residuals that the suspects take, to a whole number."""
        return round(float(np.sum(1 - self.kept**2)))

    @staticmethod
    def of(columns: Array, widths: Array) -> Span:
        """Directions in which hardly anything happens are left out."""
        sizes = np.linalg.norm(columns, axis=0)
        there = sizes > 0
        if not there.any():
            return Span(columns, np.zeros((columns.shape[0], 0)), np.zeros(0))
        u, s, _ = np.linalg.svd(columns[:, there] * np.minimum(widths[there], _ANY / sizes[there]), full_matrices=False)
        kept = s > max(1e-2, 1e-6 * s[0])
        share = np.where(s < 0.1 * _ANY, 1 / np.sqrt(1 + s**2), 0.0)
        return Span(columns, np.ascontiguousarray(u[:, kept]), share[kept])

    def along(self, rows: Array) -> Array:
        """Components (rank, m) of rows (n_r, m)."""
        return np.asarray(self.basis.T @ rows) if self.rank else np.zeros((0, rows.shape[1]))

    def across(self, rows: Array) -> Array:
        """What of rows (n_r, m) counts."""
        return rows - self.taken(self.along(rows)) if self.rank else rows

    def undone(self, rows: Array) -> Array:
        """The rows (n_r, m) of which these are what counts; nothing comes back along a suspect of unknown size."""
        back = np.divide(1.0, self.kept, out=np.ones_like(self.kept), where=self.kept > 0) - 1
        return rows + self.basis @ (back[:, None] * self.along(rows)) if self.rank else rows

    def taken(self, along: Array) -> Array:
        """What does not count (n_r, m) of rows with components (rank, m)."""
        return np.asarray(self.basis @ ((1 - self.kept)[:, None] * along))


NOTHING = Span(np.zeros((0, 0)), np.zeros((0, 0)), np.zeros(0))
"""The span of no suspect."""


def suspects(targets: Sequence[Target]) -> tuple[Suspect, ...]:
    """A gain and an offset of each logged output, and a shift of each data set's outputs against its commands."""
    found: dict[Suspect, float] = {}
    for target in targets:
        parts = [target] if isinstance(target, TimeLog) else target.logs if isinstance(target, SteppedSines) else ()
        for part in parts:
            dataset, data = target.dataset, part.measured
            for name, unit in zip(data.names, data.units, strict=True):
                scale = 100.0 if unit == "%" else float(np.max(np.abs(data[name])))
                usual = _OWN if unit == "1" else _OFFSET * scale
                found[Suspect(GAIN, dataset, name)] = _GAIN
                offset = Suspect(OFFSET, dataset, name)
                found[offset] = max(found.get(offset, 0.0), usual)
            shift = Suspect(SHIFT, dataset, "")
            interval = float(np.median(np.diff(data.time))) if data.time.size > 1 else 0.0
            found[shift] = max(found.get(shift, 0.0), _SHIFT, _SAMPLES * interval)
    return tuple(replace(suspect, width=width) for suspect, width in found.items())


def columns(target: Target, simulated: Sequence[Array], suspected: Sequence[Suspect]) -> Array:
    """What one unit of each suspect adds to a target's weighted residuals, (n, k).

    Args:
        simulated: (n_t, n_y) of each of the target's runs, by a model near the plant: the measured signals would bring
            their noise along, and noise explains itself.
    """
    if isinstance(target, TimeLog):
        level = simulated[0]
        one, rate = np.ones_like(level), _rate(target.measured.time, level)
        return _placed(target.dataset, target.measured.names, np.array(target.noise), suspected, (level, one, rate))
    if isinstance(target, SteppedSines):
        pairs = zip(target.logs, simulated, strict=True)
        return np.concatenate([_sine_columns(target.dataset, log, values, suspected) for log, values in pairs])
    # magnitudes and phases of a response that exists as a table only: it has lost its means and its clock
    return np.zeros((2 * len(target.runs), len(suspected)))


def _placed(
    dataset: str, names: tuple[str, ...], noise: Array, suspected: Sequence[Suspect], shapes: tuple[Array, ...]
) -> Array:
    """Level, one and rate (n, n_y) of one log in the columns of its suspects."""
    level, one, rate = shapes
    found = np.zeros((*level.shape, len(suspected)))
    for k, suspect in enumerate(suspected):
        if suspect.dataset != dataset:
            continue
        shape = {GAIN: level, OFFSET: one, SHIFT: rate}[suspect.kind] / noise
        for j, name in enumerate(names):
            if suspect.signal in ("", name):
                found[:, j, k] = shape[:, j]
    return found.reshape(-1, len(suspected))


def _rate(time: Array, values: Array) -> Array:
    """Of signals (n_t, n_y) over time, by parabolas, and by quartics inside of an evenly sampled log."""
    rate = np.gradient(values, time, axis=0, edge_order=2 if time.size > 2 else 1)
    interval = np.diff(time)
    if time.size > 8 and np.ptp(interval) < 1e-3 * interval.mean():
        wide = values[:-4] - 8 * values[1:-3] + 8 * values[3:-1] - values[4:]
        rate[2:-2] = wide / (12 * interval.mean())
    return np.asarray(rate)


def _sine_columns(dataset: str, log: SineLog, values: Array, suspected: Sequence[Suspect]) -> Array:
    q, r = log.factors
    level = log.onto @ values
    swings = np.linalg.solve(r, level)
    rates = np.zeros_like(swings)
    turn = 2 * np.pi * log.sine.frequency * np.arange(1, log.count + 1)[:, None]
    rates[1::2], rates[2::2] = -turn * swings[2::2], turn * swings[1::2]
    one = np.tile(q.sum(axis=0)[:, None], (1, level.shape[1]))
    return _placed(dataset, log.measured.names, np.array(log.noise), suspected, (level, one, r @ rates))


def undisturbed(targets: Sequence[Target], amounts: Mapping[Suspect, float]) -> tuple[Target, ...]:
    """What would have been measured without nuisances of these sizes."""
    return tuple(_target(target, amounts) for target in targets) if amounts else tuple(targets)


def _target(target: Target, amounts: Mapping[Suspect, float]) -> Target:
    """A target as it would have been measured without nuisances of these sizes."""
    if isinstance(target, TimeLog):
        late = amounts.get(Suspect(SHIFT, target.dataset, ""), 0.0)
        values, noise = _undone(target, target.dataset, amounts)
        run = target.run.experiment
        times = np.maximum(run.times + late, run.start + 1e-9 * np.arange(run.times.size))
        measured = replace(target.measured, values=values, time=target.measured.time + late)
        moved = replace(target.run, experiment=replace(run, times=times))
        return replace(target, measured=measured, noise=noise, run=moved)
    if isinstance(target, SteppedSines):
        late, logs = amounts.get(Suspect(SHIFT, target.dataset, ""), 0.0), []
        for log in target.logs:
            values, noise = _undone(log, target.dataset, amounts)
            measured = replace(log.measured, values=values, time=log.measured.time + late)
            logs.append(replace(log, measured=measured, noise=noise))
        return replace(target, logs=tuple(logs))
    return target


def _undone(log: TimeLog | SineLog, dataset: str, amounts: Mapping[Suspect, float]) -> tuple[Array, tuple[float, ...]]:
    """Values and noise with gains and offsets taken off."""
    names = log.measured.names
    gains = np.array([1 + amounts.get(Suspect(GAIN, dataset, name), 0.0) for name in names])
    offsets = np.array([amounts.get(Suspect(OFFSET, dataset, name), 0.0) for name in names])
    return (log.measured.values - offsets) / gains, tuple((np.array(log.noise) / gains).tolist())
