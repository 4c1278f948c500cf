"""Makes the residuals of a target independent: what earlier samples tell of the noise is taken off each one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded

from pysim.diagnose.adapter import Residual, Target, over_noise
from pysim.diagnose.noise import Column, Noise, white
from pysim.identify.greybox.observation import Simulated
from pysim.identify.greybox.sine_log import SineLog
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.identify.greybox.time_log import TimeLog

Array = NDArray[np.float64]


class Whitening(Protocol):
    """A linear map of a target's residuals, slopes alike."""

    @property
    def size(self) -> int:
        """Rows that come out."""
        ...

    @property
    def parts(self) -> tuple[int, ...]:
        """Rows of each log of the target."""
        ...

    def of(self, rows: Array) -> Array:
        """Rows (n, m) as the target weighs them -> (size, m), independent and of variance 1."""
        ...


def whitening(target: Target, noise: Mapping[Column, Noise], skip: float = 0.0) -> Whitening:
    """What a target's residuals need.

    Args:
        noise: of each signal; white as the target has it where it is not named.
        skip: s at the start of a log over time that do not count.
    """
    if isinstance(target, TimeLog):
        return _log(target, noise, skip)
    if isinstance(target, SteppedSines):
        sizes = tuple(2 * log.count + 1 for log in target.logs)
        return Harmonics(tuple(_harmonics(target.dataset, log, noise) for log in target.logs), sizes)
    return Untouched(over_noise(target, _swings(target)).values.size)


def whitened(whitening: Whitening, residual: Residual) -> Residual:
    """Values and slopes in one pass."""
    rows = whitening.of(np.column_stack([residual.values, residual.slopes]))
    return Residual(rows[:, 0], rows[:, 1:])


def _swings(target: Target) -> list[Simulated]:
    """A plain sine in place of each run, to count by."""
    found = []
    for run in target.runs:
        n = run.experiment.times.size
        swing = np.sin(2 * np.pi * np.arange(n) / n)[:, None] * np.ones(len(run.experiment.record))
        found.append(Simulated(swing, np.zeros((*swing.shape, 0))))
    return found


@dataclass(frozen=True)
class Untouched:
    """Rows that are independent as they are."""

    size: int

    @property
    def parts(self) -> tuple[int, ...]:
        """All rows."""
        return (self.size,)

    def of(self, rows: Array) -> Array:
        """The same rows."""
        return rows


@dataclass(frozen=True)
class Innovations:
    """A log over time, sample by sample: what could not be predicted from the samples before.

    White noise beside noise with memory is a state of one number per signal; its Kalman filter starts at rest, as
    likely as the noise itself, so that the first sample counts too.

    Args:
        first: samples left out at the start.
        kept: (n_t, n_y) share of the predicted noise that is left one sample later.
        gain: (n_t, n_y) of the prediction by what was not predicted.
        scale: (n_t, n_y) over the deviation of what was not predicted.
    Source: Kalman 1960, Journal of Basic Engineering 82:35; for likelihoods Schweppe 1965, IEEE Transactions on
        Information Theory 11:61.
    """

    first: int
    kept: Array
    gain: Array
    scale: Array

    @property
    def size(self) -> int:
        """Rows that come out."""
        return int(self.scale.size)

    @property
    def parts(self) -> tuple[int, ...]:
        """All rows."""
        return (self.size,)

    def of(self, rows: Array) -> Array:
        """Samples in order, signal by signal within each."""
        signals = self.scale.shape[1]
        kept = np.ascontiguousarray(rows.reshape(-1, signals, rows.shape[1])[self.first :])
        if not self.gain.any():
            return (kept * self.scale[:, :, None]).reshape(-1, rows.shape[1])
        return np.asarray(_innovations(kept, self.kept, self.gain, self.scale)).reshape(-1, rows.shape[1])


