"""Least-squares fits of sines and chirps, and their start values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify._near_orthogonal import near_orthogonal_fit
from pysim.types import sampling

Array = NDArray[np.float64]

_FEWEST = 32  # samples that are enough to estimate the noise of a log
_ROUNDING = 1e-9  # share of the log's range: a hold without noise must not look like a sine of this amplitude
_WHOLE = 0.01  # share of the amplitude: if all residuals of one sine are smaller, the log has no lead-in


@dataclass(frozen=True)
class Wave:
    """offset + amplitude sin(phase + omega s + kappa/2 s^2), s = t - origin; rad and s."""

    offset: float
    amplitude: float
    phase: float
    omega: float
    kappa: float
    origin: float

    def angle(self, t: Array | float) -> Array:
        """rad at times t (n,)."""
        s = np.asarray(t) - self.origin
        return np.asarray(self.phase + (self.omega + 0.5 * self.kappa * s) * s)

    def omega_at(self, t: Array | float) -> Array:
        """rad/s at times t (n,)."""
        return np.asarray(self.omega + self.kappa * (np.asarray(t) - self.origin))

    def value(self, t: Array) -> Array:
        """Value at times t (n,)."""
        return self.offset + self.amplitude * np.sin(self.angle(t))

    def fastest(self, t: Array) -> float:
        """Largest angular frequency over times t (n,)."""
        return float(np.max(np.abs(self.omega_at(t[[0, -1]]))))


def fit_sine(t: Array, y: Array, omega: float) -> Wave:
    """Least-squares fit of a sine of known angular frequency to values (n,) at times (n,)."""
    origin = float(t[t.size // 2])
    angle = omega * (t - origin)
    matrix = np.column_stack([np.sin(angle), np.cos(angle), np.ones_like(angle)])
    c = near_orthogonal_fit(matrix, y)
    return Wave(float(c[2]), float(np.hypot(c[0], c[1])), float(np.arctan2(c[1], c[0])), omega, 0.0, origin)


def sine_start(t: Array, y: Array, omega: float, step: float, interval: float) -> tuple[Wave, slice]:
    """The stretch of one period with the best sine fit, and that fit; the whole log if it is one sine, or short.

    At high frequencies the stretch is longer than a period, so that it shows the noise of the log.

    Args:
        t, y: (n,).
        omega: rad/s.
        step: rounding of y.
        interval: s between samples.
    """
    count = max(round(2 * np.pi / omega / interval), min(_FEWEST, t.size // 2), 8)
    rounding = _ROUNDING * float(np.ptp(y)) or 1.0
    best, inside, record = fit_sine(t, y, omega), slice(0, t.size), -1.0
    if np.max(np.abs(y - best.value(t))) <= max(2 * step, _WHOLE * best.amplitude):
        return best, inside
    for first in range(0, t.size - count + 1, max(count // 4, 1)):
        window = slice(first, first + count)
        wave = fit_sine(t[window], y[window], omega)
        residual = float(np.sqrt(np.mean((y[window] - wave.value(t[window])) ** 2)))
        score = wave.amplitude / (residual + step + rounding)
        if score > record:
            best, inside, record = wave, window, score
    return best, inside


def fit_chirp(t: Array, y: Array, start: Wave) -> Wave:
    """Nonlinear least-squares fit of a chirp's five parameters; the start's phase must be right to a quarter turn."""
    from scipy.optimize import least_squares  # takes 0.2 s to import, so only if needed

    middle, half = 0.5 * (t[0] + t[-1]), 0.5 * (t[-1] - t[0])
    s = (t - middle) / half

    def wave_of(p: Array) -> tuple[Array, Array]:
        angle = (p[3] + p[4] * s) * s
        return np.sin(angle), np.cos(angle)

    def residuals(p: Array) -> Array:
        sin, cos = wave_of(p)
        return p[0] + p[1] * sin + p[2] * cos - y

    def slopes(p: Array) -> Array:
        sin, cos = wave_of(p)
        turn = p[1] * cos - p[2] * sin
        return np.column_stack([np.ones_like(s), sin, cos, turn * s, turn * s * s])

    phase = float(start.angle(middle))
    first = [
        start.offset,
        start.amplitude * np.cos(phase),
        start.amplitude * np.sin(phase),
        float(start.omega_at(middle)) * half,
        0.5 * start.kappa * half**2,
    ]
    p = least_squares(residuals, first, slopes, method="lm", xtol=1e-14, ftol=1e-14, gtol=1e-14).x
    return Wave(
        float(p[0]),
        float(np.hypot(p[1], p[2])),
        float(np.arctan2(p[2], p[1])),
        float(p[3] / half),
        float(2 * p[4] / half**2),
        float(middle),
    )


def chirp_start(t: Array, y: Array) -> tuple[Wave, slice] | None:
    """A chirp from the times at which the values pass their median; None if there are fewer than six such passages.

    Lead-in and ramp back may add passages, which are outliers of the quadratic phase and are left out. Passages in a
    gap are counted by the frequency around the gap.
    """
    offset = float(np.median(y))
    amplitude = float(np.median(np.abs(y - offset))) * np.sqrt(2)  # of a sine, half the samples are within sin 45 deg
    times, upwards = _passages(t, y - offset, 0.3 * amplitude)
    if times.size < 6:
        return None
    times, upwards, half_turns = _counted(t, times, upwards)
    if times.size < 6:
        return None
    origin = float(times[times.size // 2])
    good = np.ones(times.size, dtype=bool)
    for _ in range(5):
        c = np.polyfit(times[good] - origin, half_turns[good], 2)
        error = np.abs(np.polyval(c, times - origin) - half_turns)
        good = error <= max(6 * float(np.median(error)), 0.05)
    sure = np.flatnonzero(good)
    first, last = sure[[1, -2]] if sure.size > 7 else sure[[0, -1]]  # the first and last may belong to the ramps
    phase = float(c[2]) + (0.0 if upwards[0] else np.pi)
    wave = Wave(offset, amplitude, phase, float(c[1]), float(2 * c[0]), origin)
    return wave, slice(int(np.searchsorted(t, times[first])), int(np.searchsorted(t, times[last])) + 1)


def _counted(t: Array, times: Array, upwards: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_], Array]:
    """Passages (n,) outside the gaps of a log, their directions, and the wave's half turns up to each (n,), rad."""
    gaps = [(t[k], t[k + 1]) for k in sampling(t).gaps]
    seen = np.ones(times.size, dtype=bool)
    for begin, end in gaps:
        seen &= (times <= begin) | (times >= end)
    times, upwards = times[seen], upwards[seen]
    turns: Array = np.arange(times.size, dtype=np.float64)
    for begin, end in gaps:
        j = int(np.searchsorted(times, end))
        if not 1 < j < times.size - 1 or times[j - 1] > begin:
            continue
        half = 0.5 * (times[j - 1] - times[j - 2] + times[j + 1] - times[j])
        odd = int(upwards[j] != upwards[j - 1])  # an even number of half turns passes the median the same way
        whole = round(0.5 * (float((times[j] - times[j - 1]) / half) - odd))
        turns[j:] += max(2 * whole + odd, 1) - 1
    return times, upwards, np.asarray(np.pi * turns)


def _passages(t: Array, y: Array, threshold: float) -> tuple[Array, NDArray[np.bool_]]:
    """Times at which y changes from beyond the threshold on one side to beyond it on the other, and whether upwards.
    The time is that of zero; if noise causes several zeros, it is the middle between the first and the last."""
    beyond = np.flatnonzero(np.abs(y) > threshold)
    side = y[beyond] > 0
    turns = np.flatnonzero(side[1:] != side[:-1])
    times = []
    for k in turns:
        i, j = beyond[k], beyond[k + 1]
        part = slice(i, j + 1)
        change = i + np.flatnonzero(np.signbit(y[part][1:]) != np.signbit(y[part][:-1]))
        zeros = t[change] - y[change] * (t[change + 1] - t[change]) / (y[change + 1] - y[change])
        times.append(float(np.mean(zeros[[0, -1]])))
    return np.array(times), side[turns + 1]
