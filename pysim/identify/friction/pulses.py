"""The inductive speed sensor: what its pulses make of a speed, and what can be read back from its log."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, sampling

Array = NDArray[np.float64]

_NEWTON_STEPS = 8


def pulse_times(time: Array, angle: Array, speed: Array, *, pulses: int = 10) -> Array:
    """Instants of the rising edges, (n,) s.

    Metal is in front of the sensor where sin(pulses angle) > 0. Turning forward, the edge rises where that sine grows
    through zero; turning backward, at the other end of each tooth. Between samples the angle is the cubic through
    both ends' angles and speeds; a tooth that comes and goes again between two samples is not seen.

    Args:
        time: (n_t,) s, increasing, some ten samples per pulse or more.
        angle, speed: (n_t,) rad and rad/s.
    Source: thesis Section 5.1, Fig. 5.4.
    """
    turns = pulses * angle / (2 * np.pi)
    ahead, behind = np.ceil(turns) - 1, np.floor(turns - 0.5) + 1  # an edge right at a sample is still to come
    forward = np.maximum(np.diff(ahead), 0).astype(int)
    backward = np.maximum(-np.diff(behind), 0).astype(int)
    count = forward + backward
    k = np.repeat(np.arange(time.size - 1), count)
    place = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    goal = np.where(place < forward[k], ahead[k] + 1 + place, behind[k] - 0.5 - (place - forward[k]))
    return np.sort(_crossings(k, goal * 2 * np.pi / pulses, time, angle, speed))


def _crossings(k: NDArray[np.int_], goal: Array, time: Array, angle: Array, speed: Array) -> Array:
    """When the cubic of interval k reaches the goal, (n,) s; Newton's rule, kept inside the interval."""
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
    """What the sensor's speed reads at the times of a log, (n_t,) rad/s; zero before the second edge.

    Args:
        edges: (n,) s, instants of the rising edges, with whatever jitter they have.
        logged: (n_t,) s.
        direction: (n_t,) its sign is taken for that of the speed, zero for forward.
    Source: thesis Eq. 5.1.
    """
    last = np.searchsorted(edges, logged, side="right") - 1
    speeds = 2 * np.pi / (pulses * np.diff(edges))
    held = np.where(last >= 1, speeds[np.clip(last - 1, 0, None)], 0.0) if speeds.size else np.zeros(logged.size)
    return np.where(direction < 0, -held, held)


@dataclass(frozen=True)
class PulseIntervals:
    """Times between edges as read back from a log: over [start, end] the mean speed is known, and nothing else.

    start, end: (n,) s; speed: (n,) rad/s, signed as logged; whole: (n,) whether the logged sign stayed the same since
    the interval's start, so that no reversal is inside; run: (n,) number of the stretch in one direction it is in.
    """

    start: Array
    end: Array
    speed: Array
    whole: NDArray[np.bool_]
    run: NDArray[np.int_]


def pulse_intervals(time: Array, logged: Array, *, pulses: int = 10, noise: float = 0.0) -> PulseIntervals:
    """Find the edges in a log of the held speed.

    The reading changes when an edge has come, and tells the time since the edge before: so both ends of the interval
    are known, the last one to half a sample. Edges whose reading does not change the speed are not seen; their
    intervals are missing, no others are wrong. More edges than samples leave the last one before each sample.

    Args:
        time: (n_t,) s.
        logged: (n_t,) rad/s, thesis Eq. 5.1.
        noise: standard deviation of noise on the reading itself, rad/s; steps below seven of it are not seen, and
            each reading is the mean between two steps.
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
