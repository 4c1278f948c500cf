"""Logs with known noise: stepped sines that repeat and waves that do not, as the diagnosis is handed them."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from pysim.identify.greybox.observation import Run
from pysim.identify.greybox.sine_log import Sine, SinePlan, sine_log
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.identify.greybox.time_log import TimeLog
from pysim.types import Experiment, Record, Signal

Array = NDArray[np.float64]
RATE = 250.0  # Hz


def noise(n: int, white: float, coloured: float, memory: float, rng: np.random.Generator) -> Array:
    """Stationary from the first sample on, at RATE."""
    kept = np.exp(-1 / (RATE * memory))
    drive = coloured * np.sqrt(1 - kept**2) * rng.standard_normal(n)
    drive[0] = coloured * rng.standard_normal()
    return white * rng.standard_normal(n) + np.asarray(lfilter([1.0], [1.0, -kept], drive))


def sines(
    added: Callable[[int], Array], told: float, frequencies: tuple[float, ...] = (0.5, 1, 2, 7, 13, 20)
) -> SteppedSines:
    """A swing with three harmonics in column "y", plus what `added` gives for so many samples."""
    logs, runs = [], []
    for f in frequencies:
        time = np.arange(round(8.0 * RATE)) / RATE
        w = 2 * np.pi * f
        swing = 3 + 10 * np.sin(w * time) + np.cos(2 * w * time) - 0.5 * np.sin(3 * w * time)
        data = Record(time, (swing + added(time.size))[:, None], ("y",), ("m",))
        log = sine_log(f"{f:g}Hz", data, Sine(0.0, 10.0, f, 0.0, 0.0, 8.0), (told,), SinePlan(), index=len(logs))
        times = 0.5 + np.arange(log.points) / log.points / f
        logs.append(log)
        runs.append(Run(log.source, Experiment(times, ("y",), {"u": Signal.constant(0.0)})))
    return SteppedSines("data", "fit", tuple(logs), tuple(runs), None)


def wave(values: Array, told: float, *, name: str = "y", use: str = "fit", interval: float = 1 / RATE) -> TimeLog:
    """A log over time of one signal."""
    time = np.arange(values.shape[0]) * interval
    data = Record(time, values.reshape(time.size, -1), (name,), ("m",))
    run = Run(name, Experiment(time, (name,), {"u": Signal.through(time, np.sin(2 * np.pi * 0.7 * time))}))
    return TimeLog("data", f"{name}.txt", "stochastic", use, data, (told,), (1.0,), run, index=0)
