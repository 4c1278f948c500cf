"""Search for the part of a log that is a wave: a sine or a chirp."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.logged.wave_fit import Wave
from pysim.types import BadInput, Record, sampling

Array = NDArray[np.float64]
Fit = Callable[[Array, Array, Wave], Wave]

# A sample off the wave is an outlier if none of this many samples after it is off too; otherwise the wave ends there.
_ALONE = 4
# Samples with residuals above this many standard deviations are left out of a fit.
_OUTLIER = 6.0
_ROUNDS = 20
# At most this many last samples are cut, if the sum of their residuals exceeds this many of its standard deviations.
_BEND, _TOGETHER = 50, 4.5


@dataclass(frozen=True)
class Log:
    """One logged column, and the resolution of its values and times.

    Args:
        time, values: (n,).
        interval: s between samples.
        step: quantisation step of the values, of the file or of a converter; 0 if none is visible.
        jitter: standard deviation of the times about an even spacing, s, due to rounding; 0 if the sampling is
            intentionally uneven.
        gap: (from, to) in s, the longest interval without samples; None if there is none.
    """

    time: Array
    values: Array
    interval: float
    step: float
    jitter: float
    gap: tuple[float, float] | None = None

    @classmethod
    def of(cls, record: Record, column: str) -> Log:
        """A column of a record.

        Raises:
            BadInput: no such column, fewer than eight samples, or one value throughout.
        """
        t, y = record.time, record[column]
        if t.size < 8 or np.ptp(y) == 0:
            moved = f"has {t.size} samples and moves by {np.ptp(y):g}"
            raise BadInput(f"{record.origin or 'record'}: {column} {moved}; there is no wave in it")
        k = np.arange(t.size) - 0.5 * (t.size - 1)
        even = t - t.mean()
        uneven = even - float(k @ even) / float(k @ k) * k
        jitter = float(np.std(uneven))
        found = sampling(t)
        longest = max(found.gaps.tolist(), key=lambda k: t[k + 1] - t[k], default=None)
        gap = None if longest is None else (float(t[longest]), float(t[longest + 1]))
        return cls(t, y, found.step, _step(y), jitter if jitter < 0.1 * (t[-1] - t[0]) / t.size else 0.0, gap)


def _step(values: Array) -> float:
    """Quantisation step of values (n,): equal steps of a converter, else the last written decimal; 0 if not visible."""
    gaps = np.diff(np.unique(values))
    reach = float(np.sum(gaps))
    gaps = gaps[gaps > 1e-9 * reach]
    least = float(np.min(gaps))
    multiples = gaps / least
    if least < 0.1 * reach and np.max(np.abs(multiples - np.round(multiples))) < 0.05:
        return least
    largest = float(np.max(np.abs(values)))
    for decimal in (10.0 ** np.arange(10)).tolist():
        near = 1e-6 + 1e-15 * largest * decimal
        parts = (some * decimal for some in (values[:8], values))  # a few values are often enough to exclude it
        if all(np.max(np.abs(part - np.round(part))) < near for part in parts):
            return 1 / decimal
    return 0.0


@dataclass(frozen=True)
class Stretch:
    """A wave, and the part of the log that it describes.

    Args:
        inside: samples that belong to the wave.
        start: s; the first of them, or the end of a hold before it.
        residual: root mean square residual of these samples.
        is_noise: whether neighbouring residuals are uncorrelated."""

    wave: Wave
    inside: slice
    start: float
    residual: float
    is_noise: bool


def grow(log: Log, start: tuple[Wave, slice], fit: Fit) -> Stretch:
    """Fit the wave, add neighbouring samples that are on it, and repeat; then cut off ramp and hold at the ends."""
    wave, inside = start
    for _ in range(_ROUNDS):
        wave = _trimmed(log, inside, wave, fit)
        error = np.abs(log.values - wave.value(log.time))
        tolerance = _tolerance(log, wave, error[inside])
        grown = _neighbours(error <= tolerance, inside)
        if grown == inside:
            break
        inside = grown
    if inside.stop < log.time.size:
        inside = _without_bend(log, wave, inside)
        wave = _trimmed(log, inside, wave, fit)
    start_time = float(log.time[inside.start])
    for _ in range(_ROUNDS if inside.start > 0 else 0):  # samples of the hold may be near the wave, and bias the fit
        start_time = _onset(log, wave, inside, tolerance)
        cut = slice(int(np.searchsorted(log.time, start_time - 1e-9)), inside.stop)
        if cut == inside:
            break
        inside = cut
        wave = _trimmed(log, inside, wave, fit)
    left_over = (log.values - wave.value(log.time))[inside]
    rms = float(np.sqrt(np.mean(left_over**2)))
    memory = float(left_over[1:] @ left_over[:-1]) / max(float(left_over @ left_over), 1e-300)
    return Stretch(wave, inside, start_time, rms, abs(memory) < 5 / np.sqrt(left_over.size))


def _without_bend(log: Log, wave: Wave, inside: slice) -> slice:
    """The stretch without the last samples if the sum of their residuals is too large: a ramp has begun there.

    Each alone may be within tolerance. Only the last quarter period counts: a faster wave leaves a ramp at once.
    """
    error = (log.values - wave.value(log.time))[inside]
    last = float(log.time[inside.stop - 1])
    quarter = 0.5 * np.pi / max(float(wave.omega_at(last)), 1e-9) / log.interval
    behind = np.arange(1, int(min(_BEND, quarter, error.size // 2)) + 1)
    if behind.size == 0:
        return inside
    together = np.abs(np.cumsum(error[::-1][: behind.size])) / np.sqrt(behind)
    most = int(np.argmax(together))
    spread = 1.4826 * float(np.median(np.abs(error))) + log.step
    return slice(inside.start, inside.stop - (int(behind[most]) if together[most] > _TOGETHER * spread else 0))


def _onset(log: Log, wave: Wave, inside: slice, tolerance: float) -> float:
    """Time at which a hold at the wave's offset ends: the last passage of the wave through its offset within the hold.

    If there is no passage, the wave starts with a jump, and the time is that of the stretch's first sample.
    """
    t = log.time[inside]
    still = np.abs(log.values[inside] - wave.offset) <= tolerance
    held = t.size if still.all() else int(np.argmin(still))
    dt = log.interval
    fine = np.arange(t[0] - 1.01 * dt, t[min(held, t.size - 1)] + 0.5 * dt, 0.1 * dt)
    half_turns = np.floor(wave.angle(fine) / np.pi)
    passages = np.flatnonzero(half_turns[1:] > half_turns[:-1])
    if passages.size == 0:
        return float(t[0])
    at = float(fine[passages[-1]])
    target = half_turns[passages[-1] + 1] * np.pi
    for _ in range(20):  # Newton iteration; the phase is a parabola that rises here
        at += float((target - wave.angle(at)) / wave.omega_at(at))
    return at


def _trimmed(log: Log, inside: slice, wave: Wave, fit: Fit) -> Wave:
    """Fit all samples of the stretch, then once more without the outliers."""
    t, y = log.time[inside], log.values[inside]
    wave = fit(t, y, wave)
    error = np.abs(y - wave.value(t))
    keep = error <= _OUTLIER * 1.4826 * np.median(error) + log.step
    return wave if keep.all() or keep.sum() < 8 else fit(t[keep], y[keep], wave)


def _tolerance(log: Log, wave: Wave, error: Array) -> float:
    spread = _OUTLIER * 1.4826 * float(np.median(error))
    late = 3 * wave.amplitude * wave.fastest(log.time) * log.jitter
    return max(spread, log.step + late, 1e-9 * wave.amplitude)


def _neighbours(good: NDArray[np.bool_], inside: slice) -> slice:
    """The stretch, extended on both sides by good samples, including single bad ones between them."""
    stop = inside.stop + _reach(good[inside.stop :])
    start = inside.start - _reach(good[: inside.start][::-1])
    return slice(start, stop)


def _reach(good: NDArray[np.bool_]) -> int:
    """Number of first samples that belong: up to the first bad one that is soon followed by another, or by the end."""
    bad = np.append(np.flatnonzero(~good), good.size)
    crowded = np.diff(bad, append=bad[-1]) <= _ALONE
    return int(bad[np.argmax(crowded)])


def wander(values: Array, dead_band: float) -> float:
    """Path length of values (n,) less the distance from first to last; moves within the dead band do not count."""
    position, path = float(values[0]), 0.0
    for value in values:
        moved = max(float(value) - position - dead_band, 0.0) + min(float(value) - position + dead_band, 0.0)
        position, path = position + moved, path + abs(moved)
    return path - abs(position - float(values[0]))