@dataclass(frozen=True)
class Harmonics:
    """Stepped sines: the harmonics of one log and signal depend on each other where their noise has memory.

    Args:
        logs: per log and signal the triangle (n_h, n_h) that undoes it, or None.
        sizes: n_h of each log.
    """

    logs: tuple[tuple[Array | None, ...], ...]
    sizes: tuple[int, ...]

    @property
    def size(self) -> int:
        """Rows that come out."""
        return sum(self.parts)

    @property
    def parts(self) -> tuple[int, ...]:
        """Rows of each sine."""
        return tuple(size * len(log) for size, log in zip(self.sizes, self.logs, strict=True))

    def of(self, rows: Array) -> Array:
        """Log by log, harmonic by harmonic, signal by signal within each."""
        if all(undo is None for log in self.logs for undo in log):
            return rows
        found, place = np.array(rows), 0
        for size, log in zip(self.sizes, self.logs, strict=True):
            own = found[place : place + size * len(log)].reshape(size, len(log), -1)
            for j, undo in enumerate(log):
                if undo is not None:
                    own[:, j] = undo @ own[:, j]
            place += size * len(log)
        return found


def _log(target: TimeLog, noise: Mapping[Column, Noise], skip: float) -> Innovations:
    time = target.measured.time
    first = int(np.searchsorted(time, time[0] + skip - 1e-9)) if skip > 0 else 0
    steps = np.diff(time[first:])
    columns = [
        _filter(steps, noise.get((target.dataset, name), white(size)), size)
        for name, size in zip(target.measured.names, target.noise, strict=True)
    ]
    kept, gain, scale = (np.ascontiguousarray(np.stack(part, axis=1)) for part in zip(*columns, strict=True))
    return Innovations(first, kept, gain, scale)


def _filter(steps: Array, noise: Noise, unit: float) -> tuple[Array, Array, Array]:
    """The Kalman filter of one signal's noise, in units of what the target divides by."""
    n = steps.size + 1
    if noise.coloured == 0.0:
        return np.zeros(n), np.zeros(n), np.full(n, unit / noise.white)
    kept = np.append(np.exp(-steps / noise.memory), 0.0)
    gain, scale = _gains(kept, (noise.white / unit) ** 2, (noise.coloured / unit) ** 2)
    return kept, gain, scale


def _gains(kept: Array, white: float, coloured: float) -> tuple[Array, Array]:
    gain, scale, unknown = [], [], coloured
    for share in kept.tolist():
        total = unknown + white
        gain.append(unknown / total)
        scale.append(1 / math.sqrt(total))
        unknown = share**2 * unknown * (1 - gain[-1]) + coloured * (1 - share**2)
    return np.array(gain), np.array(scale)


def _innovations(rows: Array, kept: Array, gain: Array, scale: Array) -> Array:
    """What is new in rows (n, signals, m): each is predicted by what is kept of the one before, corrected by it."""
    found = np.empty_like(rows)
    for j in range(rows.shape[1]):
        predicted = _recursion(kept[:, j] * (1 - gain[:, j]), (kept[:, j] * gain[:, j])[:, None] * rows[:, j])
        found[:, j] = (rows[:, j] - predicted) * scale[:, j, None]
    return found


def _recursion(kept: Array, added: Array) -> Array:
    """y_0 = 0 and y_t = kept_(t-1) y_(t-1) + added_(t-1), (n, m): forward substitution in two diagonals."""
    right = np.zeros_like(added)
    right[1:] = added[:-1]
    return np.asarray(solve_banded((1, 0), np.stack([np.ones_like(kept), -kept]), right, check_finite=False))


def _harmonics(dataset: str, log: SineLog, noise: Mapping[Column, Noise]) -> tuple[Array | None, ...]:
    found: list[Array | None] = []
    for name, unit in zip(log.measured.names, log.noise, strict=True):
        own = noise.get((dataset, name), white(unit))
        if own.plain:
            found.append(None)
            continue
        columns = log.factors[0]
        spread = (own.white**2 * np.eye(columns.shape[1]) + own.coloured**2 * _products(log, own, columns)) / unit**2
        found.append(np.linalg.inv(np.linalg.cholesky(spread)))
    return tuple(found)


def _products(log: SineLog, noise: Noise, columns: Array) -> Array:
    """Covariance of the columns' products with noise with memory of variance 1."""
    if noise.coloured == 0.0:
        return np.eye(columns.shape[1])
    kept = np.exp(-np.diff(log.measured.time) / noise.memory)
    weighted = columns + _carried(columns, kept) + _carried(columns[::-1].copy(), kept[::-1].copy())[::-1]
    return np.asarray(columns.T @ weighted)


def _carried(rows: Array, kept: Array) -> Array:
    """What is left of all earlier rows at each one."""
    shares = np.append(kept, 0.0)
    return _recursion(shares, shares[:, None] * rows)
