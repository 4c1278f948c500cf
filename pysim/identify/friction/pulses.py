"""The inductive speed sensor: the speed that its pulses give, and the pulses that its log shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, sampling

Array = NDArray[np.float64]

_NEWTON_STEPS = 8


def pulse_times(time: Array, angle: Array, speed: Array, *, pulses: int = 10) -> Array:
    """Times of the rising edges, (n,) s.

    A tooth is in front of the sensor where sin(pulses angle) > 0. In forward rotation, the edge rises where this sine
    increases through zero; in backward rotation, at the other end of each tooth. Between samples, the angle is the
    cubic through both ends' angles and speeds. A tooth that comes and goes again between two samples is missed.

    Args:
        time: (n_t,) s, increasing, with about ten samples per pulse or more.
        angle, speed: (n_t,) rad and rad/s.
    Source: thesis Section 5.1, Fig. 5.4.
    """
    turns = pulses * angle / (2 * np.pi)
    ahead, behind = np.ceil(turns) - 1, np.floor(turns - 0.5) + 1  # an edge exactly at a sample counts as not passed
    forward = np.maximum(np.diff(ahead), 0).astype(int)
    backward = np.maximum(-np.diff(behind), 0).astype(int)
    count = forward + backward
    k = np.repeat(np.arange(time.size - 1), count)
    place = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    goal = np.where(place < forward[k], ahead[k] + 1 + place, behind[k] - 0.5 - (place - forward[k]))
    return np.sort(_crossings(k, goal * 2 * np.pi / pulses, time, angle, speed))


def _crossings(k: NDArray[np.int_], goal: Array, time: Array, angle: Array, speed: Array) -> Array:
    """Times at which the cubic of interval k reaches the angle `goal`, (n,) s; Newton iteration inside the interval."""
    step = time[k + 1] - time[k]
    a, b = angle[k], angle[k + 1]
    slope_a, slope_b = speed[k] * step, speed[k + 1] * step
    quadratic, cubic = 3 * (b - a) - 2 * slope_a - slope_b, 2 * (a - b) + slope_a + slope_b
    s = (goal - a) / (b - a)
    for _ in range(_NEWTON_STEPS):
        value = a + s * (slope_a + s * (quadratic + s * cubic))
        rate = slope_a + s * (2 * quadratic + 3 * s * cubic)
        s = np.clip(s - np.divide(value - goal, rate, out=np.zeros_like(s), where=rate != 0), 0.0, 1.0)
    return time[k] + s * step


def pulse_speed(edges: Array, logged: Array, direction: Array, *, pulses: int = 10) -> Array:
    """The sensor's reading of the speed at the times of a log, (n_t,) rad/s; zero before the second edge.

    Args:
        edges: (n,) s, times of the rising edges, jitter included.
        logged: (n_t,) times of the log, s.
        direction: (n_t,) sign of the speed; zero counts as forward.
    Source: thesis Eq. 5.1.
    """
    last = np.searchsorted(edges, logged, side="right") - 1
    speeds = 2 * np.pi / (pulses * np.diff(edges))
    held = np.where(last >= 1, speeds[np.clip(last - 1, 0, None)], 0.0) if speeds.size else np.zeros(logged.size)
    return np.where(direction < 0, -held, held)


@dataclass(frozen=True)
class PulseIntervals:
    """Intervals between edges, from a log; the mean speed over [start, end] is known.

    start, end: (n,) s; speed: (n,) rad/s, signed as logged; whole: (n,) whether the logged sign is constant over the
    interval, so that there is no reversal in it; run: (n,) number of the interval's stretch in one direction.
    """

    start: Array
    end: Array
    speed: Array
    whole: NDArray[np.bool_]
    run: NDArray[np.int_]


def pulse_intervals(time: Array, logged: Array, *, pulses: int = 10, noise: float = 0.0) -> PulseIntervals:
    """Find the edges in a log of the held speed.

    The reading changes after an edge, and its value is the time since the edge before. So both ends of the interval are
    known, the last one to half a sample. An edge that does not change the reading is missed: its interval is missing,
    and all others are right. If there are several edges between two samples, only the last one is found.

    Args:
        time: (n_t,) s.
        logged: (n_t,) rad/s, thesis Eq. 5.1.
        noise: standard deviation of noise on the reading, rad/s; changes below seven times this are ignored, and
            each reading is the mean between two changes.
    Raises:
        BadInput: fewer than five changes of the reading.
    """
    size = np.abs(logged)
    changes = np.flatnonzero(np.abs(np.diff(size)) > 7 * noise) + 1
    changes = changes[size[changes] > 7 * noise]
    if changes.size < 5:
        raise BadInput(
            f"pulse sensor: its reading changes {changes.size} times; give a log with more revolutions, "
            "or treat the speed as continuous"
        )
    counts = np.diff(np.append(changes, size.size))
    level = np.add.reduceat(size, changes) / counts
    step = sampling(time).step
    end = time[changes] - np.minimum(step, time[changes] - time[changes - 1]) / 2
    start = end - 2 * np.pi / (pulses * level)
    turned = np.flatnonzero(np.diff(np.sign(logged)) != 0) + 1
    run = np.searchsorted(turned, changes, side="right")
    before = np.searchsorted(time, start)
    whole = (start >= time[0]) & (np.searchsorted(turned, np.minimum(before, changes), side="right") == run)
    return PulseIntervals(start, end, np.sign(logged[changes]) * level, whole, run)
