"""Samples of friction torque and speed, from the torque balance of the shaft (thesis Eq. 5.41)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.friction.filtering import local_slope, sampling_rate, settling_time, zero_phase
from pysim.identify.friction.pulses import PulseIntervals, pulse_intervals
from pysim.identify.friction.shaft import ShaftTest
from pysim.types import BadInput, sampling

Array = NDArray[np.float64]

SHORTEST = 0.05  # s; shorter pulse intervals are joined, as their timing noise would dominate the acceleration
MOST_CHANGE = 1.5  # largest ratio of neighbouring speeds; with a larger one, the shaft may have stopped in between
OVERSAMPLING = 6  # rows per period of the low-pass's cutoff; three times the Nyquist rate
HALF_WIDTH = 2  # neighbours on each side for the acceleration


@dataclass(frozen=True)
class FrictionSamples:
    """Samples of speed and friction torque, in the order of time.

    time (n,) s; speed (n,) rad/s, mean over the sample; change (n,) rad/s, change of the speed during the sample;
    torque (n,) N.m, T_f of Eq. 5.41; sigma (n,) N.m, its standard deviation due to noise, up to a common factor;
    acceleration (n,) rad/s2; dropped: reasons, and how many samples were left out for each.
    """

    time: Array
    speed: Array
    change: Array
    torque: Array
    sigma: Array
    acceleration: Array
    dropped: tuple[tuple[str, int], ...] = ()


def filtered_samples(test: ShaftTest, inertia: float, *, cutoff_hz: float = 5.0) -> FrictionSamples:
    """Samples with zero-phase filtered speed and torque, and the acceleration from local slopes, as in the thesis.

    Only `OVERSAMPLING` rows per period of the cutoff are kept, since the filtered signals do not change in between.

    The held reading of a pulse sensor is taken as the speed, although it is late by half to one and a half of the time
    between pulses. Near standstill, this error is larger than the changes of friction.

    Args:
        inertia: kg.m2.
        cutoff_hz: cutoff of the low-pass.
    Raises:
        BadInput: an uneven log, one that is too short for the filter, or a cutoff that is too high for its rate.
    Source: thesis Section 5.5, Eq. 5.41.
    """
    rate, edge = sampling_rate(test.time), settling_time(cutoff_hz)
    inner = (test.time >= test.time[0] + edge) & (test.time <= test.time[-1] - edge)
    if inner.sum() < 10:
        raise BadInput(
            f"{test.name}: {np.ptp(test.time):g} s are too short for a cutoff of {cutoff_hz:g} Hz; "
            f"log more than {2 * edge:g} s, or raise the cutoff"
        )
    columns = np.column_stack([test.speed, test.torque])
    speed, torque = zero_phase(test.time, columns, cutoff_hz).T
    _, acceleration, _ = local_slope(test.time, speed, half_width=HALF_WIDTH)
    kept = np.flatnonzero(inner)[:: max(1, int(rate / (OVERSAMPLING * cutoff_hz)))]
    friction = torque - inertia * acceleration
    one = np.ones(test.time.size)
    dropped = (("ends of the filter", int((~inner).sum())),)
    return _kept(FrictionSamples(test.time, speed, 0 * one, friction, one, acceleration, dropped), kept)


def pulse_samples(test: ShaftTest, inertia: float, *, pulses: int = 10) -> FrictionSamples:
    """Samples per pulse interval, over which the means of speed and torque are known exactly.

    Short intervals are joined. Both sides of Eq. 5.41 are averaged over the same time, which filters without delay; the
    acceleration is the local slope over neighbouring intervals. Left out are intervals with a reversal, the first and
    last one between two reversals, and those whose neighbours differ by more than the factor `MOST_CHANGE`, since the
    shaft may have stopped in them.

    Args:
        inertia: kg.m2.
        pulses: pulses per revolution.
    Raises:
        BadInput: no interval is left.
    Source: thesis Eq. 5.1, 5.41. Differs: the thesis filters the held speed.
    """
    found = _grouped(pulse_intervals(test.time, test.speed, pulses=pulses, noise=test.speed_noise or 0.0))
    middle, length = (found.start + found.end) / 2, found.end - found.start
    slope, gain, smooth = np.zeros(middle.size), np.zeros(middle.size), found.speed.copy()
    steady = _steady(found)
    for run in np.unique(found.run):
        rows = np.flatnonzero(found.run == run)
        if rows.size < 2 * HALF_WIDTH + 1:
            steady[rows] = False
            continue
        smooth[rows], slope[rows], gain[rows] = local_slope(middle[rows], found.speed[rows], half_width=HALF_WIDTH)
    keep = found.whole & steady
    if not keep.any():
        raise BadInput(f"{test.name}: no pulse interval with a steady speed on both sides; turn the shaft more slowly")
    jitter = _timing_noise((found.speed - smooth)[keep], found.speed[keep], length[keep])
    mean, noise = _mean_torque(test, found.start, found.end)
    speed_noise = jitter * np.abs(found.speed) / length
    sigma = np.hypot(noise, inertia * gain * speed_noise)
    reasons = (
        ("reversal inside, or the log's start", int((~found.whole).sum())),
        ("next to a standstill or reversal", int((found.whole & ~steady).sum())),
    )
    torque = mean - inertia * slope
    every = FrictionSamples(middle, found.speed, slope * length, torque, sigma, slope, reasons)
    return _kept(every, np.flatnonzero(keep))


def _kept(samples: FrictionSamples, rows: NDArray[np.intp]) -> FrictionSamples:
    """The samples of these rows only."""
    columns = ("time", "speed", "change", "torque", "sigma", "acceleration")
    return replace(samples, **{name: getattr(samples, name)[rows] for name in columns})


def _grouped(found: PulseIntervals) -> PulseIntervals:
    """Join neighbouring intervals in the same direction until they last `SHORTEST` seconds."""
    slots = np.floor(np.cumsum(np.minimum(found.end - found.start, SHORTEST)) / SHORTEST * (1 - 1e-9))
    alone = (found.end - found.start >= SHORTEST) | ~found.whole
    fresh = (np.diff(slots) > 0) | (np.diff(found.run) != 0) | alone[1:] | alone[:-1]
    first = np.append(0, np.flatnonzero(fresh) + 1)
    last = np.append(first[1:], found.run.size) - 1
    length = found.end - found.start
    speed = np.add.reduceat(found.speed * length, first) / np.add.reduceat(length, first)
    return PulseIntervals(found.start[first], found.end[last], speed, found.whole[first], found.run[first])


def _steady(found: PulseIntervals) -> NDArray[np.bool_]:
    """Whether both neighbours exist, in the same direction, without reversal, and at nearly the same speed."""
    size = np.abs(found.speed)
    ratio = np.maximum(size[1:] / size[:-1], size[:-1] / size[1:])
    alike = (ratio <= MOST_CHANGE) & (found.run[1:] == found.run[:-1]) & found.whole[1:] & found.whole[:-1]
    return np.append(False, alike) & np.append(alike, False)


def _timing_noise(difference: Array, speed: Array, length: Array) -> float:
    """Standard deviation of an interval's length, s, from the deviations of its speed from the local curve."""
    left = 1 - 17 / 35  # variance of the middle residual of a quadratic through five points, over that of the noise
    return 1.4826 * float(np.median(np.abs(difference) * length / np.abs(speed))) / np.sqrt(left)


def _mean_torque(test: ShaftTest, start: Array, end: Array) -> tuple[Array, Array]:
    """Mean torque from start to end, with linear interpolation between samples, and its standard deviation."""
    step = np.diff(test.time)
    integral = np.append(0.0, np.cumsum(step * (test.torque[1:] + test.torque[:-1]) / 2))

    def up_to(t: Array) -> Array:
        k = np.clip(np.searchsorted(test.time, t, side="right") - 1, 0, step.size - 1)
        s = t - test.time[k]
        return integral[k] + s * (test.torque[k] + s / (2 * step[k]) * (test.torque[k + 1] - test.torque[k]))

    noise = test.torque_noise
    if noise is None:  # from second differences, as for white noise; coarse rounding may hide these
        noise = max(float(np.median(np.abs(np.diff(test.torque, 2)))) * 1.4826 / np.sqrt(6), test.torque_rounding)
    count = np.maximum((end - start) / sampling(test.time).step, 1.0)
    return (up_to(end) - up_to(start)) / (end - start), noise / np.sqrt(count)
